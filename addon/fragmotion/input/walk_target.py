# SPDX-License-Identifier: GPL-3.0-or-later
"""A place on the ground that was clicked, as an input: the character goes there."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from ..compat.core import core
from .steering import REST, Control, Intent

if TYPE_CHECKING:
    from fragmotion_core import ControlSpace

NEAR = 0.2
"""m: nearer than that the character is there."""


class WalkTarget:
    """Steers to the place that was clicked last; lets go once the character stands there."""

    label = "Click on the ground"

    def __init__(self) -> None:
        self._follower: Any = None
        self._space: ControlSpace | None = None  # of the style in which the follower steers
        self._place, self._runs = (0.0, 0.0), False
        self._control = Control()

    def go(
        self, space: ControlSpace, frame: tuple[float, float, float], place: tuple[float, float], runs: bool
    ) -> bool:
        """Begin to go from a character frame to a place, at the space's walk or run; whether it is far enough away."""
        if math.dist(frame[:2], place) < NEAR:
            return False
        self._space, self._place, self._runs = space, place, runs
        pace = space.run if runs else space.walk
        self._follower = core.PathFollower(space, core.Path([frame[:2], place]), pace)
        return True

    def steer(self, space: ControlSpace, frame: tuple[float, float, float], seconds: float) -> None:
        """The character is there, so long after the last call, in the style that the space is of."""
        if self._follower is None:
            return
        if space is not self._space and not self.go(space, frame, self._place, self._runs):
            self.release()
            return
        self._control = Control(*self._follower.steer(frame, seconds).tolist())
        if self._follower.stands:
            self.release()

    def release(self) -> None:
        """Stop where it is."""
        self._follower, self._control = None, Control()

    @property
    def place(self) -> tuple[float, float] | None:
        """Where it goes; None where it goes nowhere."""
        return None if self._follower is None else self._place

    def intent(self) -> Intent:
        return REST if self._follower is None else Intent(control=self._control)
