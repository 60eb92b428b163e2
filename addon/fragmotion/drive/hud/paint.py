# SPDX-License-Identifier: GPL-3.0-or-later
"""Simple shapes by the gpu module: points [N] are (x, y, z), colours linear RGBA, widths pixels."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager

import gpu
from gpu_extras.batch import batch_for_shader

from ...compat import versions

Point = tuple[float, float, float]
Color = tuple[float, float, float, float]

_CORNERS = 32  # of a circle


@contextmanager
def blending() -> Iterator[None]:
    """What is drawn lets show through what is behind, and hides nothing."""
    gpu.state.blend_set("ALPHA")
    try:
        yield
    finally:
        gpu.state.blend_set("NONE")


def draw_line(points: Sequence[Point], color: Color, width: float) -> None:
    """A line through all points."""
    if len(points) < 2:
        return
    shader = gpu.shader.from_builtin(versions.shader("POLYLINE_UNIFORM_COLOR"))
    batch = batch_for_shader(shader, "LINE_STRIP", {"pos": points})
    shader.bind()
    shader.uniform_float("viewportSize", gpu.state.viewport_get()[2:])
    shader.uniform_float("lineWidth", width)
    shader.uniform_float("color", color)
    batch.draw(shader)


def draw_fan(points: Sequence[Point], color: Color) -> None:
    """A convex area between points in order."""
    shader = gpu.shader.from_builtin(versions.shader("UNIFORM_COLOR"))
    corners = [(0, index, index + 1) for index in range(1, len(points) - 1)]
    batch = batch_for_shader(shader, "TRIS", {"pos": points}, indices=corners)
    shader.bind()
    shader.uniform_float("color", color)
    batch.draw(shader)


def circle(center: Point, radius: float) -> list[Point]:
    """A level circle, closed."""
    x, y, z = center
    angles = (2 * math.pi * index / _CORNERS for index in range(_CORNERS + 1))
    return [(x + radius * math.cos(angle), y + radius * math.sin(angle), z) for angle in angles]


def draw_arrow(start: Point, way: tuple[float, float], color: Color, width: float) -> None:
    """A level arrow from a point; its width and head in the unit of the points."""
    length = math.hypot(*way)
    if length < 2 * width:
        return
    (x, y, z), (along_x, along_y) = start, (way[0] / length, way[1] / length)

    def at(along: float, across: float) -> Point:
        return x + along * along_x - across * along_y, y + along * along_y + across * along_x, z

    neck = max(length - 3 * width, 0.0)
    draw_fan([at(0, -width / 2), at(neck, -width / 2), at(neck, width / 2), at(0, width / 2)], color)
    draw_fan([at(neck, -1.5 * width), at(length, 0), at(neck, 1.5 * width)], color)
