# SPDX-License-Identifier: GPL-3.0-or-later
"""A motion to be baked: where it goes, how it ends as it began, and the rotations of what carries it.

A motion's pose is a root position and bone rotations as the core's Clip has them; its frames [F,3] are the character
frame's x, y (m) and heading (rad). Quaternions are (w, x, y, z).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..compat.core import core

if TYPE_CHECKING:
    from fragmotion_core import Doubles, Ints


class Motion(NamedTuple):
    """Poses at a fixed rate: root positions [F,3], rotations [F,B,4], character frames [F,3] and classes [F]."""

    root_positions: Doubles
    rotations: Doubles
    frames: Doubles
    classes: Ints


def carried(motion: Motion, hips: int, frames: Doubles) -> Motion:
    """The same poses, seen from the character frame, with that frame at `frames` [F,3] or [3]."""
    to = np.broadcast_to(frames, motion.frames.shape)
    roots, rotations, placed = core.carried_motion(*motion[:3], hips, to)
    return Motion(roots, rotations, placed, motion.classes)


def looped(motion: Motion, hips: int, count: int) -> Motion:
    """The motion with its last `count` frames eased so that it ends as it began."""
    roots, rotations, frames = core.looped_motion(*motion[:3], hips, count)
    return Motion(roots, rotations, frames, motion.classes)


def resampled(times: Doubles, motion: Motion, rate: float) -> Motion:
    """A motion shown at `times` [F] (s, ascending from 0) at a fixed rate: straight lines between what was shown."""
    roots, rotations, frames, nearest = core.resampled_motion(times, *motion[:3], rate)
    return Motion(roots, rotations, frames, motion.classes[nearest])


def multiply(a: Doubles, b: Doubles) -> Doubles:
    """Products [..., 4] of quaternions: first b, then a."""
    aw, av, bw, bv = a[..., :1], a[..., 1:], b[..., :1], b[..., 1:]
    real = aw * bw - (av * bv).sum(-1, keepdims=True)
    product: Doubles = np.concatenate((real, aw * bv + bw * av + np.cross(av, bv)), -1)
    return product


def about_z(angles: Doubles) -> Doubles:
    """Rotations [F,4] about the vertical by angles [F]."""
    zero = np.zeros_like(angles)
    return np.stack((np.cos(angles / 2), zero, zero, np.sin(angles / 2)), -1)


def angles_between(a: Doubles, b: Doubles) -> Doubles:
    """Angles in radians between rotations [..., 4]."""
    apart = np.linalg.norm(b - _same_side(b, a), axis=-1)
    angles: Doubles = 4 * np.arcsin(np.clip(apart / 2, 0, 1))
    return angles


def rotation_matrices(rotations: Doubles) -> Doubles:
    """Unit quaternions [..., 4] as matrices [..., 3, 3]."""
    w, x, y, z = np.moveaxis(rotations, -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def _same_side(a: Doubles, b: Doubles) -> Doubles:
    """The quaternions b, negated where that is nearer to a."""
    return np.where((a * b).sum(-1, keepdims=True) < 0, -b, b)
