# SPDX-License-Identifier: GPL-3.0-or-later
"""Places on a painted area, and the outlines of what stands around."""

from __future__ import annotations

import math
from collections.abc import Iterable
from random import Random
from typing import Any

import bpy
import numpy as np
from mathutils import Vector, geometry

from ..errors import UserError

_TRIES = 400  # for each place, until the area counts as full
_FEWEST = 3  # corners of an outline


class Area:
    """The faces of a mesh as they lie in the world, where its active vertex group is painted: the more, the likelier.
    Without a group all of it. UserError where there is nothing."""

    def __init__(self, context: bpy.types.Context, obj: bpy.types.Object | None) -> None:
        if obj is None or obj.type != "MESH":
            raise UserError("No area is chosen to populate: choose a mesh under Populate, and paint weights on it")
        self._name = obj.name
        seen = obj.evaluated_get(context.evaluated_depsgraph_get())
        mesh = seen.to_mesh()
        mesh.transform(seen.matrix_world)
        mesh.calc_loop_triangles()
        group = obj.vertex_groups.active_index if len(obj.vertex_groups) else None
        painted = [1.0 if group is None else _weight(vertex, group) for vertex in mesh.vertices]
        places = [tuple(vertex.co) for vertex in mesh.vertices]
        corners = [tuple(triangle.vertices) for triangle in mesh.loop_triangles]
        seen.to_mesh_clear()
        self._corners = np.array([[places[v] for v in triangle] for triangle in corners]).reshape(-1, 3, 3)
        self._painted = np.array([[painted[v] for v in triangle] for triangle in corners]).reshape(-1, 3)
        a, b, c = self._corners[:, 0], self._corners[:, 1], self._corners[:, 2]
        sizes = np.linalg.norm(np.cross(b - a, c - a), axis=1) * self._painted.max(axis=1, initial=0)
        if not sizes.sum() > 0:
            raise UserError(f"Nothing of '{self._name}' is painted: paint its active vertex group, or remove the group")
        self._shares = np.cumsum(sizes) / sizes.sum()

    def draw(self, random: Random) -> Vector:
        """A place in the world."""
        while True:
            index = int(np.searchsorted(self._shares, random.random()))
            u, v = math.sqrt(random.random()), random.random()
            shares = np.array((1 - u, u * (1 - v), u * v))
            if random.random() * self._painted[index].max() <= shares @ self._painted[index]:
                return Vector(shares @ self._corners[index])

    def draw_apart(self, random: Random, count: int, spacing: float) -> list[Vector]:
        """So many places, no two of which are nearer than the spacing; UserError where there is no room."""
        found: list[Vector] = []
        for _ in range(count * _TRIES):
            if len(found) == count:
                break
            place = self.draw(random)
            if all((place - other).xy.length >= spacing for other in found):
                found.append(place)
        if len(found) < count:
            raise UserError(
                f"'{self._name}' has room for {len(found)} of {count} copies {spacing:g} m apart: let there be "
                "fewer, or nearer, or paint more of it"
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
