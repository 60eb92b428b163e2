# SPDX-License-Identifier: GPL-3.0-or-later
"""Bodies drawn to a picture, in a window or not: bones as tubes, meshes as shaded faces, by points of them that hide
what is behind."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Pixels = NDArray[np.float32]

_STATURE = 240  # pixels that a body is high
_CELL = (236, 330)  # pixels of a body's part of the picture
_GROUND = 34  # pixels of the ground over the lower edge
_FINER = 2  # of each pixel's sides, over which its colour is averaged
_FROM = (np.radians(35), np.radians(10))  # from where it is seen: to the side of the front, and from above
_LIGHT = np.array((-0.4, 0.6, 0.7)) / np.linalg.norm((-0.4, 0.6, 0.7))  # to the right, up, to the viewer
_THICK = 0.012  # statures, of a bone
_COLOURS = np.array(((0.36, 0.62, 0.95), (0.96, 0.66, 0.30)))  # the take, and what was made of it
_BACKGROUND, _BETWEEN, _FLOOR = 0.20, 0.12, 0.34


class Line(NamedTuple):
    """A bone's ends."""

    begin: Floats
    end: Floats


class Surface(NamedTuple):
    """A mesh: places [V,3] and corners [T,3]."""

    places: Floats
    corners: NDArray[np.int32]


class Figure(NamedTuple):
    """A body in its character frame (x right, y forward, z up), in statures."""

    lines: Sequence[Line] = ()
    surfaces: Sequence[Surface] = ()


class _Points(NamedTuple):
    """Where points [N,3] are on the picture, right, up and to the viewer, in fine pixels, and how bright [N]."""

    places: Floats
    brightness: Floats


def draw_pairs(pairs: Sequence[tuple[Figure, Figure]]) -> Pixels:
    """The picture [H,W,4], row 0 at the bottom: for each pair the one beside the other."""
    cells = []
    for pair in pairs:
        cells += [_draw(figure, colour) for figure, colour in zip(pair, _COLOURS)]
        cells[-1][:, -2:, :3] = _BETWEEN
    return np.concatenate(cells, axis=1)


def _draw(figure: Figure, colour: Floats) -> Pixels:
    width, height = (_FINER * size for size in _CELL)
    picture = np.full((height * width, 3), _BACKGROUND)
    picture[: _FINER * _GROUND * width] = _FLOOR
    parts = [_points_of_line(line) for line in figure.lines] + [_points_of(surface) for surface in figure.surfaces]
    places = np.concatenate([part.places for part in parts]) + np.array((width / 2, _FINER * _GROUND, 0))
    brightness = np.concatenate([part.brightness for part in parts])
    columns, rows = np.floor(places[:, :2]).astype(int).T
    seen = np.flatnonzero((columns >= 0) & (columns < width) & (rows >= 0) & (rows < height))
    seen = seen[np.argsort(places[seen, 2], kind="stable")]  # the nearest come last, and over the others
    picture[rows[seen] * width + columns[seen]] = brightness[seen, None] * colour
    fine = picture.reshape(_CELL[1], _FINER, _CELL[0], _FINER, 3).mean((1, 3))
    return np.dstack((fine, np.ones(fine.shape[:2]))).astype(np.float32)


def _on_screen(places: Floats) -> Floats:
    """To the right, up and to the viewer [...,3], in fine pixels."""
    aside, above = _FROM
    front = np.array((np.sin(aside), np.cos(aside), 0))
    right, up = np.array((-front[1], front[0], 0)), np.array((0, 0, 1.0))
    axes = (right, np.cos(above) * up - np.sin(above) * front, np.cos(above) * front + np.sin(above) * up)
    seen: Floats = _FINER * _STATURE * np.asarray(places, float) @ np.array(axes).T
    return seen


def _points_of_line(line: Line) -> _Points:
    """A tube with round ends, as balls along it."""
    begin, end = _on_screen(np.array(line))
    along = np.linspace(0, 1, max(int(np.linalg.norm(end - begin)), 1) + 1)[:, None]
    radius = _THICK * _FINER * _STATURE
    across = np.arange(-np.ceil(radius), np.ceil(radius) + 1)
    x, y = (each.ravel() for each in np.meshgrid(across, across))
    x, y = (each[np.hypot(x, y) <= radius] for each in (x, y))
    ball = np.column_stack((x, y, np.sqrt(radius**2 - x**2 - y**2)))
    places = (begin + along * (end - begin))[:, None] + ball
    return _Points(places.reshape(-1, 3), np.tile(_shade(ball / radius), len(along)))


def _points_of(surface: Surface) -> _Points:
    """Points on each face, so near to each other that they cover it."""
    corners = _on_screen(surface.places)[surface.corners]
    sides = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    lengths = np.linalg.norm(sides, axis=-1, keepdims=True)
    normals = np.divide(sides, lengths, out=np.zeros_like(sides), where=lengths > 0)
    brightness = _shade(np.where(normals[:, 2:] < 0, -normals, normals))
    longest = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=-1).max(-1)
    steps = 2 ** np.ceil(np.log2(np.maximum(longest, 1))).astype(int)
    places, bright = [np.empty((0, 3))], [np.empty(0)]
    for count in np.unique(steps):
        chosen, shares = steps == count, _shares(int(count))
        places.append(np.einsum("pc,tcx->tpx", shares, corners[chosen]).reshape(-1, 3))
        bright.append(np.repeat(brightness[chosen], len(shares)))
    return _Points(np.concatenate(places), np.concatenate(bright))


def _shares(count: int) -> Floats:
    """Points of a triangle [P,3], as shares of its corners, so many steps along each side."""
    i, j = (each.ravel() for each in np.meshgrid(np.arange(count + 1), np.arange(count + 1)))
    i, j = i[i + j <= count], j[i + j <= count]
    return np.column_stack((i, j, count - i - j)) / count


def _shade(normals: Floats) -> Floats:
    shade: Floats = 0.35 + 0.65 * np.maximum(normals @ _LIGHT, 0)
    return shade
