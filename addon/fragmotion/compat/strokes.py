# SPDX-License-Identifier: GPL-3.0-or-later
"""The strokes of a Grease Pencil object: of its own kind up to 4.2, of curves from 4.3 on."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import bpy

TYPES = ("GPENCIL", "GREASEPENCIL")
"""The types of a Grease Pencil object in all Blenders."""


class Stroke(NamedTuple):
    """Points [N,3] in the object's space, and how thick it is at each, in any unit."""

    points: list[tuple[float, float, float]]
    widths: list[float]
    closed: bool


def strokes_of(obj: bpy.types.Object) -> list[Stroke]:
    """What the layers that can be seen show now."""
    data: Any = obj.data
    layers = [layer for layer in data.layers if not layer.hide]
    return [stroke for layer in layers for stroke in (_curves(layer) if obj.type == TYPES[1] else _pencil(layer))]


def _pencil(layer: Any) -> Iterator[Stroke]:
    for stroke in layer.active_frame.strokes if layer.active_frame else ():
        points = list(stroke.points)
        yield Stroke([tuple(p.co) for p in points], [p.pressure for p in points], stroke.use_cyclic)


def _curves(layer: Any) -> Iterator[Stroke]:
    frame = layer.current_frame()
    for stroke in frame.drawing.strokes if frame else ():
        points = list(stroke.points)
        yield Stroke([tuple(p.position) for p in points], [p.radius for p in points], stroke.cyclic)
