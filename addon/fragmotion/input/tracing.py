# SPDX-License-Identifier: GPL-3.0-or-later
"""A trace as an input."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ..recordings.looks import Aim, LookChange, look_before
from ..recordings.reaches import Holds, ReachChange, holds_before
from ..recordings.recordings import TRACE_RATE
from .steering import REST, Control, Intent

if TYPE_CHECKING:
    from fragmotion_core import Doubles


class TraceInput:
    """Plays a trace once, step by step; stands before and after."""

    label = "Trace"

    def __init__(self, rate: int) -> None:
        self._rate = rate  # steps a second
        self._steps = 0
        self._trace: list[Control] = []
        self._moves: list[Sequence[int]] = []
        self._styles: list[Sequence[int]] = []
        self._looks: list[LookChange] = []
        self._reaches: list[ReachChange] = []

    def play(
        self,
        trace: Doubles,
        moves: Sequence[Sequence[int]] = (),
        styles: Sequence[Sequence[int]] = (),
        looks: Sequence[LookChange] = (),
        reaches: Sequence[ReachChange] = (),
    ) -> None:
        """Begin with the trace [T,4], in which moves [M,3] were started and styles [S,2] changed as Player.run has
        them, it was looked somewhere, and hands reached for something."""
        self._steps, self._trace = 0, [Control(*row) for row in trace.tolist()]
        self._moves, self._styles, self._looks = list(moves), list(styles), list(looks)
        self._reaches = list(reaches)

    def advance(self) -> None:
        """A step has been made."""
        self._steps += 1
        if self._steps * TRACE_RATE >= len(self._trace) * self._rate:
            self.release()

    def release(self) -> None:
        """Stop the trace."""
        self._trace, self._moves, self._styles = [], [], []

    def moves(self) -> set[int]:
        """Those that are held now."""
        now = self._steps * TRACE_RATE // self._rate
        return {move for control, move, held in self._moves if control <= now < control + held}

    def style(self) -> int | None:
        """The style to which it has changed since this was last asked, if it has."""
        now, due = self._steps * TRACE_RATE // self._rate, None
        while self._styles and self._styles[0][0] <= now:
            due = self._styles.pop(0)[1]
        return due

    @property
    def aim(self) -> Aim:
        """Where it looks now."""
        return look_before(self._looks, self._steps * TRACE_RATE // self._rate + 1)

    @property
    def holds(self) -> Holds:
        """What hands reach for now."""
        return holds_before(self._reaches, self._steps * TRACE_RATE // self._rate + 1)

    def intent(self) -> Intent:
        return Intent(control=self._trace[self._steps * TRACE_RATE // self._rate]) if self._trace else REST

    @property
    def playing(self) -> bool:
        return bool(self._trace)

    @property
    def elapsed(self) -> float:
        """Seconds of the trace that have been played."""
        return self._steps / self._rate

    @property
    def seconds(self) -> float:
        """How long the trace is that plays; 0 while none does."""
        return len(self._trace) / TRACE_RATE
