# SPDX-License-Identifier: GPL-3.0-or-later
"""Which feet stand on the ground while the character is driven, as the core finds it in takes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from mathutils import Quaternion, Vector

from ...compat.core import core

if TYPE_CHECKING:
    from fragmotion_core import Doubles, Skeleton

Point = tuple[float, float, float]

_HEIGHT, _SPEED, _SPEED_SHARE = 0.045, 0.5, 0.2  # m, m/s, and of the hips' speed, for a stature of
_STATURE = 1.8  # m


class Feet:
    """The heel and the ball of each foot that the skeleton has."""

    def __init__(self, skeleton: Skeleton) -> None:
        self._skeleton = skeleton
        self._scale, self._tips = _STATURE / skeleton.stature, np.array(skeleton.tips)
        roles, bone = skeleton.roles, skeleton.names.index
        sides = [side for side in ("left", "right") if f"{side}_foot" in roles]
        self._feet = [bone(roles[f"{side}_foot"]) for side in sides]
        self._toes = [bone(roles[f"{side}_toe"]) if f"{side}_toe" in roles else -1 for side in sides]
        heads, tails = skeleton.rest_heads(), skeleton.rest_tails()
        balls = [heads[toe] if toe >= 0 else tails[foot] for foot, toe in zip(self._feet, self._toes)]
        self._floors = np.array([(heads[foot][2], ball[2]) for foot, ball in zip(self._feet, balls)]).reshape(-1, 2)
        self._last: tuple[Doubles, Doubles] | None = None
        self.planted: list[Point] = []
        """The middles of the feet that stand, at the height of their lower ends, m."""

    def step(self, root: Doubles, rotations: Doubles, seconds: float) -> None:
        """The character has this pose, some seconds after the last."""
        if self._feet and self._last is not None:
            roots, both = np.array((self._last[0], root)), np.array((self._last[1], rotations))
            before, now = self._ends(roots, both)
            self._floors = np.minimum(self._floors, now[:, :, 2])
            limit = _SPEED + _SPEED_SHARE * self._speed(roots[1] - roots[0], seconds)
            low = (now[:, :, 2] - self._floors) * self._scale < _HEIGHT
            stands = (low & (self._speed(now - before, seconds) < limit)).any(axis=1)
            self.planted = [(float(x), float(y), float(z)) for x, y, z in _middles(now)[stands]]
        self._last = root, rotations

    def _speed(self, way: Doubles, seconds: float) -> Doubles:
        speed: Doubles = np.linalg.norm(way, axis=-1) / seconds * self._scale
        return speed

    def _ends(self, roots: Doubles, rotations: Doubles) -> Doubles:
        """Heel and ball of each foot in two poses, [2,feet,2,3] m."""
        heads, turned = core.Clip(self._skeleton, "", 1.0, roots, rotations).world_transforms(self._skeleton)
        ends = np.empty((len(roots), len(self._feet), 2, 3))
        for index, (foot, toe) in enumerate(zip(self._feet, self._toes)):
            ends[:, index, 0] = heads[:, foot]
            for frame in range(len(roots)):
                tip = Quaternion(turned[frame, foot]) @ Vector(self._tips[foot])
                ends[frame, index, 1] = heads[frame, toe] if toe >= 0 else heads[frame, foot] + tip
        return ends


def _middles(ends: Doubles) -> Doubles:
    """The middle of each foot [feet,2,3] on the level of its lower end, [feet,3]."""
    middles: Doubles = ends.mean(axis=1)
    middles[:, 2] = ends[:, :, 2].min(axis=1)
    return middles
