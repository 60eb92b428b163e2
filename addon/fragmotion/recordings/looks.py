# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a character looks: as its takes have it, where it goes, or at a place."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from .rows import read_rows

AS_CAPTURED, AHEAD, AT = range(3)
"""The core's numbers of looks."""

_FARTHEST = 1e9  # m
_SAME_PLACE = 0.01  # m


class Aim(NamedTuple):
    """A look by its number and, where it is AT, the place in the world, m: what core.Player.look() takes."""

    look: int = AS_CAPTURED
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0

    def is_like(self, other: Aim) -> bool:
        """Whether both look at the same, but for what nobody sees."""
        return self.look == other.look and math.dist(self[1:], other[1:]) <= _SAME_PLACE


class LookChange(NamedTuple):
    """Where to look before a control of a recording, as Player.run has it."""

    control: int
    look: int
    x: float = 0.0
    y: float = 0.0
    z: float = 0.0

    @property
    def aim(self) -> Aim:
        """Without when."""
        return Aim(*self[1:])


def aim_of(settings: Any) -> Aim:
    """What LookSettings say now; as captured where no object is chosen to look at."""
    if settings.kind == "AHEAD":
        return Aim(AHEAD)
    if settings.kind == "OBJECT" and settings.object is not None:
        return Aim(AT, *settings.object.matrix_world.translation)
    return Aim()


def look_in_words(settings: Any) -> str:
    """The same in words."""
    if settings.kind == "OBJECT" and settings.object is not None:
        return f"at '{settings.object.name}'"
    return "where it goes" if settings.kind == "AHEAD" else "as captured"


def read_looks(text: str, controls: int) -> list[LookChange] | None:
    """The looks that a recording of so many controls keeps, in order; None where the text is damaged."""
    return read_rows(text, LookChange, lambda look: _is_look(look, controls))


def look_before(looks: Sequence[LookChange], control: int) -> Aim:
    """Where it was asked to look last before a control."""
    return [Aim(), *(look.aim for look in looks if look.control < control)][-1]


def looks_between(looks: Sequence[LookChange], first: int, last: int) -> list[LookChange]:
    """The looks of the controls `first` .. `last` - 1, seen from the first of them."""
    rest = [look._replace(control=look.control - first) for look in looks if first <= look.control < last]
    former = look_before(looks, first)
    begins = former.look == AS_CAPTURED or (rest and rest[0].control == 0)
    return rest if begins else [LookChange(0, *former), *rest]


def looks_from(looks: Sequence[LookChange], control: int, aim: Aim) -> list[LookChange]:
    """The looks until a control, and from there on another."""
    former = [look for look in looks if look.control < control]
    same = look_before(looks, control) == aim
    return former if same else [*former, LookChange(control, *aim)]


def _is_look(look: LookChange, controls: int) -> bool:
    whole = all(type(number) is int for number in look[:2])
    if not (whole and 0 <= look.control < controls and AS_CAPTURED <= look.look <= AT):
        return False
    return all(type(number) in (int, float) and abs(number) <= _FARTHEST for number in look[2:])
