# SPDX-License-Identifier: GPL-3.0-or-later
"""A motion to be baked: where it goes, and how it ends as it began.

A motion's pose is a root position and bone rotations as the core's Clip has them; its path [F,3] is the character
frame's x, y (m) and heading (rad). Quaternions are (w, x, y, z).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..compat.core import core

if TYPE_CHECKING:
    from fragmotion_core import Doubles, Ints


class Motion(NamedTuple):
    """Poses at a fixed rate: root positions [F,3], rotations [F,B,4], path [F,3] and classes [F]."""

    root_positions: Doubles
    rotations: Doubles
    path: Doubles
    classes: Ints


def carried(motion: Motion, hips: int, path: Doubles) -> Motion:
    """The same poses, seen from the character frame, with that frame at `path` [F,3] or [3]."""
    to = np.broadcast_to(path, motion.path.shape)
    roots, rotations, placed = core.carried_motion(*motion[:3], hips, to)
    return Motion(roots, rotations, placed, motion.classes)


def looped(motion: Motion, hips: int, count: int) -> Motion:
    """The motion with its last `count` frames eased so that it ends as it began."""
    roots, rotations, path = core.looped_motion(*motion[:3], hips, count)
    return Motion(roots, rotations, path, motion.classes)


def resampled(times: Doubles, motion: Motion, rate: float) -> Motion:
    """A motion shown at `times` [F] (s, ascending from 0) at a fixed rate: straight lines between what was shown."""
    roots, rotations, path, nearest = core.resampled_motion(times, *motion[:3], rate)
    return Motion(roots, rotations, path, motion.classes[nearest])
