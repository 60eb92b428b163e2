# SPDX-License-Identifier: MIT
"""Critically damped springs, solved exactly for any time step. A half-life is the time, s, in which an offset
halves."""

from __future__ import annotations

import numpy as np
from fragmotion_command.evaluate.rotations import Array


def stiffness(halflife: float) -> float:
    """Half the damping of the spring that has about this half-life."""
    return 2 * float(np.log(2.0)) / (halflife + 1e-5)


def faded(offset: Array, velocity: Array, halflife: float, dt: float) -> tuple[Array, Array]:
    """An offset on its way to nothing, and its velocity, dt later."""
    y = stiffness(halflife)
    slope, left = velocity + offset * y, np.exp(-y * dt)
    return left * (offset + slope * dt), left * (velocity - slope * y * dt)


def chased(
    place: Array, velocity: Array, acceleration: Array, goal: Array, halflife: float, dt: float
) -> tuple[Array, Array, Array]:
    """A place whose velocity is on its way to a goal, its velocity and its acceleration, dt later."""
    y = stiffness(halflife)
    off = velocity - goal
    slope, left = acceleration + off * y, np.exp(-y * dt)
    place = place + left * (-slope / (y * y) + (-off - slope * dt) / y) + slope / (y * y) + off / y + goal * dt
    return place, left * (off + slope * dt) + goal, left * (acceleration - slope * y * dt)


def share(halflife: float, dt: float) -> float:
    """How much of an offset is gone after dt when it halves in a half-life."""
    return 1 - float(np.exp(-np.log(2.0) * dt / (halflife + 1e-5)))
