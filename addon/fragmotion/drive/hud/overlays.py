# SPDX-License-Identifier: GPL-3.0-or-later
"""What is drawn over the 3D views while driving: arrows, ways and feet on the ground, stick and figures in front."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import bpy

from ...input.screen_stick import ScreenStick
from ...input.steering import Intent
from ...input.walk_target import NEAR
from . import figures, paint, timeline, views
from .shown import Shown

Look = Callable[[], "Shown | None"]
"""What a drive shows now; None where it cannot go on."""

COMMANDED = (0.10, 0.45, 1.0, 0.9)
ACTUAL = (1.0, 0.45, 0.05, 0.9)
_IDEAL = (0.10, 0.45, 1.0, 0.5)
_PATH = (1.0, 0.45, 0.05, 0.6)
_PLANTED = (0.25, 1.0, 0.35, 0.6)
_RIM, _DISC, _KNOB = (1.0, 1.0, 1.0, 0.5), (0.0, 0.0, 0.0, 0.35), (0.85, 0.85, 0.85, 0.8)
_OVER = (1.0, 0.1, 0.1, 0.35)
_REACH = 0.5  # s: an arrow shows where the character would be after that
_ARROW = 0.08  # m, width
_FOOT = 0.09  # m, radius
_GHOST = 0.16  # m, radius
_LIFT = 0.005  # m above the ground, against flicker

_handlers: list[Any] = []


def add(look: Look, where: views.Views) -> None:
    """Draw a drive in every 3D view, and its stick and figures in the main one, until `remove`."""
    space = bpy.types.SpaceView3D
    _handlers.append((space, space.draw_handler_add(_draw_ground, (look,), "WINDOW", "POST_VIEW")))
    _handlers.append((space, space.draw_handler_add(_draw_front, (look, where), "WINDOW", "POST_PIXEL")))
    timeline.mark(lambda: _marked(look()))


def remove() -> None:
    """Draw nothing any more."""
    for space, handler in _handlers:
        space.draw_handler_remove(handler, "WINDOW")
    _handlers.clear()
    timeline.unmark()


def _marked(shown: Shown | None) -> list[timeline.Span]:
    """What is marked on the timeline."""
    return [] if shown is None or shown.span is None else [timeline.Span(*shown.span, _OVER)]


def _draw_ground(look: Look) -> None:
    shown = look()
    if shown is None:
        return
    settings, readings, batch = shown.settings, shown.readings, paint.Batch()
    x, y, _ = readings.frame
    level = readings.level
    if settings.show_ideal:
        batch.line([_lifted(*point, level) for point in readings.ideal_path.points], _IDEAL)
        _add_ghost(batch, *readings.ideal.frame, level)
    if settings.show_path:
        batch.line([_lifted(*point, level) for point in (*readings.path.points, (x, y))], _PATH)
    if settings.show_velocity:
        _add_velocity(batch, _lifted(x, y, level), readings.commanded, COMMANDED)
        _add_velocity(batch, _lifted(x, y, level, 2), readings.velocity, ACTUAL)
    if shown.target is not None:
        _add_target(batch, _lifted(*shown.target))
    if settings.show_feet:
        for place in readings.standing_feet.tolist():
            batch.area(paint.circle(place, _FOOT)[:-1], _PLANTED)
    batch.draw()


def _add_velocity(batch: paint.Batch, start: paint.Point, velocity: tuple[float, float], color: paint.Color) -> None:
    batch.arrow(start, (_REACH * velocity[0], _REACH * velocity[1]), color, _ARROW)


def _add_ghost(batch: paint.Batch, x: float, y: float, heading: float, level: float) -> None:
    """A ring that shows by its nose where it faces."""
    batch.line(paint.circle(_lifted(x, y, level), _GHOST), _IDEAL)
    nose = _lifted(x - 2 * _GHOST * math.sin(heading), y + 2 * _GHOST * math.cos(heading), level)
    batch.line([_lifted(x, y, level), nose], _IDEAL)


def _add_target(batch: paint.Batch, place: paint.Point) -> None:
    """Where it counts as being there, and the middle of that."""
    batch.ring(place, NEAR, NEAR / 4, COMMANDED)
    batch.area(paint.circle(place, NEAR / 4)[:-1], COMMANDED)


def _lifted(x: float, y: float, level: float, times: int = 1) -> paint.Point:
    return x, y, level + times * _LIFT


def _draw_front(look: Look, where: views.Views) -> None:
    area, shown = bpy.context.area, look()
    if shown is None or not where.is_main(area):
        return
    free, scale, batch = views.free_part(area), bpy.context.preferences.system.ui_scale, paint.Batch()
    if shown.settings.show_stick:
        shown.stick.place(free.left, free.bottom, scale)
        _add_stick(batch, shown.stick, shown.intent)
    box = figures.lay_out(shown, free, scale) if shown.settings.show_figures else None
    if box is not None:
        batch.area(box.corners, figures.BACK)
    batch.draw()
    if box is not None:
        figures.write(box, scale)


def _add_stick(batch: paint.Batch, stick: ScreenStick, intent: Intent) -> None:
    (x, y), radius = stick.center, stick.radius
    knob = (x + radius * intent.right, y + radius * intent.ahead, 0.0)
    batch.area(paint.circle((x, y, 0), radius)[:-1], _DISC)
    batch.ring((x, y, 0), radius, 2, _RIM)
    batch.ring((x, y, 0), radius / 2, 1, _RIM)
    batch.area(paint.circle(knob, stick.knob)[:-1], _KNOB)
