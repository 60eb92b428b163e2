# SPDX-License-Identifier: GPL-3.0-or-later
"""A stretch of a recording over which the user is recorded: before and after it the recording itself plays."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from ...input.steering import Control
from ...recordings.asked import Asked
from ...recordings.looks import Aim, LookChange, look_before, looks_between
from ...recordings.reaches import Holds, ReachChange, holds_before, reaches_between
from ...recordings.recordings import TRACE_RATE
from ...recordings.styles import AS_EVER, StyleChange, Styled
from .recorder import Taken

if TYPE_CHECKING:
    from fragmotion_core import Character, Doubles


class Own(NamedTuple):
    """A recording's name, its trace [T,4] and what it asks for beside it: by names, and numbered as Player.run has
    it."""

    name: str
    trace: Doubles
    asked: Asked
    moves: Sequence[Sequence[int]] = ()
    styled: Styled = AS_EVER


class Punch:
    """A recording with a stretch in which the user takes over by doing something: from then on until its end the
    controls, and the moves and styles that are asked for in them, are what the user does. What was asked for before
    goes on into it; after it the recording's own style is back. Where the user does nothing, nothing changes."""

    def __init__(self, own: Own, begin: int, last: int, rate: int, character: Character | None) -> None:
        """The stretch is of the controls `begin` .. `last` - 1; played in so many steps a second."""
        self.own, self.begin, self.taken = own, begin, Taken(character, 0, rate)
        self.first = last
        """The first control that is the user's; that after the stretch while none is."""
        self._last, self._rate = last, rate
        self._touched = False
        self._steps = 0

    def offer(self, touched: bool, jump: bool, held: set[int]) -> bool:
        """Whether the user, who does something (`touched`) in the next step, or did since the control began, takes over
        with it: that is where a control begins."""
        if self.takes or not self.is_open:
            return False
        self._touched = self._touched or touched
        self.taken.hear(jump, held)
        if not self._touched or self._steps * TRACE_RATE % self._rate:
            return False
        self.first = self._now
        self.taken.style_now = style_before(self.own.styled, self.first)
        return True

    def advance(self) -> None:
        """A step has been made."""
        self._steps += 1

    @property
    def takes(self) -> bool:
        """Whether the next step is the user's."""
        return self.first <= self._now < self._last

    @property
    def is_open(self) -> bool:
        """Whether the next step is in the stretch."""
        return self.begin <= self._now < self._last

    @property
    def seconds_to_begin(self) -> float:
        """Until the stretch; negative from then on."""
        return self.begin / TRACE_RATE - self._steps / self._rate

    @property
    def seconds_left(self) -> float:
        """Until the stretch is over."""
        return self._last / TRACE_RATE - self._steps / self._rate

    @property
    def words(self) -> str:
        """Whose turn it is."""
        if not self.is_open:
            return f"Playing what was there: yours in {max(self.seconds_to_begin, 0):.1f} s"
        if not self.takes:
            return f"Yours now, for {self.seconds_left:.1f} s: what was there stays until you do something"
        return f"Recording over: {self.seconds_left:.1f} s left"

    @property
    def over(self) -> bool:
        """Whether the stretch is behind."""
        return self._now >= self._last

    @property
    def control(self) -> Control:
        """The recording's own for the next step."""
        return Control(*self.own.trace[self._now].tolist())

    @property
    def moves(self) -> set[int]:
        """The recording's own that are held in the next step."""
        return {move for control, move, held in self._own_moves(self._last) if control <= self._now < control + held}

    @property
    def style(self) -> int:
        """The recording's own for the next step."""
        return style_before(self.own.styled, self._now + 1)

    @property
    def aim(self) -> Aim:
        """Where the recording looks in the next step, whoever drives."""
        return look_before(self.own.asked.looks, self._now + 1)

    @property
    def holds(self) -> Holds:
        """What the recording's hands hold in the next step, whoever drives."""
        return holds_before(self.own.asked.reaches, self._now + 1)

    @property
    def begun(self) -> bool:
        """Whether anything was taken."""
        return bool(len(self.taken.trace))

    @property
    def trace(self) -> Doubles:
        """The recording's trace [T,4] with what was taken so far."""
        merged = self.own.trace.copy()
        merged[self.first : self._end] = self.taken.trace
        return merged

    @property
    def asked(self) -> Asked:
        """What the recording asks for beside it, with what was taken so far."""
        first, end, (moves, begin, styles, looks, reaches) = self.first, self._end, self.own.asked
        taken = [move._replace(control=move.control + first) for move in self.taken.moves]
        changes = [change._replace(control=change.control + first) for change in self.taken.styles]
        return Asked(
            [*(m for m in moves if m.control < first), *taken, *(m for m in moves if m.control >= end)],
            begin,
            [
                *(c for c in styles if c.control < first),
                *changes,
                *self._back(),
                *(c for c in styles if c.control > end),
            ],
            looks,
            reaches,
        )

    @property
    def rest(self) -> tuple[Doubles, list[Sequence[int]], list[Sequence[int]], list[LookChange], list[ReachChange]]:
        """The controls [N,4] that are still to be played, one at least, and the moves, styles, looks and reaches in
        them; moves that are held since before begin there at a negative one."""
        now = self._now
        moves: list[Sequence[int]] = [[control - now, move, held] for control, move, held in self._own_moves(now)]
        later: list[Sequence[int]] = [
            [control - now, style] for control, style in self.own.styled.changes if control > now
        ]
        looks = looks_between(self.own.asked.looks, now, len(self.own.trace))
        reaches = reaches_between(self.own.asked.reaches, now, len(self.own.trace))
        return self.own.trace[min(now, len(self.own.trace) - 1) :], moves, [[0, self.style], *later], looks, reaches

    @property
    def _now(self) -> int:
        """The control of the next step."""
        return self._steps * TRACE_RATE // self._rate

    @property
    def _end(self) -> int:
        """The first control that is the recording's own again."""
        return self.first + len(self.taken.trace)

    def _own_moves(self, end: int) -> list[Sequence[int]]:
        """Those that are not in the stretch, which ends there."""
        return [row for row in self.own.moves if not self.first <= row[0] < end]

    def _back(self) -> list[StyleChange]:
        """The change back to the recording's own style, where the stretch ends in another or one is asked for there."""
        own = style_before(self.own.styled, self._end + 1)
        if self._end >= len(self.own.trace) or own == self.taken.style_now:
            return []
        return [StyleChange(self._end, self.taken.style_names[own])]


def style_before(styled: Styled, control: int) -> int:
    """The number of the style that is asked for last before a control."""
    return [styled.begin, *(style for at, style in styled.changes if at < control)][-1]
