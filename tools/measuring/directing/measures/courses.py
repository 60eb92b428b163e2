# SPDX-License-Identifier: MIT
"""The paths that are followed to measure how well: circles, figures of eight, right angles, random curves."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]

TIGHTEST = 2.0
"""Radius of the tightest bend of a curve, m."""

_STEP = 0.05  # m between the points of a curve
_RANDOM = 4  # random curves


@dataclass(frozen=True)
class Course:
    """A path by its name: points [N,2], m."""

    name: str
    points: Array
    closed: bool = False


def courses(seed: int) -> list[Course]:
    """All that are followed; `seed` draws the random ones."""
    return [
        Course("straight line", np.array([(0.0, 0.0), (0.0, 8.0)])),
        Course("circle, 2 m", circle(TIGHTEST), closed=True),
        Course("circle, 4 m", circle(4.0), closed=True),
        Course("figure of eight, 2 m", eight(TIGHTEST), closed=True),
        Course("figure of eight, 3 m", eight(3.0), closed=True),
        Course("right angles", right_angles(4.0, 5)),
        *(Course(f"random curve {n + 1}", random_curve(seed * _RANDOM + n)) for n in range(_RANDOM)),
    ]


def circle(radius: float) -> Array:
    """Clockwise from the origin, where it goes to +Y."""
    angles = np.linspace(0, 2 * math.pi, math.ceil(2 * math.pi * radius / _STEP), endpoint=False)
    return np.column_stack((radius - radius * np.cos(angles), radius * np.sin(angles)))


def eight(radius: float) -> Array:
    """Two circles that touch at the origin, the second one counter-clockwise."""
    right = circle(radius)
    return np.concatenate((right, right * (-1, 1)))


def right_angles(leg: float, legs: int) -> Array:
    """A staircase of so many legs."""
    steps = [(0.0, leg) if n % 2 == 0 else (leg, 0.0) for n in range(legs)]
    return np.concatenate(([(0.0, 0.0)], np.cumsum(steps, axis=0)))


def random_curve(seed: int, length: float = 21.0) -> Array:
    """A curve whose bend changes evenly from one drawn at random to the next, every 3 m."""
    bends = np.random.default_rng(seed).uniform(-1 / TIGHTEST, 1 / TIGHTEST, round(length / 3) + 1)
    ways = np.arange(0, length, _STEP)
    headings = np.cumsum(np.interp(ways, np.linspace(0, length, len(bends)), bends)) * _STEP
    steps = _STEP * np.column_stack((-np.sin(headings), np.cos(headings)))
    return np.concatenate(([(0.0, 0.0)], np.cumsum(steps, axis=0)))
