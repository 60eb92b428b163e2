# SPDX-License-Identifier: GPL-3.0-or-later
"""Simple shapes by the gpu module, all of a view in a batch of lines and one of areas: points are (x, y, z), colours
linear RGBA."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from itertools import chain
from typing import Any

import gpu
import numpy as np
from gpu_extras.batch import batch_for_shader

from ...compat import versions

Point = tuple[float, float, float]
Color = tuple[float, float, float, float]
Floats = np.ndarray[Any, np.dtype[np.float32]]

_CORNERS = 32  # of a circle
_WIDTH = 2.0  # pixels of a line


class Batch:
    """Shapes that are drawn together: first the lines, then the areas in the order in which they were added."""

    def __init__(self) -> None:
        self._lines: list[tuple[Floats, Color]] = []  # two points each
        self._areas: list[tuple[Floats, Color]] = []  # three points each

    def line(self, points: Sequence[Point], color: Color) -> None:
        """A line through all points."""
        if len(points) > 1:
            self._lines.append((np.repeat(_array(points), 2, axis=0)[1:-1], color))

    def area(self, points: Sequence[Point], color: Color) -> None:
        """A convex area between points in order."""
        first, rest = points[0], points[1:]
        self._areas.append((_array([point for pair in zip(rest, rest[1:]) for point in (first, *pair)]), color))

    def ring(self, center: Point, radius: float, width: float, color: Color) -> None:
        """A level ring, so wide inside its radius."""
        outer, inner = circle(center, radius), circle(center, radius - width)
        corners = zip(outer, outer[1:], inner, inner[1:])
        self._areas.append((_array([point for a, b, c, d in corners for point in (a, b, d, a, d, c)]), color))

    def arrow(self, start: Point, way: tuple[float, float], color: Color, width: float) -> None:
        """A level arrow from a point; its width and head in the unit of the points."""
        length = math.hypot(*way)
        if length < 2 * width:
            return
        (x, y, z), (along_x, along_y) = start, (way[0] / length, way[1] / length)

        def at(along: float, across: float) -> Point:
            return x + along * along_x - across * along_y, y + along * along_y + across * along_x, z

        neck = max(length - 3 * width, 0.0)
        self.area([at(0, -width / 2), at(neck, -width / 2), at(neck, width / 2), at(0, width / 2)], color)
        self.area([at(neck, -1.5 * width), at(length, 0), at(neck, 1.5 * width)], color)

    def draw(self) -> None:
        """Draw it: two calls at most."""
        with _blending():
            if self._lines:
                self._draw("POLYLINE_FLAT_COLOR", "LINES", self._lines)
            if self._areas:
                self._draw("FLAT_COLOR", "TRIS", self._areas)

    @staticmethod
    def _draw(name: str, kind: str, shapes: list[tuple[Floats, Color]]) -> None:
        shader = gpu.shader.from_builtin(versions.shader(name))
        points = np.concatenate([points for points, _ in shapes])
        colors = np.array([color for _, color in shapes], np.float32)
        spread = np.repeat(colors, [len(points) for points, _ in shapes], axis=0)
        batch = batch_for_shader(shader, kind, {"pos": points, "color": spread})
        shader.bind()
        if kind == "LINES":
            shader.uniform_float("viewportSize", gpu.state.viewport_get()[2:])
            shader.uniform_float("lineWidth", _WIDTH)
        batch.draw(shader)


@contextmanager
def _blending() -> Iterator[None]:
    """What is drawn lets show through what is behind, and hides nothing."""
    gpu.state.blend_set("ALPHA")
    try:
        yield
    finally:
        gpu.state.blend_set("NONE")


def _array(points: Sequence[Point]) -> Floats:
    """[N,3], quicker than NumPy makes it of tuples."""
    return np.fromiter(chain.from_iterable(points), np.float32, 3 * len(points)).reshape(-1, 3)


def circle(center: Point, radius: float) -> list[Point]:
    """A level circle, closed."""
    x, y, z = center
    angles = (2 * math.pi * index / _CORNERS for index in range(_CORNERS + 1))
    return [(x + radius * math.cos(angle), y + radius * math.sin(angle), z) for angle in angles]
