# SPDX-License-Identifier: MIT
"""Motions as what the pictures show of them: poses, stitches, and where the feet are and slide."""

from __future__ import annotations

from typing import NamedTuple

import fragmotion_core as core
import numpy as np
from numpy.typing import NDArray

STATURE = 1.8  # m; the lengths below are those of a character of this height
LOW = 0.025  # m over where a ball stands
SLIDING = 0.1  # m/s
_PUSH = 0.2  # s over which a velocity and its change are measured


class Motion(NamedTuple):
    """Poses at a fixed rate, and the frames [S] in which another fragment starts to play."""

    name: str
    rate: float
    roots: core.Doubles  # [F,3]
    rotations: core.Doubles  # [F,B,4]
    path: core.Doubles  # [F,3]: the character frame's x, y and heading
    stitches: NDArray[np.int_]

    @property
    def seconds(self) -> float:
        """From the first pose to the last."""
        return (len(self.roots) - 1) / self.rate

    def acceleration(self, frame: int) -> core.Doubles:
        """Of the hips over the ground [3], m/s^2, as the character frame of the first pose sees it: the change over
        0.2 s of a velocity over 0.2 s, of which the frame is the middle, or the nearest that has as much around it."""
        apart = round(_PUSH * self.rate)
        middle = min(max(frame, apart), len(self.roots) - 1 - apart)
        before, now, after = self.roots[[middle - apart, middle, middle + apart]]
        x, y, _ = (after - 2 * now + before) / _PUSH**2
        cosine, sine = np.cos(self.path[0, 2]), np.sin(self.path[0, 2])
        return np.array([cosine * x + sine * y, cosine * y - sine * x, 0])


def of_performance(name: str, performance: core.Performance) -> Motion:
    """What a player did."""
    stitches = np.flatnonzero(np.diff(performance.entered)) + 1
    p = performance
    return Motion(name, p.rate, p.root_positions, p.rotations, p.path, stitches)


def of_clip(clip: core.Clip, skeleton: core.Skeleton) -> Motion:
    """What a take does."""
    path = clip.character_frames(skeleton)
    path[:, 2] = np.unwrap(path[:, 2])
    return Motion(clip.name, clip.rate, clip.root_positions, clip.rotations, path, np.empty(0, int))


class Feet:
    """Where the balls of a skeleton's feet stand in its takes."""

    def __init__(self, skeleton: core.Skeleton, clips: list[core.Clip]) -> None:
        self._skeleton, self._scale = skeleton, STATURE / skeleton.stature
        self._floors = np.median([self._places(clip)[:, :, 2].min(axis=0) for clip in clips], axis=0)

    def balls(self, motion: Motion) -> core.Doubles:
        """[F,2,3]: the balls of the left and the right foot, over the ground, m."""
        clip = core.Clip(self._skeleton, motion.name, motion.rate, motion.roots, motion.rotations)
        return self._places(clip) - [0, 0, 1] * self._floors[:, None]

    def weights(self, balls: core.Doubles) -> core.Doubles:
        """[F,2]: how much a ball counts in foot skate: 1 on the ground, 0 from LOW on."""
        weights: core.Doubles = np.clip(2 - np.exp2(balls[:, :, 2] * self._scale / LOW), 0, 1)
        return weights

    def planted(self, balls: core.Doubles, rate: float) -> NDArray[np.bool_]:
        """[F,2]: whether a ball is low and does not slide on its way to the next frame."""
        ways = np.diff(balls[:, :, :2], axis=0, append=balls[-1:, :, :2])
        slow = np.linalg.norm(ways, axis=2) * rate * self._scale < SLIDING
        planted: NDArray[np.bool_] = (balls[:, :, 2] * self._scale < LOW) & slow
        return planted

    def _places(self, clip: core.Clip) -> core.Doubles:
        heads, rotations = clip.world_transforms(self._skeleton)
        return np.stack([self._ball(side, heads, rotations) for side in ("left", "right")], axis=1)

    def _ball(self, side: str, heads: core.Doubles, rotations: core.Doubles) -> core.Doubles:
        """The toe's head, else the foot's tip."""
        names, roles = self._skeleton.names, self._skeleton.roles
        if f"{side}_toe" in roles:
            return heads[:, names.index(roles[f"{side}_toe"])]
        foot = names.index(roles[f"{side}_foot"])
        return heads[:, foot] + _rotated(rotations[:, foot], self._skeleton.tips[foot])


def _rotated(rotations: core.Doubles, vector: core.Doubles) -> core.Doubles:
    """A vector [3] by each of the quaternions [F,4]."""
    w, axis = rotations[:, :1], rotations[:, 1:]
    twice = 2 * np.cross(axis, vector)
    return vector + w * twice + np.cross(axis, twice)
