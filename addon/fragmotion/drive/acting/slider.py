# SPDX-License-Identifier: GPL-3.0-or-later
"""What is driven before there is a policy: the resting body slides as the controls say (Sec. 3.2)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from mathutils import Quaternion

from ...input.steering import Control, rotate

if TYPE_CHECKING:
    from fragmotion_core import ControlSpace, Doubles, Skeleton

_UP = (0, 0, 1)


class Track:
    """A character frame that follows controls exactly."""

    def __init__(self, frame: tuple[float, float, float]) -> None:
        self.frame = frame

    def step(self, control: Sequence[float], seconds: float, space: ControlSpace) -> None:
        """Go on for some seconds, in a direction half way through the turn, as the space means the control."""
        (right, forward, turn, _), (x, y, heading) = control, self.frame
        angle = turn * space.turn_rate * seconds
        across, along = rotate(right, forward, heading + angle / 2)
        self.frame = (x + seconds * across, y + seconds * along, heading + angle)


class Slider:
    """Plays a skeleton's rest pose as core.Player plays a character."""

    standing_feet = np.empty((0, 3))
    """None stands: the body slides."""
    ground_level = ground_missed = 0.0

    def __init__(self, skeleton: Skeleton, space: ControlSpace) -> None:
        self._space = space
        self._hips = skeleton.names.index(skeleton.roles["hips"])
        self._height = skeleton.rest_heads()[self._hips][2]
        self._upright = _world_rotation(skeleton, self._hips)
        self._facing = _facing(skeleton)
        self._rotations = np.array(skeleton.rest_rotations)
        self.reset()

    def reset(self, x: float = 0.0, y: float = 0.0, heading: float = 0.0) -> None:
        """Stand at a place, facing `heading`."""
        self._track = Track((x, y, heading))

    def step(self, control: Control, seconds: float) -> tuple[Doubles, Doubles]:
        """Slide on, and return the pose as core.Player does."""
        self._track.step(control, seconds, self._space)
        x, y, heading = self.frame
        self._rotations[self._hips] = Quaternion(_UP, heading - self._facing) @ self._upright
        return np.array((x, y, self._height)), self._rotations.copy()

    @property
    def frame(self) -> tuple[float, float, float]:
        return self._track.frame


def _world_rotation(skeleton: Skeleton, bone: int) -> Quaternion:
    """A bone's rotation at rest."""
    rotation = Quaternion(skeleton.rest_rotations[bone])
    parent = skeleton.parents[bone]
    return rotation if parent < 0 else _world_rotation(skeleton, parent) @ rotation


def _facing(skeleton: Skeleton) -> float:
    """Where the body at rest faces, square to the line between its thighs; -Y where it has none."""
    roles = skeleton.roles
    if "left_thigh" not in roles or "right_thigh" not in roles:
        return math.pi
    heads = skeleton.rest_heads()
    across = heads[skeleton.names.index(roles["right_thigh"])] - heads[skeleton.names.index(roles["left_thigh"])]
    return math.atan2(across[1], across[0])
