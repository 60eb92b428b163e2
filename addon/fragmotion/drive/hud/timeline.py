# SPDX-License-Identifier: GPL-3.0-or-later
"""Spans of frames that are marked in the timeline and the other editors of time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import bpy

from . import paint

_EDITORS = {"DOPESHEET_EDITOR": bpy.types.SpaceDopeSheetEditor, "GRAPH_EDITOR": bpy.types.SpaceGraphEditor}
_handlers: list[tuple[Any, Any]] = []


class Span(NamedTuple):
    """Scene frames from and to which it goes, and its colour."""

    first: float
    last: float
    color: paint.Color


def mark(spans: Callable[[], Sequence[Span]]) -> None:
    """Draw what `spans` says in each of these editors until `unmark`; what was marked before is no more."""
    unmark()
    for space in _EDITORS.values():
        _handlers.append((space, space.draw_handler_add(_draw, (spans,), "WINDOW", "POST_PIXEL")))
    tag_redraw()


def unmark() -> None:
    """Mark nothing any more."""
    for space, handler in _handlers:
        space.draw_handler_remove(handler, "WINDOW")
    _handlers.clear()
    tag_redraw()


def tag_redraw() -> None:
    """Have these editors drawn."""
    for window in bpy.context.window_manager.windows:
        for area in window.screen.areas:
            if area.type in _EDITORS:
                area.tag_redraw()


def _draw(spans: Callable[[], Sequence[Span]]) -> None:
    region, batch = bpy.context.region, paint.Batch()
    for first, last, color in spans():
        left, right = (region.view2d.view_to_region(frame, 0, clip=False)[0] for frame in (first, last))
        corners = [(left, 0.0), (right, 0.0), (right, region.height), (left, region.height)]
        batch.area([(x, y, 0.0) for x, y in corners], color)
    batch.draw()
