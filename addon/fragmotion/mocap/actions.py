# SPDX-License-Identifier: GPL-3.0-or-later
"""Which of the file's Actions can move an armature."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

import bpy

from ..compat import versions

RATE = "fragmotion_rate"
"""Custom property of an imported Action: the take's frames a second."""

SCENE_RATE = "fragmotion_scene_rate"
"""Custom property of an imported Action: the scene's frames a second when its keys were laid."""

BAKED = "fragmotion_baked"
"""Custom property of an Action that Bake wrote: not to learn from."""

_RATES = (1e-3, 1e5)  # frames a second that a take can have
_BONE = re.compile(r'pose\.bones\["((?:[^"\\]|\\.)*)"\]\.')
_OWN_SHARE = 1 / 2  # of the bones that the Action animates, so many must be the armature's ...
_ARMATURE_SHARE = 1 / 4  # ... and so many of the armature's (fingers and helpers may rest), where others have them, too
_cache: dict[tuple[object, ...], bool] = {}


def rate_of(action: bpy.types.Action, key: str, default: float) -> float:
    """The Action's RATE or SCENE_RATE; the default where it has none, or what it has is no rate."""
    rate = action.get(key, default)
    return float(rate) if isinstance(rate, (int, float)) and _RATES[0] <= rate <= _RATES[1] else default


def animated_bones(action: bpy.types.Action, obj: bpy.types.Object) -> set[str]:
    """Names of the bones that the Action's F-curves move, whether or not the armature has them."""
    paths = {curve.data_path for curve in versions.curves_of(action, obj)}
    return {re.sub(r"\\(.)", r"\1", match[1]) for match in map(_BONE.match, paths) if match}


def fits(action: bpy.types.Action, obj: bpy.types.Object) -> bool:
    """Whether most of what the Action animates is this armature's: many of its bones, or those of no other armature."""
    known = _known_bones(action, obj)
    return known > 0 and (known >= _ARMATURE_SHARE * len(obj.data.bones) or _is_of_it_alone(action, obj))


def _is_of_it_alone(action: bpy.types.Action, obj: bpy.types.Object) -> bool:
    """Whether the armature has all bones that an Action animates, and no other does: an Idle may move a head alone."""
    animated = animated_bones(action, obj)
    having = [armature for armature in bpy.data.armatures if animated <= set(armature.bones.keys())]
    return having == [obj.data]


def with_own_bones(obj: bpy.types.Object) -> Iterator[bpy.types.Action]:
    """The Actions that animate bones of the armature, be they few, and hardly others; bakes, too; but none that another
    armature has and this one has not, as files with several characters of the same bones hold them."""
    others = [each for each in bpy.data.objects if each.type == "ARMATURE" and each != obj]
    foreign = {action for each in others for action in played(each)} - set(played(obj))
    return (action for action in bpy.data.actions if action not in foreign and _known_bones(action, obj) > 0)


def played(obj: bpy.types.Object) -> Iterator[bpy.types.Action]:
    """The Action that an object plays, and those of its NLA strips."""
    data = obj.animation_data
    if data is not None:
        yield from (strip.action for track in data.nla_tracks for strip in track.strips if strip.action)
        yield from (data.action,) if data.action else ()


def _known_bones(action: bpy.types.Action, obj: bpy.types.Object) -> int:
    """How many of the armature's bones an Action animates; 0 where most that it animates are not of it."""
    animated = animated_bones(action, obj)
    known = sum(name in obj.data.bones for name in animated)
    return known if known >= _OWN_SHARE * len(animated) else 0


def fits_cached(action: bpy.types.Action, obj: bpy.types.Object) -> bool:
    """As `fits`, quick enough for drawing; a bake is not offered."""
    if BAKED in action:
        return False
    key = (
        bpy.data.filepath,
        action.name,
        versions.count_curves(action),
        obj.name,
        len(obj.data.bones),
        len(bpy.data.armatures),
    )
    if key not in _cache:
        if len(_cache) > 10_000:
            _cache.clear()
        _cache[key] = fits(action, obj)
    return _cache[key]


def ticked(obj: bpy.types.Object) -> list[bpy.types.Action]:
    """The Actions ticked to be learned from that fit the armature, by name."""
    return [action for action in bpy.data.actions if action.fragmotion.use and fits_cached(action, obj)]


def fitting(obj: bpy.types.Object) -> list[bpy.types.Action]:
    """All Actions that fit the armature, by name."""
    return [action for action in bpy.data.actions if fits_cached(action, obj)]


def common_beginning(names: Sequence[str]) -> str:
    """What all names begin with, up to a blank or a sign between words and short of any whole name; empty for one."""
    if len(names) < 2:
        return ""
    first, last = min(names), max(names)
    shared = first[: next((i for i, pair in enumerate(zip(first, last)) if len(set(pair)) > 1), len(first))]
    words = re.match(r".*[\W_]", shared)
    return words[0] if words and words[0] != first else ""


def is_found(action: bpy.types.Action, search: str) -> bool:
    """Whether the Action's name has the text in it, whatever the case."""
    return search.lower() in action.name.lower()


def seconds_of(action: bpy.types.Action, scene: bpy.types.Scene) -> float:
    """How long the Action is: an imported take in its own time, any other as the scene plays it."""
    first, last = action.frame_range
    return float(last - first) / rate_of(action, SCENE_RATE, scene.render.fps / scene.render.fps_base)


def chosen(context: bpy.types.Context, obj: bpy.types.Object) -> bpy.types.Action | None:
    """The Action that is chosen in the panel's list, or None where it does not fit the armature."""
    index = context.window_manager.fragmotion.active_action
    action = bpy.data.actions[index] if 0 <= index < len(bpy.data.actions) else None
    return action if action is not None and fits_cached(action, obj) else None


def forget() -> None:
    """Let go of what was found out about the file's Actions."""
    _cache.clear()
