# SPDX-License-Identifier: GPL-3.0-or-later
"""Armature objects that are made beside a rig."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import NamedTuple

import bpy
from mathutils import Vector

from ..made import mark
from ..rig.selection import select


class RestBone(NamedTuple):
    """A bone to be made: `up` is where its z axis points, `parent` a bone before it, or empty."""

    name: str
    parent: str
    head: Vector
    tail: Vector
    up: Vector


@contextmanager
def out_of_modes(context: bpy.types.Context) -> Iterator[None]:
    """Object Mode with nothing selected; afterwards selection, active object and mode are as they were."""
    active, selected = context.view_layer.objects.active, context.selected_objects
    mode = active.mode if active is not None else "OBJECT"
    in_mode = [obj for obj in context.view_layer.objects if obj.mode == mode != "OBJECT"]
    if mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    select(context, [], None)
    try:
        yield
    finally:
        if in_mode:
            select(context, in_mode, active)
            bpy.ops.object.mode_set(mode=mode)
        select(context, selected, active)


def make_armature(
    context: bpy.types.Context,
    name: str,
    collection: bpy.types.Collection,
    beside: bpy.types.Object,
    bones: Iterable[RestBone],
) -> bpy.types.Object:
    """An armature of these bones where another object is, in the collection; inside `out_of_modes`."""
    obj = bpy.data.objects.new(name, bpy.data.armatures.new(name))
    for made in (obj, obj.data):
        mark(made)
    collection.objects.link(obj)
    obj.matrix_world = beside.matrix_world
    context.view_layer.objects.active = obj
    bpy.ops.object.mode_set(mode="EDIT")
    try:
        for bone in bones:
            made = obj.data.edit_bones.new(bone.name)
            made.head, made.tail = bone.head, bone.tail
            made.align_roll(bone.up)
            made.parent = obj.data.edit_bones[bone.parent] if bone.parent else None
    finally:
        bpy.ops.object.mode_set(mode="OBJECT")
    return obj
