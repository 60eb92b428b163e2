# SPDX-License-Identifier: GPL-3.0-or-later
"""What of meshes follows which bones of an armature."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import bpy
import numpy as np
from mathutils import Matrix

from ..compat.core import core
from .rigs import held_of, sizes_of, stretch_of

if TYPE_CHECKING:
    from fragmotion_core import Doubles, Rig, Skin

_TURNS = ("COPY_ROTATION", "COPY_TRANSFORMS", "TRANSFORM", "ARMATURE")
"""Constraints by which a bone turns as others of its armature do."""


def make_skin(obj: bpy.types.Object, rig: Rig) -> Skin:
    """The skin of an armature: the meshes that it deforms by their vertex groups, and those that are its bones'
    children; but for what follows bones that constraints turn as others are turned."""
    skin: Skin = core.Skin(rig.skeleton)
    copies = _copies(obj)
    to = stretch_of(rig).inverted() @ _carried(obj, rig)
    for mesh in bpy.data.objects:
        if mesh.type != "MESH":
            continue
        if mesh.find_armature() == obj:
            groups = ["" if name in copies else name for name, _ in mesh.vertex_groups.items()]
            skin.add(np.array(to @ mesh.matrix_world), _points(mesh), groups, _weights(mesh))
        elif mesh.parent == obj and mesh.parent_type == "BONE" and mesh.parent_bone in obj.data.bones:
            points = _points(mesh)
            rows = np.column_stack([np.arange(len(points)), np.zeros(len(points)), np.ones(len(points))])
            skin.add(np.array(to @ _resting(mesh, obj)), points, [mesh.parent_bone], rows)
    return skin


def is_skinned(obj: bpy.types.Object) -> bool:
    """Whether an armature deforms a mesh."""
    return any(mesh.type == "MESH" and mesh.find_armature() == obj for mesh in bpy.data.objects)


def followed_bones(obj: bpy.types.Object) -> Iterator[str]:
    """The bones that meshes follow, by their weights or as their children: each as often as it is met."""
    for mesh in bpy.data.objects:
        if mesh.type != "MESH":
            continue
        if mesh.find_armature() == obj:
            names = [group.name for group in mesh.vertex_groups]
            weights = (each for vertex in mesh.data.vertices for each in vertex.groups)
            yield from (names[each.group] for each in weights if each.weight > 0)
        elif mesh.parent == obj and mesh.parent_type == "BONE":
            yield mesh.parent_bone


def _copies(obj: bpy.types.Object) -> set[str]:
    return {
        bone.name
        for bone in obj.pose.bones
        for each in bone.constraints
        if each.type in _TURNS and not each.mute and each.influence > 0
    }


def _carried(obj: bpy.types.Object, rig: Rig) -> Matrix:
    """What takes meshes at rest to where held bones carry the body."""
    if not held_of(obj) and not sizes_of(obj):
        return Matrix()
    return obj.matrix_world @ Matrix(rig.carried.tolist()) @ obj.matrix_world.inverted()


def _points(mesh: bpy.types.Object) -> Doubles:
    points = np.empty(3 * len(mesh.data.vertices), np.float32)
    mesh.data.vertices.foreach_get("co", points)
    return points.reshape(-1, 3).astype(float)


def _weights(mesh: bpy.types.Object) -> Doubles:
    """Rows of a vertex, a group and how much it follows that."""
    rows = [(vertex.index, group.group, group.weight) for vertex in mesh.data.vertices for group in vertex.groups]
    return np.array(rows, float).reshape(-1, 3)


def _resting(mesh: bpy.types.Object, obj: bpy.types.Object) -> Matrix:
    """Where a bone's child is while the armature rests."""
    bone = obj.pose.bones[mesh.parent_bone]
    shown = (obj.matrix_world @ bone.matrix).inverted_safe()
    return obj.matrix_world @ bone.bone.matrix_local @ shown @ mesh.matrix_world
