# SPDX-License-Identifier: GPL-3.0-or-later
"""Takes that go on the spot: learned as if they went the way that their feet tell."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ..compat.core import command
from .doctor import IN_PLACE, UNTOLD, tell_anew
from .left_out import source_of
from .sampling import sample_times

if TYPE_CHECKING:
    from fragmotion_command.takes import Led, led_by_feet, part_of
    from fragmotion_core import Clip, Doubles, Skeleton
else:
    led_by_feet, part_of = command("takes").led_by_feet, command("takes").part_of

_UNTOLD = (
    "On the spot, and its feet do not tell how fast it goes: it is learned so, or as if it went ahead at the Speed "
    "that you give"
)
_PARTS = "in_place_parts"  # the code of a finding that parts of a take go on the spot


def lead_by_feet(
    scene: bpy.types.Scene, obj: bpy.types.Object, action: bpy.types.Action, clips: list[Clip], skeleton: Skeleton
) -> list[Clip]:
    """An Action's clips on their ways, at the Action's speed where the user told one; and the Doctor tells it. Motions
    that follow each other in one Action are parts of it, each on its own way."""
    if any(row.code == IN_PLACE and row.mended for row in action.fragmotion.findings):
        clips = [clip.as_led() for clip in clips]
    ways = [led_by_feet(clip, skeleton, action.fragmotion.speed) for clip in clips]
    times = np.empty(0) if all(_is_whole(way) for way in ways) else sample_times(scene, obj, action)
    speeds = [way[0].speed for way in ways if _is_whole(way) and way[0].speed and way[0].by_feet]
    parts = [
        (_first(clip, times) + led.first, led)
        for clip, way in zip(clips, ways)
        for led in way
        if led.speed and not _is_whole(way)
    ]
    untold = [clip for clip, way in zip(clips, ways) if _is_untold(clip, way, skeleton)]
    tell_anew(action, UNTOLD, "info", _UNTOLD if untold else "")
    tell_anew(action, IN_PLACE, "info", _said(max(speeds)) if speeds else "", mendable=True)
    tell_anew(action, _PARTS, "info", _said_of_parts(parts, times) if parts else "")
    return [clip for whole, way in zip(clips, ways) for clip in _clips(whole, way, action.name, skeleton, times)]


def _is_whole(way: Sequence[Led]) -> bool:
    return len(way) == 1 and way[0].first == 0


def _is_untold(clip: Clip, way: Sequence[Led], skeleton: Skeleton) -> bool:
    """Whether it may go, and its feet do not tell how fast."""
    return _is_whole(way) and (not way[0].by_feet or (not way[0].speed and clip.may_go(skeleton)))


def say_untold(actions: Sequence[bpy.types.Action]) -> list[str]:
    """Which of these Actions may go, and stay on the spot, as neither their feet nor the user tells how fast."""
    names = [
        f"'{action.name}'"
        for action in actions
        if not action.fragmotion.speed and any(row.code == UNTOLD for row in action.fragmotion.findings)
    ]
    if not names:
        return []
    more = f" and {len(names) - 1} more" if len(names) > 1 else ""
    return [
        f"{names[0]}{more} is learned on the spot, as its feet do not tell how fast it goes: if it is a gait, give its "
        "Speed in Doctor, and Build again"
    ]


def _clips(whole: Clip, way: Sequence[Led], name: str, skeleton: Skeleton, times: Doubles) -> list[Clip]:
    """Parts are named as those around frames that are left out."""
    if _is_whole(way):
        return [way[0].clip]
    begins = [times[_first(whole, times) + led.first] for led in way]
    return [
        part_of(led.clip, skeleton, f"{name} from {begin:g}", slice(0, len(led.clip.root_positions)))
        for led, begin in zip(way, begins)
    ]


def _first(clip: Clip, times: Doubles) -> int:
    """The sample of an Action with which a clip of it begins."""
    begin = source_of(clip.name)[1]
    return 0 if begin is None else int(np.abs(times - begin).argmin())


def _said(speed: float) -> str:
    return f"On the spot: its feet go at {speed:.2f} m/s. It is learned as if it went so; Mend gives its root that way"


def _said_of_parts(parts: Sequence[tuple[int, Led]], times: Doubles) -> str:
    told = ", ".join(
        f"{times[first]:g} to {times[first + len(led.clip.root_positions) - 1]:g} ({led.speed:.2f} m/s)"
        for first, led in parts
    )
    return (
        f"Several motions follow each other. Of these go on the spot, and are learned as if they went: frames {told}. "
        "What leads from one to the next is not learned; leave out what is no gait and no stand"
    )
