# SPDX-License-Identifier: GPL-3.0-or-later
"""A stretch of a recording over which the stick is recorded: before and after it the recording's own controls play."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...recordings.recordings import TRACE_RATE
from ..input.steering import Control

if TYPE_CHECKING:
    from fragmotion_core import Doubles


class Punch:
    """A recording's trace [T,4], of which the controls `first` .. `last` - 1 are taken from the stick."""

    def __init__(self, name: str, trace: Doubles, first: int, last: int, rate: int) -> None:
        """Of the recording of that name, played in so many steps a second."""
        self.name, self.first = name, first
        self._trace, self._last, self._rate = trace, last, rate
        self._steps = 0
        self._taken: list[Control] = []
        self._jumped = False

    def hold(self, control: Control) -> Control:
        """The control for the next step, where the stick says `control`."""
        at = self._steps * TRACE_RATE // self._rate
        self._steps += 1
        if not self.first <= at < self._last:
            return Control(*self._trace[at].tolist()) if at < len(self._trace) else Control()
        self._jumped = self._jumped or control.jump > 0
        if at - self.first == len(self._taken):
            self._taken.append(control._replace(jump=float(self._jumped)))
            self._jumped = False
        return self._taken[-1]

    @property
    def over(self) -> bool:
        """Whether the stretch is behind."""
        return self._steps * TRACE_RATE >= self._last * self._rate

    @property
    def trace(self) -> Doubles:
        """The recording's trace [T,4] with what was taken so far."""
        merged = self._trace.copy()
        if self._taken:
            merged[self.first : self.first + len(self._taken)] = np.array(self._taken, float)
        return merged

    @property
    def rest(self) -> Doubles:
        """The controls [N,4] that are still to be played, one at least."""
        return self._trace[min(self._steps * TRACE_RATE // self._rate, len(self._trace) - 1) :]

    @property
    def begun(self) -> bool:
        """Whether anything was taken."""
        return bool(self._taken)
