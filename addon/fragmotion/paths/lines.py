# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves, strokes and way points as lines from point to point in the world, as they are shown now."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any, NamedTuple

import bpy
import numpy as np
from mathutils import Vector
from numpy.typing import NDArray

from ..compat import strokes
from ..errors import UserError

TYPES = ("CURVE", *strokes.TYPES)
"""Of the objects that can be followed."""

_FINE = 24  # points at least from one of a curve's points to the next
_FEWEST = 2  # points of a line


class Line(NamedTuple):
    """Points [N,3] in the world, m; how wide it is at each [N], 1 where it is plain; what the user should be told."""

    name: str
    points: NDArray[Any]
    widths: NDArray[Any]
    closed: bool
    remarks: list[str]


def line_of(context: bpy.types.Context, obj: bpy.types.Object) -> Line:
    """A curve's or Grease Pencil object's first line. UserError where it has none."""
    if obj.type not in TYPES:
        raise UserError(f"'{obj.name}' is no curve or Grease Pencil object: choose one, or draw it")
    points, widths, closed, count = _of_curve(obj) if obj.type == "CURVE" else _of_strokes(obj)
    if len(points) < _FEWEST:
        raise UserError(f"'{obj.name}' has no line with two points: draw one in it")
    shown = obj.evaluated_get(context.evaluated_depsgraph_get()).matrix_world
    remarks = [f"'{obj.name}' has {count} lines, of which the first is followed"] if count > 1 else []
    if _is_animated(obj):
        remarks.append(f"'{obj.name}' is animated and was taken as it is at frame {context.scene.frame_current}")
    return Line(obj.name, np.array([shown @ Vector(p) for p in points]), np.array(widths), closed, remarks)


def through(context: bpy.types.Context, name: str, objects: Sequence[bpy.types.Object]) -> Line:
    """A smooth line through objects in the order of their names. UserError on fewer than two."""
    if len(objects) < _FEWEST:
        raise UserError(f"{name}: {len(objects)} way points, and a path needs two: add empties to it")
    graph = context.evaluated_depsgraph_get()
    shown = [obj.evaluated_get(graph).matrix_world for obj in sorted(objects, key=lambda obj: obj.name)]
    curve = bpy.data.curves.new("Way Points", "CURVE")
    curve.dimensions = "3D"
    spline = curve.splines.new("BEZIER")
    spline.bezier_points.add(len(shown) - 1)
    for point, world in zip(spline.bezier_points, shown):
        point.co = world.translation
        point.handle_left_type = point.handle_right_type = "AUTO"
    try:
        with _alone(curve) as points:
            line = np.array(points)
    finally:
        bpy.data.curves.remove(curve)
    return Line(name, line, np.ones(len(line)), False, [])


def _of_curve(obj: bpy.types.Object) -> tuple[list[Any], list[float], bool, int]:
    """The points of a curve's first spline in the object's space, their radii, whether it is cyclic; and how many
    splines there are."""
    data: Any = obj.data
    usable = [index for index, spline in enumerate(data.splines) if len(_knots(spline)) >= _FEWEST]
    if not usable:
        return [], [], False, 0
    curve = data.copy()
    try:
        for spline in [spline for index, spline in enumerate(curve.splines) if index != usable[0]]:
            curve.splines.remove(spline)
        kept = curve.splines[0]
        closed, radii = bool(kept.use_cyclic_u), [point.radius for point in _knots(kept)]
        with _alone(curve) as points:
            return points, _spread(radii, len(points), closed), closed, len(usable)
    finally:
        bpy.data.curves.remove(curve)


def _knots(spline: Any) -> Any:
    return spline.bezier_points if spline.type == "BEZIER" else spline.points


@contextmanager
def _alone(curve: Any) -> Iterator[list[tuple[float, float, float]]]:
    """The points through which Blender draws a curve of one spline, without its thickness."""
    curve.dimensions = "3D"
    curve.bevel_object = curve.taper_object = None
    curve.bevel_depth = curve.extrude = curve.offset = 0.0
    curve.bevel_factor_start, curve.bevel_factor_end = 0.0, 1.0
    curve.resolution_u = max(curve.resolution_u, _FINE)
    for spline in curve.splines:
        spline.resolution_u = max(spline.resolution_u, _FINE)
    holder = bpy.data.objects.new("Path", curve)
    try:
        mesh = holder.to_mesh()
        yield [tuple(vertex.co) for vertex in mesh.vertices]
        holder.to_mesh_clear()
    finally:
        bpy.data.objects.remove(holder)


def _spread(radii: Sequence[float], count: int, closed: bool) -> list[float]:
    """The radii of so many points, from those of the few that make the curve."""
    known = np.linspace(0, 1, len(radii) + closed)
    values = [*radii, radii[0]] if closed else radii
    return [float(value) for value in np.interp(np.linspace(0, 1, count + closed)[:count], known, values)]


def _of_strokes(obj: bpy.types.Object) -> tuple[list[Any], list[float], bool, int]:
    """The first stroke; widths as parts of their mean."""
    found = [stroke for stroke in strokes.strokes_of(obj) if len(stroke.points) >= _FEWEST]
    if not found:
        return [], [], False, 0
    points, widths, closed = found[0]
    mean = sum(widths) / len(widths) or 1.0
    return list(points), [width / mean for width in widths], closed, len(found)


def _is_animated(obj: bpy.types.Object) -> bool:
    """Whether the object, what it hangs on, or its shape has keys or drivers."""
    holders: list[Any] = [obj.data, getattr(obj.data, "shape_keys", None)]
    above: bpy.types.Object | None = obj
    while above is not None:
        holders.append(above)
        above = above.parent
    found = [data for holder in holders if holder is not None and (data := holder.animation_data) is not None]
    return any(data.action is not None or data.drivers or data.nla_tracks for data in found)
