# SPDX-License-Identifier: GPL-3.0-or-later
"""A take beside what was made of it on another body: three of its moments, each body seen from its own character frame
and as large as the other."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import bpy
import numpy as np
from mathutils import Matrix, Quaternion, Vector

from ..errors import UserError
from ..rig.belongings import belongings
from ..rig.posing import playing, visit
from .figures import Figure, Line, Surface, draw_pairs
from .sampling import rig_as_posed, sample, sample_times

if TYPE_CHECKING:
    from fragmotion_core import Clip, Doubles, Skeleton

SOURCE = "fragmotion_source"
"""Custom property of an Action that was made of a take: the take's bones in three moments."""

_MOMENTS = (1 / 6, 1 / 2, 5 / 6)  # of the take
_ENDS = 2 * 3  # numbers of a bone: where it begins and ends


def keep_source(action: bpy.types.Action, clip: Clip, skeleton: Skeleton) -> None:
    """Keep with an Action how the take was of which it was made."""
    bones = [_bones(clip, skeleton, index) for index in _indices(clip)]
    action[SOURCE] = np.array(bones).ravel().tolist()


def source_of(action: bpy.types.Action) -> Doubles | None:
    """The bones [3,B,2,3] that were kept, in statures; None where there are none, or what is there are none."""
    kept = action.get(SOURCE)
    numbers = np.array(kept if hasattr(kept, "typecode") and kept.typecode in "df" else (), float)
    if not len(numbers) or len(numbers) % (len(_MOMENTS) * _ENDS) or not np.isfinite(numbers).all():
        return None
    return numbers.reshape(len(_MOMENTS), -1, 2, 3)


def compare(context: bpy.types.Context, obj: bpy.types.Object, action: bpy.types.Action) -> bpy.types.Image:
    """The picture of an Action's source and of what the armature shows by it, with the meshes that it deforms."""
    source = source_of(action)
    if source is None:
        raise UserError(f"Action '{action.name}' does not tell of what it was made: import or retarget it again")
    pairs = list(zip([Figure([Line(*bone) for bone in bones]) for bones in source], _results(context, obj, action)))
    return _as_image(draw_pairs(pairs))


def _results(context: bpy.types.Context, obj: bpy.types.Object, action: bpy.types.Action) -> Iterator[Figure]:
    rig = rig_as_posed(obj)
    clip, times = sample(context, obj, action, rig), sample_times(context.scene, obj, action)
    meshes = [each for each in belongings(obj) if each.type == "MESH" and each.visible_get()]
    indices = _indices(clip)
    if not meshes:
        yield from (Figure([Line(*bone) for bone in _bones(clip, rig.skeleton, index)]) for index in indices)
        return
    with playing(context, obj, action):
        for index, _ in zip(indices, visit(context.scene, times[indices])):
            seen = _frame(clip, rig.skeleton, index)
            yield Figure([], [_surface(context, mesh, seen) for mesh in meshes])


def _indices(clip: Clip) -> list[int]:
    return [int(moment * len(clip.rotations)) for moment in _MOMENTS]


def _frame(clip: Clip, skeleton: Skeleton, index: int) -> Matrix:
    """What brings the world into the character frame, in statures."""
    x, y, heading = clip.character_frames(skeleton)[index]
    turned = Matrix.Rotation(-heading, 4, "Z") @ Matrix.Translation((-x, -y, 0))
    return Matrix.Scale(1 / skeleton.stature, 4) @ turned


def _bones(clip: Clip, skeleton: Skeleton, index: int) -> list[tuple[Vector, Vector]]:
    """Where bones begin and end, as seen from the character frame; bones above the hips are no part of the body."""
    heads, turns = (each[index] for each in clip.world_transforms(skeleton))
    seen, hips = _frame(clip, skeleton, index), skeleton.names.index(skeleton.roles["hips"])
    body, bones = {hips}, []
    for bone, parent in enumerate(skeleton.parents):
        if parent in body:
            body.add(bone)
            bones.append((Vector(heads[parent]), Vector(heads[bone])))
    for bone in sorted(body - set(skeleton.parents)):
        tip = Vector(skeleton.tips[bone])
        bones.append((Vector(heads[bone]), Vector(heads[bone]) + Quaternion(turns[bone]) @ tip))
    return [(seen @ begin, seen @ end) for begin, end in bones]


def _surface(context: bpy.types.Context, obj: bpy.types.Object, seen: Matrix) -> Surface:
    posed = obj.evaluated_get(context.evaluated_depsgraph_get())
    mesh = posed.to_mesh()
    mesh.transform(seen @ posed.matrix_world)
    mesh.calc_loop_triangles()
    places = np.empty(3 * len(mesh.vertices), np.float32)
    corners = np.empty(3 * len(mesh.loop_triangles), np.int32)
    mesh.vertices.foreach_get("co", places)
    mesh.loop_triangles.foreach_get("vertices", corners)
    posed.to_mesh_clear()
    return Surface(places.reshape(-1, 3).astype(float), corners.reshape(-1, 3))


def _as_image(pixels: Any) -> bpy.types.Image:
    """The picture as the file's own image, in place of the last one."""
    height, width = pixels.shape[:2]
    image = bpy.data.images.get(IMAGE)
    if image is None or image.library is not None or image.source != "GENERATED":
        image = bpy.data.images.new(IMAGE, width, height)
    if tuple(image.size) != (width, height):
        image.scale(width, height)
    image.pixels.foreach_set(pixels.ravel())
    image.update()
    return image


IMAGE = "Source and Result"
"""The name of the image."""
