# SPDX-License-Identifier: GPL-3.0-or-later
"""The control coverage as pictures (Fig. 4): for each turn and jump a circle of directions for each speed.

The panel shows them as icons, which every Blender draws, in a window or not.
"""

from __future__ import annotations

import math
from typing import Any

import bpy
import bpy.utils.previews
import numpy as np
from numpy.typing import NDArray

from .control_layout import ControlLayout
from .coverage import WELL

SIZE = 128
"""Pixels along a picture's side."""

Pixels = NDArray[np.float32]

_POOR = 1.5  # ControlDis from which a control counts as not performed at all: half a walk's speed or a turn off
_RINGS = ((0.84,), (0.5, 0.84), (0.42, 0.63, 0.84), (0.39, 0.54, 0.69, 0.84))  # of the half side, by speeds
_DOT, _APART = 0.16, 0.47  # a dot's radius at most; that over what is between two dots
_SMOOTH = 0.02  # over which edges fade
_GROUND = (0.34, 0.34, 0.34, 1)  # opaque: Blenders differ in what they make of a half-transparent icon
_LINE = (0.5, 0.5, 0.5, 1)
_CROSS = (0.05, 0.05, 0.05, 1)
_COLOURS = ((0.20, 0.62, 0.95), (0.98, 0.80, 0.25), (0.88, 0.28, 0.22))  # well, in between, not at all
_SWATCHES = {"well": 0.0, "nearly": _POOR, "not": np.inf}  # the legend's distances

_SMALLEST = 2.0  # widgets' heights
_UNIT, _MARGIN = 20, 60  # pixels of a widget's height, and of what the sidebar needs besides

_ICON = 4  # pixels of a picture that make one of its icon

_previews: Any = None
_drawn: dict[str, bytes] = {}  # what each preview shows


def colour_of(distance: float) -> NDArray[np.float64]:
    """The colour [3] of a control that is so far (ControlDis) from the nearest fragment: one of the legend's."""
    return np.array(_COLOURS[int(np.searchsorted((WELL, _POOR), distance))])


def places(layout: ControlLayout) -> NDArray[np.float64]:
    """Where the velocities stand in a picture [velocities,2], in half sides from the middle: forward is up."""
    angles = np.arange(layout.directions) * 2 * np.pi / layout.directions
    circle = np.column_stack((-np.sin(angles), np.cos(angles)))
    return np.concatenate(([[0, 0]], *(ring * circle for ring in _rings(layout))))


def _rings(layout: ControlLayout) -> tuple[float, ...]:
    return _RINGS[len(layout.gaits) - 1]


def _dot(layout: ControlLayout) -> float:
    """The radius of dots that do not touch each other."""
    rings = _rings(layout)
    apart = [outer - inner for inner, outer in zip(rings, rings[1:])]
    return _APART * min(_DOT / _APART, *apart, 2 * math.pi * rings[0] / layout.directions)


def draw_controls(distances: NDArray[Any], layout: ControlLayout) -> Pixels:
    """The picture [SIZE,SIZE,4] of the velocities' distances, row 0 at the bottom; a cross where none performs well."""
    across = (np.arange(SIZE) + 0.5) / SIZE * 2 - 1
    x, y = np.meshgrid(across, across)
    picture: Pixels = np.zeros((SIZE, SIZE, 4), np.float32)
    radius = np.hypot(x, y)
    _blend(picture, _inside(radius, 1 - _SMOOTH), _GROUND)
    for ring in _rings(layout):
        _blend(picture, _inside(np.abs(radius - ring), 0.008), _LINE)
    for (a, b), distance in zip(places(layout), distances):
        _draw_dot(picture, x - a, y - b, _dot(layout), float(distance))
    return picture


def draw_swatch(distance: float) -> Pixels:
    """A dot of the legend, as large as the picture."""
    across = (np.arange(SIZE) + 0.5) / SIZE * 2 - 1
    x, y = np.meshgrid(across, across)
    picture: Pixels = np.zeros((SIZE, SIZE, 4), np.float32)
    _draw_dot(picture, x, y, 0.7, distance)
    return picture


def icon_of(name: str, pixels: Any, stamp: bytes) -> int:
    """The icon of that name; `pixels()` makes its picture where `stamp` tells that it has changed."""
    global _previews
    if _previews is None:
        _previews = bpy.utils.previews.new()
    if _drawn.get(name) != stamp:
        if name in _previews:
            del _previews[name]
        preview = _previews.new(name)
        drawn = pixels()
        preview.image_size = (SIZE, SIZE)
        preview.image_pixels_float = drawn.ravel()
        preview.icon_size = (SIZE // _ICON, SIZE // _ICON)
        preview.icon_pixels_float = drawn.reshape(SIZE // _ICON, _ICON, SIZE // _ICON, _ICON, 4).mean((1, 3)).ravel()
        _drawn[name] = stamp
    return int(_previews[name].icon_id)


def draw_pictures(layout: bpy.types.UILayout, stored: bytes, controls: ControlLayout | None, width: float) -> None:
    """A picture for each turn and jump with their legend, from the distances that Build has kept, in a region so many
    pixels wide; none where the .blend is damaged."""
    if controls is None or len(stored) != math.prod(controls.shape) * np.dtype(np.float32).itemsize:
        return
    scale = max(_SMALLEST, (width / bpy.context.preferences.system.ui_scale - _MARGIN) / 3 / _UNIT)
    distances = np.frombuffer(stored, np.float32).reshape(controls.shape)
    column = layout.column(align=True)
    heads = column.row(align=True)
    turns = {"Turn left": 2, "Straight": 1, "Turn right": 0} if controls.turn else {"Straight": 0}
    for head in turns:
        _centred(heads, head)
    for jump, title in enumerate(("No jump", "Jump")[: controls.shape[2]]):
        _centred(column, title)
        row = column.row(align=True)
        for turn in turns.values():
            cell = distances[:, turn, jump]
            stamp = repr(controls).encode() + cell.tobytes()
            icon = icon_of(f"turn {turn} jump {jump}", lambda cell=cell: draw_controls(cell, controls), stamp)
            row.template_icon(icon, scale=scale)
    _draw_legend(layout, controls.gaits)


def free() -> None:
    """Give the icons back to Blender."""
    global _previews
    if _previews is not None:
        bpy.utils.previews.remove(_previews)
    _previews = None
    _drawn.clear()


def _draw_legend(layout: bpy.types.UILayout, gaits: tuple[str, ...]) -> None:
    column = layout.column(align=True)
    for (name, distance), text in zip(_SWATCHES.items(), ("In the takes", "Near them: a hole", "Far off: a hole")):
        icon = icon_of(name, lambda distance=distance: draw_swatch(distance), b"legend")
        column.label(text=text, icon_value=icon)
    sides = ("Circle",) if len(gaits) == 1 else ("Inner circle", *[""] * (len(gaits) - 2), "Outer circle")
    circles = [f"{side or 'Next circle'}: {gait}" for side, gait in zip(sides, gaits)]
    for line in ("Up: forward", "Middle: stand", *circles):
        column.label(text=line, icon="BLANK1")


def _centred(layout: bpy.types.UILayout, text: str) -> None:
    row = layout.row()
    row.alignment = "CENTER"
    row.label(text=text)


def _draw_dot(picture: Pixels, x: NDArray[Any], y: NDArray[Any], radius: float, distance: float) -> None:
    inside = _inside(np.hypot(x, y), radius)
    _blend(picture, inside, (*colour_of(distance), 1))
    if distance > WELL:
        off = np.minimum(np.abs(x - y), np.abs(x + y)) / np.sqrt(2)
        _blend(picture, inside * _inside(off, 0.15 * radius), _CROSS)


def _inside(distance: NDArray[Any], edge: float) -> NDArray[Any]:
    return np.clip((edge - distance) / _SMOOTH + 0.5, 0, 1)


def _blend(picture: Pixels, weight: NDArray[Any], colour: tuple[float, ...]) -> None:
    """Paint a colour over the picture where the weight says, neither premultiplied."""
    over = weight * colour[3]
    alpha = over + picture[..., 3] * (1 - over)
    share = np.divide(over, alpha, out=np.zeros_like(alpha), where=alpha > 0)[..., None]
    picture[..., :3] = share * np.array(colour[:3]) + (1 - share) * picture[..., :3]
    picture[..., 3] = alpha
