# SPDX-License-Identifier: GPL-3.0-or-later
"""What is seen and read while driving: the ways, the velocities and the figures."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...input.steering import Control, rotate
from ..acting.actor import Actor
from ..acting.slider import Track
from .gauges import Judge, Speedometer, Stopwatch
from .trail import Trail

if TYPE_CHECKING:
    from fragmotion_core import ControlSpace, Doubles


class Readings:
    """All gauges of one drive, or of one recording."""

    def __init__(self, actor: Actor, rate: int) -> None:
        self._actor, self._seconds = actor, 1 / rate
        self._speedometer, self.stopwatch = Speedometer(rate), Stopwatch()
        self.judge = Judge(actor.character) if actor.character is not None else None
        self.path, self.ideal_path = Trail(), Trail()
        self.ideal = Track(actor.frame)
        self.control = Control()

    def step(self, control: Control) -> None:
        """The actor has gone a step under a control."""
        self.control = control
        frame = self._actor.frame
        self._speedometer.step(frame)
        self.stopwatch.step(control, rotate(*self.velocity, -frame[2]), self._seconds, self.space)
        if self.judge is not None:
            self.judge.step(self._actor.player, control, self._seconds)
        self.path.step(frame[:2])
        self.ideal.step(control, self._seconds, self.space)
        self.ideal_path.step(self.ideal.frame[:2])

    @property
    def space(self) -> ControlSpace:
        """What the controls mean for this actor."""
        space: ControlSpace = self._actor.space
        return space

    @property
    def frame(self) -> tuple[float, float, float]:
        """Where the character is, m, and its heading, radians from +Y."""
        return self._actor.frame

    @property
    def level(self) -> float:
        """The height of the ground under the character, m."""
        return float(self._actor.player.ground_level)

    @property
    def standing_feet(self) -> Doubles:
        """Where feet stand [0 .. 2,3], m; none where the body is shown elsewhere than it is played."""
        feet: Doubles = self._actor.player.standing_feet
        return feet[:0] if self._actor.is_joined else feet

    @property
    def velocity(self) -> tuple[float, float]:
        """The character's, in the world, m/s."""
        return self._speedometer.velocity

    @property
    def commanded(self) -> tuple[float, float]:
        """The control's velocity, in the world, m/s."""
        return rotate(self.control.right, self.control.forward, self._actor.frame[2])
