# SPDX-License-Identifier: GPL-3.0-or-later
"""The mathematics of a bake, without Blender: where a motion goes, how it ends as it began, and which keys it needs.

A motion's pose is a root position and bone rotations as the core's Clip has them; its frames [F,3] are the character
frame's x, y (m) and heading (rad). Quaternions are (w, x, y, z).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

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
    frames = np.broadcast_to(frames, motion.frames.shape)
    turns = frames[:, 2] - motion.frames[:, 2]
    cos, sin = np.cos(turns), np.sin(turns)
    x, y = (motion.root_positions[:, :2] - motion.frames[:, :2]).T
    roots = np.column_stack((cos * x - sin * y, sin * x + cos * y, motion.root_positions[:, 2]))
    roots[:, :2] += frames[:, :2]
    rotations = motion.rotations.copy()
    rotations[:, hips] = multiply(about_z(turns), rotations[:, hips])
    return Motion(roots, rotations, frames, motion.classes)


def looped(motion: Motion, hips: int, count: int) -> Motion:
    """The motion with its last `count` frames eased so that it ends as it began.

    Seen from the character frame, the last pose is the first one, and the one before leads up to it at the first's
    velocity; the path's last step is its first.
    """
    last = len(motion.frames) - 1
    count = min(max(count, 2), last)
    if last < 2:
        return motion
    still = carried(motion, hips, np.zeros(3))
    return carried(_eased(still, count), hips, _looped_path(motion.frames, count))


def resampled(times: Doubles, motion: Motion, rate: float) -> Motion:
    """A motion shown at `times` [F] (s, ascending from 0) at a fixed rate: straight lines between what was shown."""
    at = np.arange(round(times[-1] * rate) + 1) / rate
    after = np.clip(np.searchsorted(times, at), 1, max(len(times) - 1, 1)) % len(times)
    before = np.maximum(after - 1, 0)
    gap = np.where(times[after] > times[before], times[after] - times[before], 1)
    weight = np.clip((at - times[before]) / gap, 0, 1)

    def between(values: Doubles) -> Doubles:
        share = weight.reshape(-1, *[1] * (values.ndim - 1))
        mixed: Doubles = (1 - share) * values[before] + share * values[after]
        return mixed

    near = _same_side(motion.rotations[before], motion.rotations[after])
    share = weight[:, None, None]
    rotations = (1 - share) * motion.rotations[before] + share * near
    rotations /= np.linalg.norm(rotations, axis=-1, keepdims=True)
    nearest = np.where(weight < 0.5, before, after)
    return Motion(between(motion.root_positions), rotations, between(motion.frames), motion.classes[nearest])


def thinned(values: Doubles, tolerance: float) -> Ints:
    """Indices of the rows of values [F,K] to keep, so that straight lines between them pass all others within a
    distance of `tolerance` (Douglas and Peucker 1973)."""
    kept, spans = {0, len(values) - 1}, [(0, len(values) - 1)]
    while spans:
        first, last = spans.pop()
        if last - first < 2:
            continue
        share = np.arange(1, last - first)[:, None] / (last - first)
        line = (1 - share) * values[first] + share * values[last]
        distances = np.square(values[first + 1 : last] - line).sum(1)
        furthest = int(distances.argmax())
        if distances[furthest] > tolerance**2:
            middle = first + 1 + furthest
            kept.add(middle)
            spans += [(first, middle), (middle, last)]
    return np.array(sorted(kept), np.int32)


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


def _eased(still: Motion, count: int) -> Motion:
    """Poses of a character frame that rests, the last `count` of them eased to the first."""
    roots, rotations = still.root_positions.copy(), still.rotations.copy()
    part = slice(len(roots) - 1 - count, None)
    before = 2 * roots[0] - roots[1]
    roots[part] += _offsets(roots[0] - roots[-1], before - roots[-2], count)
    lead_in = multiply(multiply(rotations[0], _inverse(rotations[1])), rotations[0])
    at_end = _to_vector(multiply(rotations[0], _inverse(rotations[-1])))
    before_end = _to_vector(multiply(lead_in, _inverse(rotations[-2])))
    rotations[part] = multiply(_from_vector(_offsets(at_end, before_end, count)), rotations[part])
    return Motion(roots, rotations, still.frames, still.classes)


def _offsets(at_end: Doubles, before_end: Doubles, count: int) -> Doubles:
    """Offsets [count + 1, ...] that leave 0 without velocity and are as told in the last frame and the one before."""
    share = np.arange(count + 1).reshape(-1, *[1] * at_end.ndim) / count
    rise, swing = share**2 * (3 - 2 * share), share**3 - share**2
    slope = (before_end - rise[-2] * at_end) / swing[-2]
    offsets: Doubles = rise * at_end + swing * slope
    return offsets


def _looped_path(frames: Doubles, count: int) -> Doubles:
    """Character frames whose last steps are eased to the first one, each step seen from the frame where it begins."""
    steps = _turned(np.diff(frames, axis=0), -frames[:-1, 2])
    share = (np.arange(1, count + 1) / count)[:, None]
    weight = share**2 * (3 - 2 * share)
    steps[-count:] += weight * (steps[0] - steps[-count:])
    headings = frames[0, 2] + np.concatenate(([0], np.cumsum(steps[:, 2])))
    return np.concatenate((frames[:1], frames[0] + np.cumsum(_turned(steps, headings[:-1]), axis=0)))


def _turned(steps: Doubles, angles: Doubles) -> Doubles:
    """Steps [F,3] turned about the vertical by angles [F]."""
    cos, sin = np.cos(angles), np.sin(angles)
    return np.column_stack((cos * steps[:, 0] - sin * steps[:, 1], sin * steps[:, 0] + cos * steps[:, 1], steps[:, 2]))


def _inverse(rotations: Doubles) -> Doubles:
    return rotations * (1, -1, -1, -1)


def _same_side(a: Doubles, b: Doubles) -> Doubles:
    """The quaternions b, negated where that is nearer to a."""
    return np.where((a * b).sum(-1, keepdims=True) < 0, -b, b)


def _to_vector(rotations: Doubles) -> Doubles:
    """Rotations [..., 4] as axis times angle [..., 3], by the shorter way."""
    rotations = _same_side(np.array([1.0, 0, 0, 0]), rotations)
    sines = np.linalg.norm(rotations[..., 1:], axis=-1, keepdims=True)
    angles = 2 * np.arctan2(sines, rotations[..., :1])
    vector: Doubles = np.where(sines > 0, angles / np.where(sines > 0, sines, 1), 2) * rotations[..., 1:]
    return vector


def _from_vector(vectors: Doubles) -> Doubles:
    """Inverse of `_to_vector`."""
    angles = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return np.concatenate((np.cos(angles / 2), np.sinc(angles / (2 * np.pi)) / 2 * vectors), -1)
