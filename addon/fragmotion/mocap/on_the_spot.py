# SPDX-License-Identifier: GPL-3.0-or-later
"""Takes that go on the spot: learned as if they went the way that their feet tell."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from .doctor import IN_PLACE, tell_anew

if TYPE_CHECKING:
    from fragmotion_core import Clip, Skeleton


def led_by_feet(action: bpy.types.Action, clips: list[Clip], skeleton: Skeleton) -> list[Clip]:
    """An Action's clips on their ways, at the Action's speed where the user told one; and the Doctor tells it."""
    ways = [clip.led_by_feet(skeleton, action.fragmotion.speed) for clip in clips]
    speeds = [way[1] for way in ways if way]
    tell_anew(action, IN_PLACE, "info", _said(max(speeds)) if speeds else "", mendable=True)
    return [way[0] if way else clip for clip, way in zip(clips, ways)]


def _said(speed: float) -> str:
    return f"On the spot: its feet go at {speed:.2f} m/s. It is learned as if it went so; Mend gives its root that way"
