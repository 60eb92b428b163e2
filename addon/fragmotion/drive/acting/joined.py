# SPDX-License-Identifier: GPL-3.0-or-later
"""What a recording showed, and what is played joined on to it, while it is played: just as Record Over keeps it."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ...edits.replaying import joined
from ...recordings.recordings import POSE_RATE
from ...rig.motion import Motion

if TYPE_CHECKING:
    from fragmotion_core import Character, Doubles

_SETTLED = POSE_RATE  # poses after which what is joined on is only carried elsewhere


class Pose(NamedTuple):
    """Root position [3], rotations [B,4], and the character frame."""

    root: Doubles
    rotations: Doubles
    frame: tuple[float, float, float]


class Joined:
    """It shows the recording's own poses, POSE_RATE a second, until `take_over` or their end; from there on what is
    played, carried to where the character is then and stitched."""

    def __init__(self, character: Character, shown: Motion, begin: Pose) -> None:
        """`begin`: the pose before the first step."""
        self._character, self._shown, self._end = character, shown, len(shown.path) - 1
        self._steps, self._seam = 0, [begin]  # the poses that are played in the moment of the seam, and before it

    def take_over(self) -> None:
        """Show what is played from the next step on."""
        self._end = min(self._end, self._steps)

    def show(self, played: Pose) -> Pose:
        """What is shown for the pose that the next step has led to."""
        self._steps += 1
        after = self._steps - self._end
        if after <= 0:
            self._seam = [*self._seam[-1:], played]
            shown = self._shown
            return Pose(shown.root_positions[self._steps], shown.rotations[self._steps], tuple(shown.path[self._steps]))
        last = min(self._end, 1)
        recent, (roots, rotations, path, classes) = slice(self._end - last, self._end + 1), self._shown
        before = Motion(roots[recent], rotations[recent], path[recent], classes[recent])
        both = joined(self._character, before, last, _motion([*self._seam, *[played] * min(after, _SETTLED)]), last)
        return Pose(both.root_positions[-1], both.rotations[-1], tuple(both.path[-1]))


def _motion(poses: list[Pose]) -> Motion:
    roots, rotations, frames = zip(*poses)
    return Motion(np.array(roots), np.array(rotations), np.array(frames), np.zeros(len(poses), np.int32))
