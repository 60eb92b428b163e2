# SPDX-License-Identifier: GPL-3.0-or-later
"""What is drawn over the 3D views while driving: arrows, ways and feet on the ground, stick and figures in front."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import bpy

from ...input.screen_stick import ScreenStick
from ...input.steering import Intent
from . import figures, paint, views
from .shown import Shown

Look = Callable[[], "Shown | None"]
"""What a drive shows now; None where it cannot go on."""

COMMANDED = (0.10, 0.45, 1.0, 0.9)
ACTUAL = (1.0, 0.45, 0.05, 0.9)
_IDEAL = (0.10, 0.45, 1.0, 0.5)
_PATH = (1.0, 0.45, 0.05, 0.6)
_PLANTED = (0.25, 1.0, 0.35, 0.6)
_RIM, _DISC, _KNOB = (1.0, 1.0, 1.0, 0.5), (0.0, 0.0, 0.0, 0.35), (0.85, 0.85, 0.85, 0.8)
_REACH = 0.5  # s: an arrow shows where the character would be after that
_ARROW = 0.08  # m, width
_FOOT = 0.09  # m, radius
_GHOST = 0.16  # m, radius
_LIFT = 0.005  # m above the ground, against flicker

_handlers: list[Any] = []


def add(look: Look, where: views.Views) -> None:
    """Draw a drive in every 3D view, and its stick and figures in the main one, until `remove`."""
    space = bpy.types.SpaceView3D
    _handlers.append(space.draw_handler_add(_draw_ground, (look,), "WINDOW", "POST_VIEW"))
    _handlers.append(space.draw_handler_add(_draw_front, (look, where), "WINDOW", "POST_PIXEL"))


def remove() -> None:
    """Draw nothing any more."""
    for handler in _handlers:
        bpy.types.SpaceView3D.draw_handler_remove(handler, "WINDOW")
    _handlers.clear()


def _draw_ground(look: Look) -> None:
    shown = look()
    if shown is None:
        return
    settings, readings = shown.settings, shown.readings
    x, y, _ = readings.frame
    level = readings.level
    with paint.blending():
        if settings.show_ideal:
            paint.draw_line([_lifted(*point, level) for point in readings.ideal_path.points], _IDEAL, 2)
            _draw_ghost(*readings.ideal.frame, level)
        if settings.show_path:
            paint.draw_line([_lifted(*point, level) for point in (*readings.path.points, (x, y))], _PATH, 2)
        if settings.show_velocity:
            _draw_velocity(_lifted(x, y, level), readings.commanded, COMMANDED)
            _draw_velocity(_lifted(x, y, level, 2), readings.velocity, ACTUAL)
        if settings.show_feet:
            for place in readings.standing_feet.tolist():
                paint.draw_fan(paint.circle(place, _FOOT)[:-1], _PLANTED)


def _draw_velocity(start: paint.Point, velocity: tuple[float, float], color: paint.Color) -> None:
    paint.draw_arrow(start, (_REACH * velocity[0], _REACH * velocity[1]), color, _ARROW)


def _draw_ghost(x: float, y: float, heading: float, level: float) -> None:
    """A ring that shows by its nose where it faces."""
    ring = paint.circle(_lifted(x, y, level), _GHOST)
    paint.draw_line(ring, _IDEAL, 2)
    nose = _lifted(x - 2 * _GHOST * math.sin(heading), y + 2 * _GHOST * math.cos(heading), level)
    paint.draw_line([_lifted(x, y, level), nose], _IDEAL, 2)


def _lifted(x: float, y: float, level: float, times: int = 1) -> paint.Point:
    return x, y, level + times * _LIFT


def _draw_front(look: Look, where: views.Views) -> None:
    area, shown = bpy.context.area, look()
    if shown is None or not where.is_main(area):
        return
    free, scale = views.free_part(area), bpy.context.preferences.system.ui_scale
    if shown.settings.show_stick:
        shown.stick.place(free.left, free.bottom, scale)
        with paint.blending():
            _draw_stick(shown.stick, shown.intent)
    if shown.settings.show_figures:
        figures.draw(shown, free, scale)


def _draw_stick(stick: ScreenStick, intent: Intent) -> None:
    (x, y), radius = stick.center, stick.radius
    knob = (x + radius * intent.right, y + radius * intent.ahead, 0.0)
    paint.draw_fan(paint.circle((x, y, 0), radius)[:-1], _DISC)
    paint.draw_line(paint.circle((x, y, 0), radius), _RIM, 2)
    paint.draw_line(paint.circle((x, y, 0), radius / 2), _RIM, 1)
    paint.draw_fan(paint.circle(knob, stick.knob)[:-1], _KNOB)
