# SPDX-License-Identifier: GPL-3.0-or-later
"""What is read off while the character is driven."""

from __future__ import annotations

import math
from collections import deque
from typing import TYPE_CHECKING

import numpy as np

from ...character.building import in_styles
from ...input.steering import Control

if TYPE_CHECKING:
    from fragmotion_core import Character, ControlSpace, Player

_WINDOW = 0.1  # s over which a velocity is measured
_SHARE = 0.9  # of a step of the command, after which it counts as answered
_STEP = 0.3  # m/s: smaller steps are not timed
_PATIENCE = 3.0  # s after which a step counts as unanswered


class Speedometer:
    """The character's velocity over the last tenth of a second."""

    def __init__(self, rate: int) -> None:
        self._rate = rate
        self._frames: deque[tuple[float, float, float]] = deque(maxlen=max(round(_WINDOW * rate), 1) + 1)

    def step(self, frame: tuple[float, float, float]) -> None:
        """The character stands there now."""
        self._frames.append(frame)

    @property
    def velocity(self) -> tuple[float, float]:
        """In the world, m/s."""
        if len(self._frames) < 2:
            return 0.0, 0.0
        (x, y, _), (to_x, to_y, _) = self._frames[0], self._frames[-1]
        seconds = (len(self._frames) - 1) / self._rate
        return (to_x - x) / seconds, (to_y - y) / seconds


class Stopwatch:
    """How long the character takes to answer a step of the commanded velocity."""

    def __init__(self) -> None:
        self._asked: tuple[float, ...] = ()  # the velocity of the space that is nearest
        self._before = self._wanted = (0.0, 0.0)
        self._since: float | None = None
        self.seconds: float | None = None
        """Of the last step that was answered."""

    def step(self, control: Control, velocity: tuple[float, float], seconds: float, space: ControlSpace) -> None:
        """Some seconds have gone under a control of the space; the velocity is in the character frame."""
        asked = tuple(space.points[space.nearest([control])[0]][:2].tolist())
        if asked != self._asked:
            self._asked, self._before, self._wanted = asked, velocity, (control.right, control.forward)
            self._since = 0.0 if math.dist(self._before, self._wanted) > _STEP else None
        if self._since is None:
            return
        self._since += seconds
        way = np.subtract(self._wanted, self._before)
        if np.subtract(velocity, self._before) @ way >= _SHARE * way @ way:
            self.seconds, self._since = self._since, None
        elif self._since > _PATIENCE:
            self.seconds, self._since = None, None


class Judge:
    """Eq. 2 of what plays, now and on the whole, and how long the fragment still lasts."""

    def __init__(self, character: Character) -> None:
        self._evident = [styled.evident[styled.representatives] for styled in in_styles(character)]
        self._style = 0
        self._total = self._seconds = 0.0
        self.playing_class = 0
        self.quality = 0.0
        """Of the transition that led here and the control, 0 .. 1."""
        self.left = 0.0
        """Seconds until the fragment ends."""

    def step(self, player: Player, control: Control, seconds: float) -> None:
        """Some seconds have gone under a control."""
        self.playing_class, self.left = player.playing[0], player.seconds_left
        self._style = player.playing_style
        self.quality = player.quality(control)
        self._total += self.quality * seconds
        self._seconds += seconds

    @property
    def mean(self) -> float:
        """Quality over the whole time, 0 .. 1."""
        return self._total / self._seconds if self._seconds > 0 else 0.0

    @property
    def evident(self) -> Control:
        """What the class visibly does (Sec. 3.2)."""
        return Control(*self._evident[self._style][self.playing_class])
