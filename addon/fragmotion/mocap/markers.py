# SPDX-License-Identifier: GPL-3.0-or-later
"""What an animator marks in a take for the game: the markers of its Action.

Those of the scene's timeline are no take's: *Make Markers Local* in the Action Editor gives them to an Action.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy
import numpy as np

if TYPE_CHECKING:
    from fragmotion_core import Doubles

_SAME_FRAME = 0.01


def marks_of(action: bpy.types.Action) -> list[tuple[float, str]]:
    """Scene frames and names of the Action's markers that have one, in order."""
    return sorted({(float(marker.frame), marker.name) for marker in action.pose_markers if marker.name})


def markers_of(action: bpy.types.Action, times: Doubles) -> list[tuple[float, str]]:
    """The Action's markers within the samples at these scene frames, by the sample, from 0."""
    inside = [(frame, name) for frame, name in marks_of(action) if _is_within(frame, times)]
    return [(float(np.interp(frame, times, np.arange(len(times)))), name) for frame, name in inside]


def mark_likewise(source: bpy.types.Action, frames: Doubles, made: bpy.types.Action, times: Doubles) -> None:
    """Mark an Action, whose samples at `times` show the source's at `frames`, as the source is marked."""
    for frame, name in marks_of(source):
        if _is_within(frame, frames):
            made.pose_markers.new(name).frame = round(float(np.interp(frame, frames, times)))


def _is_within(frame: float, times: Doubles) -> bool:
    return bool(times[0] - _SAME_FRAME <= frame <= times[-1] + _SAME_FRAME)
