# SPDX-License-Identifier: GPL-3.0-or-later
"""What a recording asks for beside its trace: moves, styles, where to look, and what hands hold."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

from ..errors import UserError
from .looks import LookChange, look_before, looks_from
from .reaches import ReachChange, holds_before, reaches_from
from .styles import StyleChange


class StartedMove(NamedTuple):
    """A move that was started before a control of a recording, and for how many controls it was held."""

    control: int
    name: str
    held: int


class Asked(NamedTuple):
    """What a recording asks for beside its trace: moves, the style in which it begins, changes of it, looks, and what
    hands reach for."""

    moves: Sequence[StartedMove] = ()
    style: str = ""
    styles: Sequence[StyleChange] = ()
    looks: Sequence[LookChange] = ()
    reaches: Sequence[ReachChange] = ()


def number_moves(
    moves: Sequence[StartedMove], names: Sequence[str], starter: Callable[[StartedMove], str]
) -> list[list[int]]:
    """Moves that were started as Player.run has them [M,3], numbered as in `names`; UserError, which begins with what
    starts it, where one is not there."""
    for move in moves:
        if move.name not in names:
            raise UserError(
                f"{starter(move)} starts the move '{move.name}', which the character does not have: add it under "
                "Moves, with that name"
            )
    return [[move.control, list(names).index(move.name), move.held] for move in moves]


def joined_asked(first: Asked, length: int, second: Asked) -> Asked:
    """What is asked for in `length` controls, and then in others that follow them."""
    later = [move._replace(control=move.control + length) for move in second.moves]
    former = (first.styles[-1].name if first.styles else first.style) or ""
    begins = [StyleChange(length, second.style)] if second.style and second.style != former else []
    changes = [change._replace(control=change.control + length) for change in second.styles]
    looks = looks_from(first.looks, length, look_before(second.looks, 1))
    looks += [look._replace(control=look.control + length) for look in second.looks if look.control > 0]
    reaches = reaches_from(first.reaches, length, [holds_before(second.reaches, 1)])
    reaches += [reach._replace(control=reach.control + length) for reach in second.reaches if reach.control > 0]
    return Asked([*first.moves, *later], first.style, [*first.styles, *begins, *changes], looks, reaches)
