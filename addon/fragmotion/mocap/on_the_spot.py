# SPDX-License-Identifier: GPL-3.0-or-later
"""Takes that go on the spot: learned as if they went the way that their feet tell."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from .doctor import IN_PLACE

if TYPE_CHECKING:
    from fragmotion_core import Clip, Skeleton


def led_by_feet(action: bpy.types.Action, clips: list[Clip], skeleton: Skeleton) -> list[Clip]:
    """An Action's clips on their ways, at the Action's speed where the user told one; and the Doctor tells it."""
    ways = [clip.led_by_feet(skeleton, action.fragmotion.speed) for clip in clips]
    _tell(action, [way[1] for way in ways if way])
    return [way[0] if way else clip for clip, way in zip(clips, ways)]


def _tell(action: bpy.types.Action, speeds: list[float]) -> None:
    findings = action.fragmotion.findings
    for index in reversed([i for i, row in enumerate(findings) if row.code == IN_PLACE and not row.mended]):
        findings.remove(index)
    if speeds and action.library is None:
        row = findings.add()
        row.code, row.severity, row.mendable = IN_PLACE, "info", True
        row.text = (
            f"On the spot: its feet go at {max(speeds):.2f} m/s. It is learned as if it went so; Mend gives its root "
            "that way"
        )
