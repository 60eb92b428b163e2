# SPDX-License-Identifier: MIT
"""The simulated objects that the sticks move, one a character, and that the characters are drawn to."""

from __future__ import annotations

import numpy as np
from fragmotion_command.evaluate.rotations import Array, turned

from tools.measuring.peers.kinematics.bodies import RATE
from tools.measuring.peers.kinematics.springs import chased, faded
from tools.measuring.peers.motion_matching.constants import Constants
from tools.measuring.peers.motion_matching.library import AHEAD


class Simulation:
    """N objects: place [N,2] m, heading [N] rad. A control [N,3] is a velocity to the right and forward, m/s, and a
    turn rate, rad/s."""

    def __init__(self, count: int, constants: Constants) -> None:
        self._constants = constants
        self.place, self.heading = np.zeros((count, 2)), np.zeros(count)
        self._velocity, self._acceleration = np.zeros((count, 2)), np.zeros((count, 2))
        self._turning, self._wanted_heading = np.zeros(count), np.zeros(count)
        self._wanted = np.zeros((count, 2))

    def command(self, control: Array, dt: float) -> Array:
        """What is wanted from now on, after dt of turning; how much the wanted velocity changed, [N] m/s."""
        before = self._wanted
        self._wanted = turned(control[:, :2], self.heading)
        self._wanted_heading = self._wanted_heading + control[:, 2] * dt
        changed: Array = np.linalg.norm(self._wanted - before, axis=1)
        return changed

    def step(self, dt: float) -> None:
        """Go on."""
        halflife = self._constants.velocity_halflife
        self.place, self._velocity, self._acceleration = chased(
            self.place, self._velocity, self._acceleration, self._wanted, halflife, dt
        )
        off = self.heading - self._wanted_heading
        off, self._turning = faded(off, self._turning, self._constants.turn_halflife, dt)
        self.heading = self._wanted_heading + off

    def ahead(self, control: Array) -> tuple[Array, Array]:
        """Where the objects will be [N,K,2] and face [N,K] in the frames of AHEAD, if the control is held."""
        place, velocity, acceleration = self.place, self._velocity, self._acceleration
        places, headings, before = [], [], 0
        for frames in AHEAD:
            goal = self._wanted_heading + control[:, 2] * frames / RATE
            off, _ = faded(self.heading - goal, self._turning, self._constants.turn_halflife, frames / RATE)
            headings.append(goal + off)
            wanted = turned(control[:, :2], headings[-1])
            place, velocity, acceleration = chased(
                place, velocity, acceleration, wanted, self._constants.velocity_halflife, (frames - before) / RATE
            )
            places.append(place)
            before = frames
        return np.stack(places, 1), np.stack(headings, 1)
