# SPDX-License-Identifier: MIT
"""The sample character: from an empty file to one that can be driven."""

from __future__ import annotations

from types import ModuleType

import bpy


def test_it_is_added_ticked_and_builds_as_in_its_own_file(addon: ModuleType, obj: bpy.types.Object) -> None:
    fragments = obj.fragmotion.figures.fragments
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.context.scene.render.fps = 24  # its takes have 30
    assert bpy.ops.fragmotion.add_sample() == {"FINISHED"}
    added = bpy.context.active_object
    assert added.type == "ARMATURE" and bpy.context.selected_objects == [added]
    actions = addon.mocap.actions.fitting(added)
    assert len(actions) > 30 and all(action.fragmotion.use for action in actions)
    assert {thing.type for thing in bpy.data.objects} == {"ARMATURE", "MESH"}
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    assert added.fragmotion.figures.fragments == fragments > 100


def test_it_can_be_added_twice(addon: ModuleType) -> None:
    for _ in range(2):
        assert bpy.ops.fragmotion.add_sample() == {"FINISHED"}
    armatures = [thing for thing in bpy.data.objects if thing.type == "ARMATURE"]
    assert len(armatures) == 2 and bpy.context.active_object in armatures
