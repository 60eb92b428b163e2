# SPDX-License-Identifier: GPL-3.0-or-later
"""Armatures that were exported with their controls, as Auto-Rig Pro's: the bones that the mesh follows hang on controls
that carry none of it. They are a body by how they move with each other."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ..compat.core import core
from .bodies import chosen_roles, set_roles
from .rigs import FEET, is_tied, make_rig, parents_of
from .skins import followed_bones, is_skinned, make_skin

if TYPE_CHECKING:
    from fragmotion_core import Doubles


def named_feet(obj: bpy.types.Object) -> list[bpy.types.Bone]:
    """The feet that the bones' names tell, whatever *Bones* has."""
    roles = make_rig(obj, roles={}).skeleton.roles
    return [obj.data.bones[roles[role]] for role in FEET if role in roles]


def bones_beside_names(obj: bpy.types.Object) -> list[str]:
    """The bones that a mesh follows, in their order, where it follows neither foot that the names tell, nor what hangs
    on it; else none."""
    feet = named_feet(obj)
    below = {bone.name for foot in feet for bone in (foot, *foot.children_recursive)}
    if not feet or not is_skinned(obj) or any(name in below for name in followed_bones(obj)):
        return []
    followed = set(followed_bones(obj))
    return [bone.name for bone in obj.data.bones if bone.name in followed]


def hang_by_motion(obj: bpy.types.Object, names: Sequence[str], poses: Doubles) -> dict[str, str]:
    """On which other each of these bones hangs whose parent is none of them, as poses [F,B,4,4] in the armature's space
    show it; and their roles are kept with the armature, where nobody has chosen them."""
    bones = obj.data.bones
    joints = core.find_joints(bones.keys(), parents_of(obj), poses, [bones.find(name) for name in names])
    hanging = {bones[bone].name: bones[on].name for bone, on in joints.items() if not is_tied(bones[bone])}
    if chosen_roles(obj) is None:
        set_roles(obj, _roles(obj, names, hanging))
    return hanging


def _roles(obj: bpy.types.Object, names: Sequence[str], hanging: Mapping[str, str]) -> dict[str, str]:
    """What these bones alone are to a body."""
    bones = obj.data.bones
    above = {name: hanging.get(name, bones[name].parent.name if bones[name].parent else "") for name in names}
    order: list[str] = []
    while len(order) < len(names):
        order += [name for name in names if name not in order and (above[name] not in above or above[name] in order)]
    rig = core.Rig(
        names=order,
        parents=[order.index(above[name]) if above[name] in order else -1 for name in order],
        rest=np.array([bones[name].matrix_local for name in order]),
        lengths=[bones[name].length for name in order],
        world=np.array(obj.matrix_world),
    )
    return {role: bone for role, (bone, _) in rig.skeleton.role_map(skin=make_skin(obj, rig)).items()}
