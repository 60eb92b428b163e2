# SPDX-License-Identifier: GPL-3.0-or-later
"""What the bones of an armature are to a body: found by the core, or as the user says."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy
import numpy as np
from bpy.props import BoolProperty, StringProperty

from ..compat.core import core
from ..errors import UserError, core_errors
from ..files import check_regular
from .rigs import FEET, FORE_FOOT, make_rig, roles_in_bones
from .selection import highlight
from .skins import make_skin

if TYPE_CHECKING:
    from fragmotion_core import Body, Clip, Rig, Skeleton, Skin

NEEDED = (
    "hips",
    "spine_1",
    "neck_1",
    "head",
    *(
        f"{side}_{part}"
        for part in ("shoulder", "upper_arm", "lower_arm", "hand", "thigh", "shin", "foot", "toe")
        for side in ("left", "right")
    ),
)
"""The roles that are asked for even where no bone is found for them,"""
_NEEDED_ON_FOUR_LEGS = (
    "hips",
    "head",
    *(f"{side}_{part}" for part in ("thigh", "foot", "fore_leg", "fore_foot") for side in ("left", "right")),
)
"""and those of a body that stands on four legs."""


def _drop_doubt_of_another(role: RoleBone, _context: bpy.types.Context) -> None:
    doubts = role.id_data.fragmotion.doubts
    if role.name in doubts and doubts[role.name].bone != role.bone:
        doubts.remove(doubts.find(role.name))


class RoleBone(bpy.types.PropertyGroup):
    """The bone that has the role `name`; none where it is empty."""

    bone: StringProperty(  # type: ignore[valid-type]
        name="Bone", description="The bone that is this part of the body", update=_drop_doubt_of_another
    )


class DoubtfulBone(bpy.types.PropertyGroup):
    """A bone that is taken for the role `name`, and why it may not be that, until the user says that it is `right`."""

    bone: StringProperty()  # type: ignore[valid-type]
    text: StringProperty()  # type: ignore[valid-type]
    right: BoolProperty()  # type: ignore[valid-type]


def chosen_roles(obj: bpy.types.Object) -> dict[str, str] | None:
    """Role -> bone name as the user has them, or None where nobody has looked at them."""
    return roles_in_bones(obj) if len(obj.fragmotion.roles) else None


def _find_roles(rig: Rig, skin: Skin) -> dict[str, str]:
    """Role -> bone name as the core finds them."""
    return {role: bone for role, (bone, _) in rig.skeleton.role_map(skin=skin).items()}


def set_roles(obj: bpy.types.Object, found: Mapping[str, str]) -> None:
    """Keep role -> bone name with the armature, the needed roles first."""
    roles = obj.fragmotion.roles
    roles.clear()
    needed = _NEEDED_ON_FOUR_LEGS if FORE_FOOT in found else NEEDED
    for name in (*needed, *(role for role in found if role not in needed)):
        role = roles.add()
        role.name, role.bone = name, found.get(name, "")


def keep_four_legs(obj: bpy.types.Object, skeleton: Skeleton) -> None:
    """Keep with an armature that was made from takes on four legs what their motion tells of its bones, where its rest
    pose does not."""
    if FORE_FOOT in skeleton.roles and FORE_FOOT not in make_rig(obj).skeleton.roles:
        set_roles(obj, {role: bone for role, (bone, _) in skeleton.role_map().items()})


def keep_legs_of_skin(obj: bpy.types.Object, rig: Rig) -> None:
    """Keep with an armature whose bones nobody has chosen what its meshes tell of them, where they follow other feet
    than those that its names tell: MMD's models hang theirs on copies of the legs."""
    if obj.library is not None or chosen_roles(obj) is not None:
        return
    named = {role: bone for role, (bone, _) in rig.skeleton.role_map().items()}
    if _tells_other_feet(_all_but_feet(rig.skeleton, named), rig, named):
        skin = make_skin(obj, rig)
        if _tells_other_feet(skin, rig, named):
            set_roles(obj, _find_roles(rig, skin))


def _tells_other_feet(skin: Skin, rig: Rig, named: Mapping[str, str]) -> bool:
    found = _find_roles(rig, skin)
    return any(role in found and found[role] != named.get(role) for role in FEET)


def _all_but_feet(skeleton: Skeleton, named: Mapping[str, str]) -> Skin:
    """As if a mesh followed all bones but the feet that names tell: cheaper than to read one."""
    feet = {skeleton.names.index(named[role]) for role in FEET if role in named}
    for bone, parent in enumerate(skeleton.parents):
        if parent in feet:
            feet.add(bone)
    others = [name for bone, name in enumerate(skeleton.names) if bone not in feet]
    skin: Skin = core.Skin(skeleton)
    skin.add(np.eye(4), np.zeros((1, 3)), others, np.array([(0, group, 1) for group in range(len(others))], float))
    return skin


def open_doubts(obj: bpy.types.Object) -> list[DoubtfulBone]:
    """What is doubtful about the armature's bones, and nobody has said to be right."""
    return [doubt for doubt in obj.fragmotion.doubts if not doubt.right and doubt.bone in obj.data.bones]


def find_and_doubt(obj: bpy.types.Object, rig: Rig) -> list[str]:
    """Find the roles, keep them with the armature with what is doubtful about them, and return that."""
    skin = make_skin(obj, rig)
    set_roles(obj, _find_roles(rig, skin))
    return _doubt(obj, rig, skin)


def doubts_at_import(obj: bpy.types.Object) -> list[str]:
    """What is doubtful about the bones of an armature that takes were brought onto, where nobody has chosen them: kept
    for the panel to show, and these bones selected. No role is chosen by it."""
    if chosen_roles(obj) is not None:
        return []
    rig = make_rig(obj)
    texts = _doubt(obj, rig, make_skin(obj, rig))
    if texts:
        highlight(obj, [doubt.bone for doubt in open_doubts(obj)])
    return texts


def _doubt(obj: bpy.types.Object, rig: Rig, skin: Skin) -> list[str]:
    """Keep what is doubtful about the bones that the core finds, and return it but for what is said to be right."""
    right = _said_to_be_right(obj)
    obj.fragmotion.doubts.clear()
    for role, bone, text in core.role_doubts(rig.skeleton, skin=skin):
        doubt = obj.fragmotion.doubts.add()
        doubt.name, doubt.bone, doubt.text, doubt.right = role, bone, text, right.get(role) == bone
    return [doubt.text for doubt in open_doubts(obj)]


def _said_to_be_right(obj: bpy.types.Object) -> dict[str, str]:
    """Role -> bone name of the doubtful bones that the armature still has and the user said to be right."""
    return {row.name: row.bone for row in obj.fragmotion.doubts if row.right and row.bone in obj.data.bones}


def make_body(obj: bpy.types.Object, rig: Rig, clips: Sequence[Clip] = ()) -> Body:
    """The armature as a body; UserError names what is missing of it."""
    roles = chosen_roles(obj)
    told = _said_to_be_right(obj) if roles is None else {}
    with core_errors(f"Armature '{obj.name}'"):
        body: Body = core.Body(rig.skeleton, clips, roles, told, make_skin(obj, rig))
        return body


def save_roles(obj: bpy.types.Object, path: Path) -> None:
    """Write the roles as a preset."""
    path.write_text(json.dumps(chosen_roles(obj), indent=1) + "\n", encoding="utf-8")


def read_roles(obj: bpy.types.Object, path: Path) -> dict[str, str]:
    """Role -> bone name of a preset that fits the armature; UserError says what does not."""
    check_regular(path)
    try:
        read: Any = json.loads(path.read_text(encoding="utf-8"))
    except (ValueError, RecursionError) as error:
        raise UserError(f"'{path}' is no preset of bones: {error}") from error
    if not isinstance(read, dict) or not all(isinstance(bone, str) for bone in read.values()):
        raise UserError(f"'{path}' is no preset of bones: it must hold names of bones by role")
    missing = [bone for bone in read.values() if bone not in obj.data.bones]
    if missing:
        raise UserError(f"'{path}': armature '{obj.name}' has no bone '{missing[0]}'")
    return dict(read)
