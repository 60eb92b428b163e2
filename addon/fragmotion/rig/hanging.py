# SPDX-License-Identifier: GPL-3.0-or-later
"""Bones that carry keys outside the chain of their parents, as the feet of rigs whose legs' IK was baked: each is taken
to hang on the bone that it moves with."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

import bpy
import numpy as np
from bpy.props import StringProperty

from ..compat import versions
from ..compat.core import core
from . import posing
from .mesh_bones import bones_beside_names, hang_by_motion, named_feet
from .rigs import bone_path, carriers, hanging_of, is_tied, make_rig, parents_of

if TYPE_CHECKING:
    from fragmotion_core import Doubles, Rig

_STRAYS = 0.005  # of the armature's size: what moves a bone by less is no motion
_FRAMES = 16  # of each Action that are looked at


class HangingBone(bpy.types.PropertyGroup):
    """The bone `name` moves with another than its parent."""

    on: StringProperty()  # type: ignore[valid-type]


def find_hanging(context: bpy.types.Context, obj: bpy.types.Object, actions: Sequence[bpy.types.Action]) -> list[str]:
    """Keep with the armature which of its bones hang on others in these Actions, and say so, and what is left out."""
    bones, least = obj.data.bones, least_way(obj)
    obj.fragmotion.hanging.clear()
    if actions and (of_mesh := bones_beside_names(obj)):
        poses = _poses(context, obj, actions)
        _keep(obj, hang_by_motion(obj, of_mesh, poses))
        return [_say_mesh(obj, of_mesh)]
    rig = make_rig(obj)
    carrying, hips = carriers(obj, rig), bones[rig.skeleton.roles["hips"]]
    others = [bone for bone in bones if bone.name not in carrying]
    moved = set[str]()
    for action in actions:
        moved |= _moved(obj, action, (bone for bone in others if bone.name not in moved), least)
    candidates = [bone.name for bone in others if bone.name in moved]
    found = _beside_body(obj, rig)
    ways = dict[str, float]()
    if candidates:
        poses = _poses(context, obj, actions)
        moving = core.find_hanging(bones.keys(), parents_of(obj), poses, [bones.find(name) for name in candidates])
        ways = {name: core.span_beside(poses, bones.find(name), bones.find(hips.name)) for name in candidates}
        found = {**found, **_beside_hips(obj, hips, candidates), **_on_body(obj, hips, moving)}
    _keep(obj, {bones[bone].name: bones[on].name for bone, on in sorted(found.items())})
    return _say(obj, make_rig(obj) if found else rig, ways)


def _poses(context: bpy.types.Context, obj: bpy.types.Object, actions: Sequence[bpy.types.Action]) -> Doubles:
    """Some of each Action [F,B,4,4]."""
    return np.concatenate([posing.sample_poses(context, obj, action, _times(action), 1)[0] for action in actions])


def _keep(obj: bpy.types.Object, hanging: Mapping[str, str]) -> None:
    for name, on in hanging.items():
        row = obj.fragmotion.hanging.add()
        row.name, row.on = name, on


def moves_beside(obj: bpy.types.Object, rig: Rig, action: bpy.types.Action) -> bool:
    """Whether an Action moves bones against their parents that carry no body."""
    least, carrying = least_way(obj), carriers(obj, rig)
    return bool(_moved(obj, action, [bone for bone in obj.data.bones if bone.name not in carrying], least))


def least_way(obj: bpy.types.Object) -> float:
    """How far at least a bone goes that is seen to, in the armature's units."""
    return _STRAYS * float(np.ptp([bone.head_local for bone in obj.data.bones], axis=0).max())


def _beside_body(obj: bpy.types.Object, rig: Rig) -> dict[int, int]:
    """What deforms a mesh and hangs on no bone, as legs beside the spine: the body takes it along."""
    bones, top = obj.data.bones, rig.skeleton.names[0]
    alone = [bone for bone in bones if bone.parent is None and bone.use_deform and bone.name != top]
    return {bones.find(bone.name): bones.find(top) for bone in alone}


def _beside_hips(obj: bpy.types.Object, hips: bpy.types.Bone, moved: Sequence[str]) -> dict[int, int]:
    """What hangs on a moved bone above the hips, as a tail beside them, moves with the hips: of the bones above them
    only the root keeps a way of its own, the others' is a part of the hips'."""
    bones = obj.data.bones
    line = {hips.name, *(bone.name for bone in hips.parent_recursive)}
    beside = [child for name in moved if name in line for child in bones[name].children if child.name not in line]
    return {bones.find(child.name): bones.find(hips.name) for child in beside if not is_tied(child)}


def _on_body(obj: bpy.types.Object, hips: bpy.types.Bone, moving: Mapping[int, int]) -> dict[int, int]:
    """As these bones move, but what moves with a bone above the hips with the hips: clips know no pose above them."""
    bones = obj.data.bones
    above = {bones.find(bone.name) for bone in hips.parent_recursive}
    on_body = {bone: bones.find(hips.name) if on in above else on for bone, on in moving.items()}
    return {bone: on for bone, on in on_body.items() if bones[bone].parent != bones[on]}


def _carries_no_other(obj: bpy.types.Object, above: str, hanging: Mapping[str, str]) -> bool:
    """Whether what hangs on a bone above the hips is the hips, or is learned as a part of something else."""
    return sum(child.name not in hanging for child in obj.data.bones[above].children) <= 1


def _moved(obj: bpy.types.Object, action: bpy.types.Action, bones: Iterable[bpy.types.Bone], least: float) -> set[str]:
    """Which of the bones an Action's keys move against their parents by that much."""
    names = {bone_path(bone.name, "location"): bone.name for bone in bones if not is_tied(bone)}
    curves = versions.curves_of(action, obj) if names else []
    return {names[path] for curve in curves if (path := curve.data_path) in names and _range(curve) > least}


def _range(curve: bpy.types.FCurve) -> float:
    keys = np.empty(2 * len(curve.keyframe_points), np.float32)
    curve.keyframe_points.foreach_get("co", keys)
    return float(np.ptp(keys[1::2])) if len(keys) else 0.0


def _times(action: bpy.types.Action) -> Doubles:
    first, last = action.frame_range
    return np.linspace(float(first), float(last), _FRAMES)


def _say(obj: bpy.types.Object, rig: Rig, ways: Mapping[str, float]) -> list[str]:
    """`ways`: how far each bone goes that is moved against its parent."""
    told, hanging = [], hanging_of(obj)
    if hanging:
        pairs = ", ".join(f"'{name}' with '{on}'" for name, on in hanging.items())
        told.append(f"Learned, and baked, as bones that move with others than their parents: {pairs}")
    above = [bone.name for bone in obj.data.bones[rig.skeleton.roles["hips"]].parent_recursive]
    carried = {*hanging, *carriers(obj, rig), *(name for name in above if _carries_no_other(obj, name, hanging))}
    rest = [name for name in ways if name not in carried]
    if rest:
        more = f" and {len(rest) - 1} more" if len(rest) > 1 else ""
        told.append(
            f"Left out: what keys of bone '{rest[0]}'{more} move away from the parent{_say_far(obj, ways, rest)}"
        )
    return told


def _say_mesh(obj: bpy.types.Object, of_mesh: Sequence[str]) -> str:
    foot = named_feet(obj)[0].name
    return (
        f"Learned, and baked, are the {len(of_mesh)} bones that the mesh follows, as they move with each other: of the "
        f"legs that names tell ('{foot}') it follows none"
    )


def _say_far(obj: bpy.types.Object, ways: Mapping[str, float], names: Sequence[str]) -> str:
    """What is wrong where a part of a body goes farther to and fro than the body is large."""
    farthest, size = max(names, key=lambda name: ways[name]), least_way(obj) / _STRAYS
    if ways[farthest] <= size:
        return ""
    return (
        f". '{farthest}' goes {ways[farthest] / size:.1f} times as far as the body is large, as where a scale was "
        "applied (Ctrl+A) after the Actions were made, which leaves their location keys as they were: import the file "
        "again without that, or scale these keys as the bones were"
    )
