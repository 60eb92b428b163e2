# SPDX-License-Identifier: GPL-3.0-or-later
"""Spans of frames that are marked in the timeline and the other editors of time."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import bpy

from . import paint, views

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
        for area in areas_of(window):
            area.tag_redraw()


def areas_of(window: bpy.types.Window | None) -> list[bpy.types.Area]:
    """These editors of a window."""
    return [area for area in window.screen.areas if area.type in _EDITORS] if window else []


def tell(window: bpy.types.Window, text: str | None) -> None:
    """Write this in place of their headers, as Blender's modal tools do; None gives these back."""
    for area in areas_of(window):
        area.header_text_set(text)


def part_under(window: bpy.types.Window, event: bpy.types.Event) -> bpy.types.Region | None:
    """The part of one of them that shows time, where the mouse is in it."""
    parts = (part for area in areas_of(window) for part in area.regions if part.type == "WINDOW")
    return next((part for part in parts if views.is_inside(part, event)), None)


def frame_at(part: bpy.types.Region, event: bpy.types.Event) -> float:
    """The scene frame at which the mouse is, seen in such a part."""
    return float(part.view2d.region_to_view(event.mouse_x - part.x, 0)[0])


def _draw(spans: Callable[[], Sequence[Span]]) -> None:
    region, batch = bpy.context.region, paint.Batch()
    for first, last, color in spans():
        left, right = (region.view2d.view_to_region(frame, 0, clip=False)[0] for frame in (first, last))
        corners = [(left, 0.0), (right, 0.0), (right, region.height), (left, region.height)]
        batch.area([(x, y, 0.0) for x, y in corners], color)
    batch.draw()
