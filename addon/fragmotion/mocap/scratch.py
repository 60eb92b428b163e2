# SPDX-License-Identifier: GPL-3.0-or-later
"""A place to import into that leaves nothing behind."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import bpy

from ..compat import versions
from ..rig.posing import pose_of, set_pose

# Blender's own, what goes with its owner, and all at once.
_NOT_REMOVED = {"screens", "window_managers", "workspaces", "shape_keys", "all_ids"}


@contextmanager
def scratch_scene(context: bpy.types.Context) -> Iterator[None]:
    """A new scene in the window, for importers that change selection, mode, frames and rate of the scene they meet.
    Afterwards the window shows what it showed, also poses without keys."""
    versions.own_by_shown_scene()
    window = context.window or context.window_manager.windows[0]
    scene, view_layer = window.scene, window.view_layer
    poses = {obj: pose_of(obj) for obj in scene.objects if obj.pose and obj.animation_data}
    scratch = bpy.data.scenes.new("Import")
    window.scene = scratch
    try:
        yield
    finally:
        window.scene = scene
        window.view_layer = view_layer
        bpy.data.scenes.remove(scratch)
        context.view_layer.update()
        for obj, pose in poses.items():
            set_pose(obj, pose)


@contextmanager
def nothing_left() -> Iterator[None]:
    """Every data-block made inside is gone afterwards."""
    known = _data_blocks()
    try:
        yield
    finally:
        bpy.data.batch_remove(_data_blocks() - known)


def _data_blocks() -> set[bpy.types.ID]:
    kinds = [kind.identifier for kind in bpy.data.bl_rna.properties if kind.type == "COLLECTION"]
    return {block for kind in kinds if kind not in _NOT_REMOVED for block in getattr(bpy.data, kind)}
