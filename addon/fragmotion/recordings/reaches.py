# SPDX-License-Identifier: GPL-3.0-or-later
"""What hands hold or reach for: nothing, a place in the world, or one that goes along with the character."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from .rows import read_rows

_FARTHEST = 1e9  # m
_SAME_PLACE = 0.001  # m
_SAME_WEIGHT = 0.001


class Hold(NamedTuple):
    """By which weight a hand is where: what core.Player.reach() takes after the hand."""

    weight: float = 0.0
    carried: int = 0
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0

    def is_like(self, other: Hold) -> bool:
        """Whether both hold the same, but for what nobody sees."""
        if self.weight == other.weight == 0:
            return True
        same = self.carried == other.carried and abs(self.weight - other.weight) <= _SAME_WEIGHT
        return same and math.dist(self[2:], other[2:]) <= _SAME_PLACE


Holds = tuple[Hold, Hold]
"""Of the left and the right hand."""

EMPTY: Holds = (Hold(), Hold())


class ReachChange(NamedTuple):
    """What a hand reaches for before a control of a recording, as Player.run has it."""

    control: int
    hand: int
    weight: float
    carried: int
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0

    @property
    def hold(self) -> Hold:
        """Without when and which hand."""
        return Hold(*self[2:])


def read_reaches(text: str, controls: int) -> list[ReachChange] | None:
    """What hands reach for in a recording of so many controls, in order; None where the text is damaged."""
    return read_rows(text, ReachChange, lambda reach: _is_reach(reach, controls))


def holds_before(reaches: Sequence[ReachChange], control: int) -> Holds:
    """What hands were asked to hold last before a control."""
    return _changed(EMPTY, [reach for reach in reaches if reach.control < control])


def changes(control: int, former: Holds, holds: Holds) -> list[ReachChange]:
    """What changes from one to the other before a control."""
    return [ReachChange(control, hand, *holds[hand]) for hand in (0, 1) if not holds[hand].is_like(former[hand])]


def reaches_between(reaches: Sequence[ReachChange], first: int, last: int) -> list[ReachChange]:
    """Those of the controls `first` .. `last` - 1, seen from the first of them."""
    rest = [reach._replace(control=reach.control - first) for reach in reaches if first < reach.control < last]
    return [*changes(0, EMPTY, holds_before(reaches, first + 1)), *rest]


def reaches_from(reaches: Sequence[ReachChange], control: int, holds: Sequence[Holds]) -> list[ReachChange]:
    """Those until a control, and from there on what is to be held before each control."""
    found = [reach for reach in reaches if reach.control < control]
    former = holds_before(found, control)
    for number, each in enumerate(holds, control):
        new = changes(number, former, each)
        found += new
        former = _changed(former, new)
    return found


def _changed(former: Holds, new: Sequence[ReachChange]) -> Holds:
    holds = list(former)
    for reach in new:
        holds[reach.hand] = reach.hold
    return holds[0], holds[1]


def _is_reach(reach: ReachChange, controls: int) -> bool:
    whole = all(type(number) is int for number in (reach.control, reach.hand, reach.carried))
    if not (whole and 0 <= reach.control < controls and reach.hand in (0, 1) and reach.carried in (0, 1)):
        return False
    if not (type(reach.weight) in (int, float) and 0 <= reach.weight <= 1):
        return False
    return all(type(number) in (int, float) and abs(number) <= _FARTHEST for number in reach[4:])
