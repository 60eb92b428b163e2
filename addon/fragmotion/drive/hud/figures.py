# SPDX-License-Identifier: GPL-3.0-or-later
"""The head-up display."""

from __future__ import annotations

import blf

from ...compat import versions
from ...input.steering import describe
from . import paint
from .shown import LONGEST_UPDATE, Shown
from .views import Free

_FONT = 0
_SIZE, _LINE, _COLUMN, _MARGIN = 13.0, 19.0, 96.0, 14.0  # pixels at a UI scale of 1
_WIDTH = 330.0
_LABEL, _VALUE, _RED = (1.0, 1.0, 1.0, 0.65), (1.0, 1.0, 1.0, 1.0), (1.0, 0.25, 0.2, 1.0)
_BACK = (0.0, 0.0, 0.0, 0.45)

Row = tuple[str, str]


def rows(shown: Shown) -> list[Row]:
    """What the display says: labels and values with their units."""
    readings, space = shown.readings, shown.readings.space
    table = [("Input", shown.input or "none yet: push a stick or press a key")]
    table.append(("Control", describe(readings.control, space)))
    if readings.judge is not None:
        judge = readings.judge
        table.append(("Class", f"{judge.playing_class}: {describe(judge.evident, space)}"))
        table.append(("Fragment", f"{judge.left:.2f} s left"))
        table.append(("Quality", f"{judge.quality:.2f} now, {judge.mean:.2f} on the whole"))
    else:
        table.append(("Class", "none before Build: the body slides"))
    if shown.style:
        table.append(("Style", shown.style))
    if shown.move:
        table.append(("Move", shown.move))
    answered = readings.stopwatch.seconds
    table.append(("Response", "-" if answered is None else f"{answered:.2f} s"))
    rate = 1 / shown.interval if shown.interval > 0 else 0.0
    pace = "too slow: slow motion" if shown.interval > LONGEST_UPDATE else f"{1000 * shown.cost:.2f} ms each"
    table.append(("Updates", f"{rate:.0f} a second, {pace}"))
    return table


def draw(shown: Shown, free: Free, scale: float) -> None:
    """Write it into the upper left corner of what is free of a view."""
    table = rows(shown)
    left, top = free.left + _MARGIN * scale, free.top - (_MARGIN + 50) * scale
    height = (len(table) + 1.6) * _LINE * scale
    corners = [(left, top), (left + _WIDTH * scale, top), (left + _WIDTH * scale, top - height), (left, top - height)]
    with paint.blending():
        paint.draw_fan([(x, y, 0.0) for x, y in corners], _BACK)
    left, top = left + 8 * scale, top - _LINE * scale
    versions.set_font_size(_FONT, _SIZE * scale)
    _write(shown.title, left, top, _RED if shown.recording else _VALUE)
    for index, (label, value) in enumerate(table, 1):
        _write(label, left, top - index * _LINE * scale, _LABEL)
        _write(value, left + _COLUMN * scale, top - index * _LINE * scale, _VALUE)


def _write(text: str, x: float, y: float, color: paint.Color) -> None:
    blf.position(_FONT, x, y, 0)
    blf.color(_FONT, *color)
    blf.draw(_FONT, text)
