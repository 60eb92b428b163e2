# SPDX-License-Identifier: GPL-3.0-or-later
"""The ground under the mouse, and a path that was drawn on it as an object."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
from bpy_extras.view3d_utils import region_2d_to_origin_3d, region_2d_to_vector_3d
from mathutils import Vector
from mathutils.geometry import intersect_line_plane

from ..ground.meshes import Ground


def ground_under(area: bpy.types.Area, x: float, y: float, ground: Ground | None) -> Vector | None:
    """The place on the ground (None: the plane) that a 3D view shows at a pixel of its main region; None where there is
    none."""
    region = next(part for part in area.regions if part.type == "WINDOW")
    view = area.spaces.active.region_3d
    eye, along = region_2d_to_origin_3d(region, view, (x, y)), region_2d_to_vector_3d(region, view, (x, y))
    if ground is not None:
        return ground.seen_along(eye, along)
    place = intersect_line_plane(eye, eye + along, Vector(), Vector((0, 0, 1)))
    return place if place is not None and (place - eye).dot(along) > 0 else None


def add_curve(context: bpy.types.Context, points: Sequence[Vector]) -> bpy.types.Object:
    """A curve through points in the world, in the scene; what is active and selected stays."""
    curve = bpy.data.curves.new("Path", "CURVE")
    curve.dimensions = "3D"
    spline = curve.splines.new("POLY")
    spline.points.add(len(points) - 1)
    for point, place in zip(spline.points, points):
        point.co = (*place, 1.0)
    obj = bpy.data.objects.new("Path", curve)
    context.collection.objects.link(obj)
    return obj
