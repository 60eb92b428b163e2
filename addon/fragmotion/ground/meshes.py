# SPDX-License-Identifier: GPL-3.0-or-later
"""The ground that an armature is set to, made of the meshes as they stand now."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import bpy
import numpy as np
from mathutils import Matrix, Vector
from mathutils.bvhtree import BVHTree

from ..errors import UserError
from ..rig.belongings import belongings
from ..rig.external_motion import animated
from ..rig.rigs import make_rig, stretch_of

if TYPE_CHECKING:
    from fragmotion_core import Player

WITH_FACES = frozenset({"MESH", "CURVE", "SURFACE", "FONT", "META"})
"""The types of objects that may be ground."""

_DOWN = Vector((0, 0, -1))
_OVER = 1.0  # m over all of it, where a ray begins at most: Blender's rays are of single precision
_HELP = "choose another under Drive > Ground, or Plane there"


class Ground:
    """Meshes in the world, as the core's Player asks for the ground. It calls nothing of Blender's data."""

    def __init__(self, tree: BVHTree, top: float, remark: str, seen: Matrix | None = None) -> None:
        """`top`: over all of it; `seen`: what moves a place of who asks to the world."""
        self.remark = remark
        """What the user should know of it, empty where that is nothing."""
        self._tree, self._top = tree, top
        self._seen = seen or Matrix()
        self._back = self._seen.inverted()
        self._normals_back = self._seen.to_3x3().transposed()  # normals go back so, whatever stretches places

    def __call__(self, x: float, y: float, z: float) -> tuple[float, float, float, float] | None:
        """The height and the normal of what a ray down from a place meets, or None."""
        hit, normal, _, _ = self._tree.ray_cast(self._seen @ Vector((x, y, min(z, self._top))), _DOWN)
        return None if hit is None else ((self._back @ hit).z, *(self._normals_back @ normal).normalized())

    def seen_along(self, eye: Vector, along: Vector) -> Vector | None:
        """The place in the world where a line of sight meets it first, or None."""
        return self._tree.ray_cast(eye, along)[0]

    def seen_from(self, moved: Matrix) -> Ground:
        """The same for one who plays elsewhere than he is seen: `moved` takes the one place, on the level, to the
        other."""
        return Ground(self._tree, self._top, self.remark, moved @ self._seen)


def find_ground(context: bpy.types.Context, obj: bpy.types.Object) -> Ground | None:
    """What the armature is set to stand on, None where that is the plane; UserError where it is nothing to stand on."""
    settings = obj.fragmotion.ground
    if settings.kind == "PLANE":
        return None
    own = {obj, *belongings(obj)}
    chosen = _chosen_object(settings, own) if settings.kind == "OBJECT" else _chosen_collection(settings, own)
    points, faces = _faces(context, chosen)
    if not faces:
        what = f"'{chosen[0].name}'" if settings.kind == "OBJECT" else f"collection '{settings.collection.name}'"
        raise UserError(f"The ground {what} has no faces: {_HELP}")
    moving = [each.name for each in chosen if animated(each)]
    remark = f"The ground '{moving[0]}' moves: it is taken as it stands now" if moving else ""
    top = max(z for _, _, z in points) + _OVER
    return Ground(BVHTree.FromPolygons(points, faces), top, remark, stretch_of(make_rig(obj)))


def remarks_of(player: Player, ground: Ground | None) -> list[str]:
    """What the user should be told of the ground that a player went on."""
    if ground is None:
        return []
    missed = player.ground_missed
    hole = f"for {missed:.1f} s there was no ground under its feet, where it went on at the height that it had"
    return [remark for remark in (hole if missed else "", ground.remark) if remark]


def _chosen_object(settings: Any, own: set[bpy.types.Object]) -> list[bpy.types.Object]:
    chosen = settings.object
    if chosen is None:
        raise UserError(f"The ground is to be an object, and none is chosen: {_HELP}")
    if chosen in own:
        raise UserError(f"The ground '{chosen.name}' belongs to the character itself: {_HELP}")
    if chosen.type not in WITH_FACES:
        raise UserError(f"The ground '{chosen.name}' is no mesh: {_HELP}")
    if not _is_there(chosen):
        raise UserError(f"The ground '{chosen.name}' is disabled in the viewport or not of this scene: enable it")
    return [chosen]


def _chosen_collection(settings: Any, own: set[bpy.types.Object]) -> list[bpy.types.Object]:
    if settings.collection is None:
        raise UserError(f"The ground is to be a collection, and none is chosen: {_HELP}")
    chosen = [
        each
        for each in settings.collection.all_objects
        if each.type in WITH_FACES and each not in own and _is_there(each) and each.visible_get()
    ]
    if not chosen:
        raise UserError(
            f"The ground collection '{settings.collection.name}' holds no mesh that is visible: tick it in the "
            f"outliner, or {_HELP}"
        )
    return chosen


def _is_there(obj: bpy.types.Object) -> bool:
    """Whether Blender evaluates it: hidden objects are, disabled ones are not."""
    return not obj.hide_viewport and obj.name in bpy.context.view_layer.objects


def _faces(context: bpy.types.Context, objects: list[bpy.types.Object]) -> tuple[list[list[float]], list[list[int]]]:
    """The objects' points in the world and their triangles."""
    points: list[list[float]] = []
    faces: list[list[int]] = []
    for mesh in _meshes(context, objects):
        first = len(points)
        places = np.empty(3 * len(mesh.vertices), np.float32)
        mesh.vertices.foreach_get("co", places)
        points.extend(places.reshape(-1, 3).tolist())
        mesh.calc_loop_triangles()
        corners = np.empty(3 * len(mesh.loop_triangles), np.int32)
        mesh.loop_triangles.foreach_get("vertices", corners)
        faces.extend((corners.reshape(-1, 3) + first).tolist())
    return points, faces


def _meshes(context: bpy.types.Context, objects: list[bpy.types.Object]) -> Iterator[bpy.types.Mesh]:
    """Each object's mesh as it is seen now, in the world."""
    graph = context.evaluated_depsgraph_get()
    for obj in objects:
        seen = obj.evaluated_get(graph)
        mesh = seen.to_mesh()
        if mesh is None:
            continue
        mesh.transform(seen.matrix_world)
        yield mesh
        seen.to_mesh_clear()
