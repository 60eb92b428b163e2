# SPDX-License-Identifier: GPL-3.0-or-later
"""A path that was drawn, as an object."""

from __future__ import annotations

from collections.abc import Sequence

import bpy
from mathutils import Vector


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
