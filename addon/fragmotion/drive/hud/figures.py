# SPDX-License-Identifier: GPL-3.0-or-later
"""The head-up display."""

from __future__ import annotations

from typing import NamedTuple

import blf

from ...compat import versions
from ...input.steering import describe
from . import paint
from .shown import LONGEST_UPDATE, Shown
from .views import Free

_FONT = 0
_SIZE, _LINE, _COLUMN, _MARGIN = 13.0, 19.0, 70.0, 14.0  # pixels at a UI scale of 1
_WIDTH, _INSET = 230.0, 8.0
_LABEL, _VALUE, _RED = (1.0, 1.0, 1.0, 0.65), (1.0, 1.0, 1.0, 1.0), (1.0, 0.25, 0.2, 1.0)
BACK = (0.0, 0.0, 0.0, 0.45)

Row = tuple[str, str]


def rows(shown: Shown) -> list[Row]:
    """What the display says: labels and values with their units."""
    readings, space = shown.readings, shown.readings.space
    is_asked = shown.input or any(readings.control)
    asked = describe(readings.control, space) if is_asked else f"nothing yet: push a stick, or press {shown.go_keys}"
    table = [("Asked", asked), ("Does", _done(shown)), ("Style", shown.style), ("Move", shown.move)]
    table.append(("Time", f"{shown.seconds:.1f} s"))
    if shown.interval > LONGEST_UPDATE:
        table.append(("Updates", f"{1 / shown.interval:.0f} a second, too slow: slow motion"))
    if shown.settings.show_details:
        table += _details(shown)
    return [(label, value) for label, value in table if value]


def _done(shown: Shown) -> str:
    """What the character visibly does."""
    judge = shown.readings.judge
    return describe(judge.evident, shown.readings.space) if judge is not None else "slides until it is built"


def _details(shown: Shown) -> list[Row]:
    """How well it does it, and how quickly."""
    judge, answered = shown.readings.judge, shown.readings.stopwatch.seconds
    table = [("Input", shown.input)]
    if judge is not None:
        table.append(("Class", f"{judge.playing_class}, {judge.left:.2f} s left of the fragment"))
        table.append(("Quality", f"{judge.quality:.2f} now, {judge.mean:.2f} on the whole"))
    table.append(("Response", "" if answered is None else f"{answered:.2f} s"))
    if 0 < shown.interval <= LONGEST_UPDATE:
        table.append(("Updates", f"{1 / shown.interval:.0f} a second, {1000 * shown.cost:.2f} ms each"))
    return table


class Box(NamedTuple):
    """Where the display stands and what it says."""

    left: float
    top: float
    width: float
    title: str
    color: paint.Color
    table: list[Row]
    line: float
    """Pixels from one line to the next."""

    @property
    def corners(self) -> list[paint.Point]:
        """All around it."""
        right, bottom = self.left + self.width, self.top - (len(self.table) + 1.6) * self.line
        places = [(self.left, self.top), (right, self.top), (right, bottom), (self.left, bottom)]
        return [(x, y, 0.0) for x, y in places]


def lay_out(shown: Shown, free: Free, scale: float) -> Box:
    """The display in the upper left corner of what is free of a view, as wide as its text."""
    table = rows(shown)
    versions.set_font_size(_FONT, _SIZE * scale)
    values = max(blf.dimensions(_FONT, value)[0] for _, value in table)
    widest = max(_COLUMN * scale + values, blf.dimensions(_FONT, shown.title)[0])
    width = max(2 * _INSET * scale + widest, _WIDTH * scale)
    left, top = free.left + _MARGIN * scale, free.top - (_MARGIN + 50) * scale
    return Box(left, top, width, shown.title, _RED if shown.recording else _VALUE, table, _LINE * scale)


def write(box: Box, scale: float) -> None:
    """Write what it says."""
    left, top = box.left + _INSET * scale, box.top - box.line
    versions.set_font_size(_FONT, _SIZE * scale)
    _write(box.title, left, top, box.color)
    for index, (label, value) in enumerate(box.table, 1):
        _write(label, left, top - index * box.line, _LABEL)
        _write(value, left + _COLUMN * scale, top - index * box.line, _VALUE)


def _write(text: str, x: float, y: float, color: paint.Color) -> None:
    blf.position(_FONT, x, y, 0)
    blf.color(_FONT, *color)
    blf.draw(_FONT, text)
