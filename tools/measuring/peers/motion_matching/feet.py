# SPDX-License-Identifier: MIT
"""Feet that stay where they came down, by inverse kinematics, until the take lifts them or they are too far off."""

from __future__ import annotations

import numpy as np
from fragmotion_command.evaluate.rotations import Array

from tools.measuring.peers.kinematics.bodies import RATE, Body, world
from tools.measuring.peers.kinematics.legs import set_balls
from tools.measuring.peers.kinematics.springs import faded
from tools.measuring.peers.motion_matching.constants import Constants


class FootLock:
    """The balls of N characters' feet, [N,2,3] m. What is shown of each is where its pose has it or, while it is
    locked, the point where it came down, and an offset that fades."""

    def __init__(self, body: Body, hinges: Array, floors: Array, count: int, constants: Constants) -> None:
        """`hinges` [2,3]: knee_hinges(); `floors` [2]: where balls stand, m of a character of 1.8 m."""
        self._body, self._hinges, self._constants = body, hinges, constants
        self._floors = floors / body.scale
        self._touched, self._locked = np.zeros((count, 2), bool), np.zeros((count, 2), bool)
        self._point, self._off, self._off_velocity = (np.zeros((count, 2, 3)) for _ in range(3))
        self._posed: Array | None = None

    def applied(self, root: Array, rotations: Array, touches: Array) -> Array:
        """The rotations [N,B,4] of the next frame with the feet locked; `touches` [N,2]: the takes' contacts."""
        posed = world(self._body, root, rotations, self._body.leg_bones)[0][:, self._body.toes]
        velocity = np.zeros_like(posed) if self._posed is None else (posed - self._posed) * RATE
        if self._posed is not None:
            halflife = self._constants.lock_halflife
            self._off, self._off_velocity = faded(self._off, self._off_velocity, halflife, 1 / RATE)
        shown = np.where(self._locked[..., None], self._point, posed) + self._off
        self._switch(shown, posed, velocity, touches)
        self._touched, self._posed = touches.copy(), posed
        shown[..., 2] = np.maximum(shown[..., 2], self._floors)
        reserve = self._constants.reserve / self._body.scale
        return set_balls(self._body, self._hinges, root, rotations, shown, reserve)

    def _switch(self, shown: Array, posed: Array, velocity: Array, touches: Array) -> None:
        """Lock the feet that come down, and let go of those that rise or are dragged; offsets take up the change."""
        away = np.linalg.norm(self._point - posed, axis=-1)
        dragged = away > self._constants.unlock / self._body.scale
        lock = ~self._touched & touches
        free = ~lock & self._locked & ((self._touched & ~touches) | dragged)
        self._point[lock] = shown[lock]
        self._point[..., 2] = np.where(lock, self._floors, self._point[..., 2])
        change = (posed - self._point) * (lock.astype(float) - free)[..., None]
        self._off = self._off + change
        self._off_velocity = self._off_velocity + velocity * (lock.astype(float) - free)[..., None]
        self._locked = (self._locked | lock) & ~free
