# SPDX-License-Identifier: GPL-3.0-or-later
"""Painted areas, and the outlines of what stands around."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import bpy
import numpy as np
from mathutils import Vector, geometry

from ..compat.core import core
from ..errors import UserError

if TYPE_CHECKING:
    from fragmotion_core import Doubles, PaintedArea

_FEWEST = 3  # corners of an outline


def painted_area(context: bpy.types.Context, obj: bpy.types.Object | None) -> PaintedArea:
    """The faces of a mesh as they lie in the world, painted as its active vertex group is, and all of it without a
    group. UserError where there is nothing."""
    if obj is None or obj.type != "MESH":
        raise UserError("No area is chosen to populate: choose a mesh under Populate, and paint weights on it")
    seen = obj.evaluated_get(context.evaluated_depsgraph_get())
    mesh = seen.to_mesh()
    mesh.transform(seen.matrix_world)
    mesh.calc_loop_triangles()
    group = obj.vertex_groups.active_index if len(obj.vertex_groups) else None
    painted = np.array([1.0 if group is None else _weight(vertex, group) for vertex in mesh.vertices])
    places = np.array([tuple(vertex.co) for vertex in mesh.vertices]).reshape(-1, 3)
    corners = np.array([tuple(triangle.vertices) for triangle in mesh.loop_triangles], int).reshape(-1, 3)
    seen.to_mesh_clear()
    try:
        area: PaintedArea = core.PaintedArea(places[corners], painted[corners])
    except ValueError as error:
        mend = "" if group is None else ". Paint its active vertex group, or remove the group"
        raise UserError(f"'{obj.name}' is no area: {error}{mend}") from None
    return area


def places_apart(area: PaintedArea, name: str, count: int, spacing: float, seed: int, room: float) -> Doubles:
    """So many places [count,3] on the area of that name, no two nearer than the spacing, and at its edge only where
    there is no room else; UserError where there is none for them."""
    found: Doubles = area.draw_apart(count, spacing, seed, room)
    if len(found) < count:
        raise UserError(
            f"'{name}' has room for {len(found)} of {count} copies {spacing:g} m apart: let there be fewer, or "
            "nearer, or paint more of it"
        )
    return found


def outlines(objects: Iterable[bpy.types.Object]) -> list[list[tuple[float, float]]]:
    """From above, the boxes around objects in the world: convex outlines, m."""
    found = []
    for obj in objects:
        corners = [tuple((obj.matrix_world @ Vector(corner)).xy) for corner in obj.bound_box]
        hull = geometry.convex_hull_2d(corners)
        if len(hull) >= _FEWEST:
            found.append([corners[index] for index in hull])
    return found


def _weight(vertex: Any, group: int) -> float:
    return next((float(each.weight) for each in vertex.groups if each.group == group), 0.0)
