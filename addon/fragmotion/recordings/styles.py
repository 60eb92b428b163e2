# SPDX-License-Identifier: GPL-3.0-or-later
"""The styles of a recording: in which it begins, and to which it changes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from .rows import read_rows, write_rows


class StyleChange(NamedTuple):
    """A style that was asked for before a control of a recording."""

    control: int
    name: str


class Styled(NamedTuple):
    """The style in which a player begins, by its number, the changes as Player.run has them [S,2], and what to say of
    styles that the character does not have; empty where there are none."""

    begin: int = 0
    changes: Sequence[Sequence[int]] = ()
    remark: str = ""


AS_EVER = Styled()
"""The first style, without a change."""


def read_changes(text: str, controls: int) -> list[StyleChange] | None:
    """The changes that a recording of so many controls keeps, in order; None where the text is damaged."""
    return read_rows(text, StyleChange, lambda change: _is_change(change, controls))


def numbered(begin: str, changes: Sequence[StyleChange], names: Sequence[str]) -> Styled:
    """The styles of a recording, numbered as in `names`. In place of one that is not there the former goes on, and at
    first the first."""
    missing = sorted({name for name in (begin, *(change.name for change in changes)) if name} - set(names))
    numbers = [[change.control, names.index(change.name)] for change in changes if change.name in names]
    remark = f"without style '{missing[0]}', which the character does not have" if missing else ""
    return Styled(names.index(begin) if begin in names else 0, numbers, remark)


def trimmed(begin: str, changes: Sequence[StyleChange], first: int, last: int) -> tuple[str, list[StyleChange]]:
    """The styles of the controls `first` .. `last` - 1: in which they begin, and the changes."""
    former = [change.name for change in changes if change.control < first]
    rest = [change._replace(control=change.control - first) for change in changes if first <= change.control < last]
    return (former or [begin])[-1], rest


def set_styles(recording: Any, begin: str, changes: Sequence[StyleChange]) -> None:
    """Keep the styles with a recording."""
    recording.style, recording.styles = begin, write_rows(changes)


def _is_change(change: StyleChange, controls: int) -> bool:
    number = type(change.control) is int and 0 <= change.control < controls
    return number and isinstance(change.name, str)
