# SPDX-License-Identifier: GPL-3.0-or-later
"""An armature object as the core's Rig."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import bpy
import numpy as np
from mathutils import Matrix

from ..compat.core import core
from ..errors import UserError, core_errors

if TYPE_CHECKING:
    from fragmotion_core import Rig

FEET = ("left_foot", "right_foot")
FORE_FOOT = "left_fore_foot"
"""A role that bodies on four legs alone have."""
HELD = "fragmotion_held"
"""Custom property of an armature object: location and rotation of its bones that are posed and not keyed."""
SIZES = "fragmotion_sizes"
"""Custom property of an armature object: how many times as large as they rest bones that carry the body are shown."""
PUT_ASIDE = "fragmotion_put_aside"
"""Custom property of an armature object while it is driven, or shows a take or a class."""
FEWEST_BONES = 2
"""A character needs a bone that moves against another."""


def parents_of(obj: bpy.types.Object) -> list[int]:
    """The number of each bone's parent; -1: none."""
    bones = obj.data.bones
    return [bones.find(bone.parent.name) if bone.parent else -1 for bone in bones]


def make_rig(obj: bpy.types.Object, place: Matrix | None = None, roles: Mapping[str, str] | None = None) -> Rig:
    """The armature at its place in the world now, or at another, its roles as *Bones* has them or as given; UserError
    on what no character can have."""
    bones = obj.data.bones
    roles = roles_in_bones(obj) if roles is None else roles
    if len(bones) < FEWEST_BONES:
        count = {0: "no bones", 1: f"only one bone, '{bones[0].name}'" if bones else ""}[len(bones)]
        raise UserError(f"Armature '{obj.name}' has {count}; a character needs a body of several bones")
    with core_errors(f"Armature '{obj.name}'"):
        rig: Rig = core.Rig(
            names=[bone.name for bone in bones],
            parents=parents_of(obj),
            rest=np.array([bone.matrix_local for bone in bones]),
            lengths=[bone.length for bone in bones],
            world=np.array(obj.matrix_world if place is None else place),
            inherit_rotation=[bone.use_inherit_rotation for bone in bones],
            local_location=[bone.use_local_location for bone in bones],
            roles={role: bone for role, bone in roles.items() if role in core.ROLES and bone in bones},
            hangs={name: on for name, on in hanging_of(obj).items() if name in bones and on in bones},
            held=held_of(obj),
            sizes=sizes_of(obj),
        )
        return rig


def stretch_of(rig: Rig) -> Matrix:
    """What takes the rig's places to where they are shown, where its object stretches it upwards."""
    return Matrix.Diagonal((1.0, 1.0, rig.rise, 1.0))


def over_origin(obj: bpy.types.Object) -> Matrix:
    """The armature's place, were it over the world's origin: what comes from files is written as there, and so plays
    where the armature is."""
    place = obj.matrix_world
    return Matrix.Translation((-place.translation.x, -place.translation.y, 0)) @ place


def roles_in_bones(obj: bpy.types.Object) -> dict[str, str]:
    """Role -> bone name as *Bones* has them; none where nobody has looked at them, and without the add-on's
    properties."""
    kept = getattr(obj, "fragmotion", None)
    return {role.name: role.bone for role in kept.roles if role.bone} if kept else {}


def hanging_of(obj: bpy.types.Object) -> dict[str, str]:
    """The bones that move with others than their parents, as Build found them; none without the add-on's properties,
    where a .blend is read by the core's command alone."""
    kept = getattr(obj, "fragmotion", None)
    return {row.name: row.on for row in kept.hanging} if kept else {}


def held_of(obj: bpy.types.Object) -> dict[str, list[float]]:
    """Location (x, y, z) and rotation (w, x, y, z) of the bones that are posed and not keyed, as `held.keep_held` found
    them."""
    return {name: list(row) for name, row in obj.get(HELD, {}).items() if name in obj.data.bones}


def sizes_of(obj: bpy.types.Object) -> dict[str, float]:
    """How many times as large as they rest bones are shown, with all that hangs on them, as `held.keep_held` found
    them."""
    return {name: float(size) for name, size in obj.get(SIZES, {}).items() if name in obj.data.bones}


def carriers(obj: bpy.types.Object, rig: Rig) -> list[str]:
    """The bones whose location moves the character: its root bone and its hips; and those that hang on others than
    their parents."""
    hanging = [name for name in hanging_of(obj) if name in rig.skeleton.names]
    names = list(dict.fromkeys((rig.skeleton.names[0], rig.skeleton.roles["hips"], *hanging)))
    tied = [name for name in names if is_tied(obj.data.bones[name])]
    if tied:
        raise UserError(
            f"Armature '{obj.name}': bone '{tied[0]}' carries the body, but is connected to its parent and so cannot "
            "move: switch Connected off for it (Edit Mode, Bone properties, Relations)"
        )
    return names


def is_tied(bone: bpy.types.Bone) -> bool:
    """Whether Blender ignores the bone's location because it is connected to its parent."""
    return bone.use_connect and bone.parent is not None


def bone_path(name: str, channel: str) -> str:
    """Data path of a pose bone's channel, as F-curves spell it."""
    return f'pose.bones["{bpy.utils.escape_identifier(name)}"].{channel}'
