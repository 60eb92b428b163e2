# SPDX-License-Identifier: GPL-3.0-or-later
"""A stretch cut out of a recording, and recordings glued to one: where the poses fit best, and stitched there."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import bpy
import numpy as np

from ..character.building import load
from ..compat.core import core
from ..errors import UserError, core_errors
from ..recordings.asked import joined_asked
from ..recordings.curves import renew_curves
from ..recordings.recordings import TRACE_RATE, Recording, asked_between, set_asked, trace_of
from ..rig.motion import Motion
from .replaying import STEPS, as_shown, joined, keep, shown_poses

if TYPE_CHECKING:
    from fragmotion_core import Doubles

_SEARCH = 5  # controls before a seam, and after it, within which the poses may fit better
_BEFORE, _AFTER = 2, 3  # of them to either side of a cut: half a second together


class Seam(NamedTuple):
    """The first's controls up to `end` go on with the second's from `beginning`; how far apart the poses are there, in
    metres a bone, where there are any."""

    end: int
    beginning: int
    distance: float | None


def cut_out(obj: bpy.types.Object, recording: Recording, start: float, end: float) -> Seam:
    """Take the seconds from `start` to `end` out of the middle, and up to half a second more, so that the poses fit.
    What follows is carried to where the character is then, and from 0.8 s on is as it was."""
    trace, shown = trace_of(recording), shown_poses(obj, recording)
    asked = _stretch(recording, len(trace), start, end)
    return _glue(obj, (recording, trace, shown), (recording, trace, shown), _seams_near(*asked, len(trace)), asked)


def cut_finder(obj: bpy.types.Object, recording: Recording) -> Callable[[float, float], Seam]:
    """What tells where `cut_out` would cut the recording as it is now, and how well the poses fit there, of the same
    seconds; nothing changes."""
    length, shown = len(trace_of(recording)), shown_poses(obj, recording)

    def find(start: float, end: float) -> Seam:
        asked = _stretch(recording, length, start, end)
        return Seam(*asked, None) if shown is None else _find_seam(obj, shown, shown, _seams_near(*asked, length))

    return find


def fit_in_words(seam: Seam) -> str:
    """How well the poses fit, for the end of a sentence; empty where there are none."""
    apart = seam.distance
    return "" if apart is None else f"; there the poses are {100 * apart:.0f} cm apart, and are stitched"


def _stretch(recording: Recording, length: int, start: float, end: float) -> tuple[int, int]:
    """The controls, of `length`, between which a recording is to be cut; UserError where that is no stretch of its
    middle."""
    first, last = round(max(start, 0) * TRACE_RATE), min(round(end * TRACE_RATE), length)
    if not 0 < first < last < length:
        raise UserError(
            f"Recording '{recording.name}' lasts {recording.seconds:.1f} s: from {start:.1f} s to {end:.1f} s is no "
            "stretch of its middle. Trim takes off its ends"
        )
    return first, last


def _seams_near(first: int, last: int, length: int) -> tuple[list[int], list[int]]:
    """The controls, of `length`, between which it may be cut where `first` and `last` are asked for."""
    ends = range(max(first - _BEFORE, 1), first + 1)
    beginnings = range(last, min(last + _AFTER, length - 1) + 1)
    return list(ends), list(beginnings)


def append(obj: bpy.types.Object, recording: Recording, other: Recording) -> Seam:
    """Let the other recording follow, from where the character is then; up to half a second at the end of the one and
    at the beginning of the other is left out, so that the poses fit."""
    trace, following = trace_of(recording), trace_of(other)
    shown, shown_next = shown_poses(obj, recording), shown_poses(obj, other)
    length = len(trace) if shown is None else min(len(trace), (len(shown.classes) - 1) // STEPS)
    ends = range(max(length - _SEARCH, 1), length + 1)
    beginnings = range(min(_SEARCH, len(following) - 1) + 1)
    seams = (list(ends), list(beginnings))
    return _glue(obj, (recording, trace, shown), (other, following, shown_next), seams, (length, 0))


def _glue(
    obj: bpy.types.Object,
    first: tuple[Recording, Doubles, Motion | None],
    second: tuple[Recording, Doubles, Motion | None],
    seams: tuple[list[int], list[int]],
    asked: tuple[int, int],
) -> Seam:
    """Keep a recording's trace and what it asked for and showed up to a control, and then another's from a control on,
    as the first recording."""
    (recording, trace, shown), (other, following, shown_next) = first, second
    if shown is None or shown_next is None:
        seam, both = Seam(*asked, None), None
    else:
        seam = _find_seam(obj, shown, shown_next, seams)
        both = joined(load(obj), shown, seam.end * STEPS, shown_next, seam.beginning * STEPS)
    glued = np.concatenate((trace[: seam.end], following[seam.beginning :]))
    rest = asked_between(other, seam.beginning, len(following))
    set_asked(recording, joined_asked(asked_between(recording, 0, seam.end), seam.end, rest))
    keep(obj, recording, glued, both)
    renew_curves(obj, recording)
    return seam


def _find_seam(obj: bpy.types.Object, first: Motion, second: Motion, seams: tuple[list[int], list[int]]) -> Seam:
    ends, beginnings = ([STEPS * control for control in controls] for controls in seams)
    ends = [frame for frame in ends if frame < len(first.classes)]
    beginnings = [frame for frame in beginnings if frame < len(second.classes)]
    with core_errors("Joining"):
        end, beginning, distance = core.find_seam(
            load(obj).skeleton, as_shown(first), ends, as_shown(second), beginnings
        )
    return Seam(end // STEPS, beginning // STEPS, distance)
