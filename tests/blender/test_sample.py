# SPDX-License-Identifier: MIT
"""The sample character: from an empty file to one that can be driven."""

from __future__ import annotations

from types import ModuleType

import bpy
import pytest


def test_it_is_added_ticked_and_builds_as_in_its_own_file(addon: ModuleType, obj: bpy.types.Object) -> None:
    fragments = obj.fragmotion.figures.fragments
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.context.scene.render.fps = 24  # its takes have 30
    assert bpy.ops.fragmotion.add_sample() == {"FINISHED"}
    added = bpy.context.active_object
    assert added.type == "ARMATURE" and bpy.context.selected_objects == [added]
    actions = addon.mocap.actions.fitting(added)
    moves = [row.action for row in added.fragmotion.moves]
    assert [(row.name, row.key, row.upper_body, row.loop) for row in added.fragmotion.moves] == [
        ("wave", "F", True, False),
        ("kick", "G", False, False),
        ("sit", "H", False, True),
    ]
    idle = {action for action in actions if action.fragmotion.style} | set(moves)
    assert len(actions) > 30 and {action for action in actions if not action.fragmotion.use} == idle
    assert {action.fragmotion.style for action in actions} == {"", "proud", "tired"}
    assert {thing.type for thing in bpy.data.objects} == {"ARMATURE", "MESH"}
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    assert added.fragmotion.figures.fragments == fragments > 100
    addon.character.moves.bring_up_to_date(bpy.context, added)
    sit = addon.character.building.load(added).moves[2]
    assert sit.name == "sit" and sit.loop == pytest.approx((1.5, 2.3), abs=0.02)


def test_it_can_be_added_twice(addon: ModuleType) -> None:
    for _ in range(2):
        assert bpy.ops.fragmotion.add_sample() == {"FINISHED"}
    armatures = [thing for thing in bpy.data.objects if thing.type == "ARMATURE"]
    assert len(armatures) == 2 and bpy.context.active_object in armatures
