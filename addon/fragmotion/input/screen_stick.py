# SPDX-License-Identifier: GPL-3.0-or-later
"""A stick in a corner of the view, for the mouse."""

from __future__ import annotations

import math

from .steering import Intent

RADIUS = 60.0
"""Pixels from the middle to the rim, at a UI scale of 1."""

KNOB = 20.0
"""Radius of the part that is dragged."""

MARGIN = 24.0
"""Pixels between the rim and the sides of the view."""


class ScreenStick:
    """Where the knob is; pixels are of the view's region."""

    label = "On-screen stick"

    def __init__(self) -> None:
        self.held = False
        self.x = self.y = 0.0  # of the knob, within the unit circle
        self.center, self.radius, self.knob = (0.0, 0.0), RADIUS, KNOB

    def place(self, left: float, bottom: float, scale: float) -> None:
        """Stand in the corner of what is free of a view, at a UI scale."""
        self.radius, self.knob = RADIUS * scale, KNOB * scale
        self.center = (left + MARGIN * scale + self.radius, bottom + MARGIN * scale + self.radius)

    def press(self, x: float, y: float) -> bool:
        """Take hold of the knob if the mouse is on the stick; say whether it is."""
        self.held = math.dist((x, y), self.center) <= self.radius
        if self.held:
            self.drag(x, y)
        return self.held

    def drag(self, x: float, y: float) -> None:
        """Move the knob to the mouse, or to the rim."""
        across, up = (x - self.center[0]) / self.radius, (y - self.center[1]) / self.radius
        length = max(math.hypot(across, up), 1.0)
        self.x, self.y = across / length, up / length

    def release(self) -> None:
        """Let the knob spring back."""
        self.held = False
        self.x = self.y = 0.0

    def intent(self) -> Intent:
        return Intent(self.x, self.y)
