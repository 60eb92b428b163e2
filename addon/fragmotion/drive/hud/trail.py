# SPDX-License-Identifier: GPL-3.0-or-later
"""The way that something went."""

from __future__ import annotations

import math
from collections import deque

_SPACING = 0.05  # m between points
_LONGEST = 2000  # points

Place = tuple[float, float]


class Trail:
    """The last 100 m of a way on the ground."""

    def __init__(self) -> None:
        self.points: deque[Place] = deque(maxlen=_LONGEST)

    def step(self, place: Place) -> None:
        """It is there now."""
        if not self.points or math.dist(place, self.points[-1]) >= _SPACING:
            self.points.append(place)
