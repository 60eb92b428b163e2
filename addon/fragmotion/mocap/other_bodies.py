# SPDX-License-Identifier: GPL-3.0-or-later
"""Actions of a smaller or larger body whose bones have the same names: learned as far as this one's legs go."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import bpy

from .actions import played
from .doctor import tell_anew

if TYPE_CHECKING:
    from fragmotion_core import Clip, Rig, Skeleton

_LEG = "fragmotion_leg"
"""Custom property of an Action: how long the leg of the armature is that it was made for, in that one's own units."""

_ALIKE = 0.01  # legs that differ by less are as long: the core's law for an object's scale
_SMALL = 1 / 3  # times: of 115 Actions of 40 files that are as they should be the least is 0.45
_SIDES = ("left", "right")


def times_longer(obj: bpy.types.Object, action: bpy.types.Action, rig: Rig) -> float:
    """How many times as long as the armature's own its bones' ways in the Action are to be: as its legs are to those of
    the armature that the Action was made for, which is kept with it or plays it; 1 where that is this one."""
    roles = rig.skeleton.roles
    own = _leg(obj, roles)
    made_for = action.get(_LEG) or next(_legs_of_others(obj, action, roles), own)
    ratio = own / made_for if own > 0 and isinstance(made_for, (int, float)) and made_for > 0 else 1
    return ratio if abs(ratio - 1) > _ALIKE else 1


def keep_legs(obj: bpy.types.Object, takes: Sequence[bpy.types.Action], rig: Rig) -> list[str]:
    """Keep with each Action for which body it was made, as that may be deleted; and the Doctor tells it. What of it to
    say, if any is of another body."""
    told: list[str] = []
    for action in takes:
        times = times_longer(obj, action, rig)
        if times != 1 and action.library is None:
            action[_LEG] = _leg(obj, rig.skeleton.roles) / times
        text = f"for a body with legs {1 / times:.3g} times as long: its ways are learned {times:.3g} times as far"
        tell_anew(action, "other_body", "info", f"Made {text}" if times != 1 else "")
        told += [f"'{action.name}' was made {text}"] if times != 1 else []
    return [told[0] + (f" (and {len(told) - 1} more like it)" if len(told) > 1 else "")] if told else []


def tell_smaller(action: bpy.types.Action, clips: Sequence[Clip], skeleton: Skeleton) -> str:
    """That an Action may be of a smaller body of which nothing is known, and the Doctor tells it: the hips go up and
    down far less than the legs have them. Empty where they do not."""
    times = max((clip.bobs(skeleton) for clip in clips), default=0)
    text = (
        f"The hips go {times:.2g} times as far up and down as the legs stretch and bend, as in an Action of a smaller "
        "body: if it is, bring that body's armature, which plays it, into the file again until Build has seen it"
    )
    told = text if 0 < times < _SMALL else ""
    tell_anew(action, "smaller_body", "warning", told)
    return told


def keep_own_leg(obj: bpy.types.Object, action: bpy.types.Action, rig: Rig) -> None:
    """The Action's keys are written anew, for this armature."""
    if _LEG in action or times_longer(obj, action, rig) != 1:
        action[_LEG] = _leg(obj, rig.skeleton.roles)


def _legs_of_others(obj: bpy.types.Object, action: bpy.types.Action, roles: dict[str, str]) -> Iterator[float]:
    """Of the armatures that play an Action, where this one does not."""
    if action in played(obj):
        return
    for other in bpy.data.objects:
        leg = _leg(other, roles) if other.type == "ARMATURE" and action in played(other) else 0
        if leg > 0:
            yield leg


def _leg(obj: bpy.types.Object, roles: dict[str, str]) -> float:
    """From the thigh's joint to the foot's along the bones, in the armature's units; 0 where it has no such bones."""
    return next(filter(None, (_way(obj, roles.get(f"{side}_thigh"), roles.get(f"{side}_foot")) for side in _SIDES)), 0)


def _way(obj: bpy.types.Object, thigh: str | None, foot: str | None) -> float:
    bone, way = obj.data.bones.get(foot or ""), 0.0
    while bone is not None and bone.name != thigh:
        way += (bone.head_local - bone.parent.head_local).length if bone.parent else 0
        bone = bone.parent
    return way if bone is not None else 0
