# SPDX-License-Identifier: MIT
"""A character that comes in as large as no person is told, and by what to scale it."""

from __future__ import annotations

import math
from pathlib import Path
from types import ModuleType

import bpy
import making
import pytest
from mathutils import Vector


def told_of(action: bpy.types.Action) -> list[str]:
    """What the Doctor says of an Action's character."""
    return [row.text for row in action.fragmotion.findings if row.code == "character_size"]


@pytest.mark.parametrize("scale", (100, 0.01))
def test_build_and_the_doctor_say_by_what_to_scale_it(addon: ModuleType, scale: float) -> None:
    obj = making.open_sample()
    walk = bpy.data.actions["walk forward"]
    for action in bpy.data.actions:
        action.fragmotion.use = action == walk
    obj.scale = (scale,) * 3
    obj.parent = bpy.data.objects.new("larger", None)
    for size, many in ((1, 1), (1, 1), (1 / scale, 0)):
        obj.parent.scale = (size,) * 3
        bpy.context.view_layer.update()
        said = addon.character.building.gather(bpy.context, obj, obj.fragmotion.build).warnings
        assert len([text for text in said if f"scale that to {1 / scale:.3g}, and Build" in text]) == many
        assert len(told_of(walk)) == many
        assert (addon.mocap.doctor.worst(walk) == "warning") == bool(many)


def test_import_onto_a_character_says_so(addon: ModuleType, tmp_path: Path) -> None:
    obj = making.open_sample()
    obj.animation_data.action = bpy.data.actions["walk forward"]
    bpy.ops.export_anim.bvh(filepath=str(tmp_path / "take.bvh"), frame_end=30, root_transform_only=True)
    for size, many in ((100, 1), (1, 0)):
        obj.scale = (size,) * 3
        bpy.context.view_layer.update()
        bpy.ops.fragmotion.import_mocap("EXEC_DEFAULT", directory=str(tmp_path), onto="ACTIVE")
        assert len(told_of(obj.animation_data.action)) == many


@pytest.mark.parametrize("scale", (0.7, 1.4))
def test_a_child_and_a_hero_are_no_odd_sizes(addon: ModuleType, scale: float) -> None:
    obj = making.open_sample()
    obj.scale = (scale,) * 3
    bpy.context.view_layer.update()
    assert addon.mocap.doctor.say_size(addon.rig.rigs.make_rig(obj).skeleton) == []


def test_build_says_that_feet_hover_and_mend_puts_them_down(addon: ModuleType) -> None:
    """As those of clips that were made for a body with longer legs."""
    obj = making.open_sample()
    walk = bpy.data.actions["walk forward"]
    for action in bpy.data.actions:
        action.fragmotion.use = action == walk
    curves = addon.compat.versions.curves_of(walk, obj)
    heights = [c for c in curves if c.data_path == 'pose.bones["hips"].location']
    up = obj.data.bones["hips"].matrix_local.to_3x3().inverted() @ Vector((0, 0, 0.04))
    gather = addon.character.building.gather
    for raised in (False, True):
        for curve in heights if raised else ():
            for key in curve.keyframe_points:
                key.co.y += up[curve.array_index]
            curve.update()
        said = [text for text in gather(bpy.context, obj, obj.fragmotion.build).warnings if "over the ground" in text]
        rows = [index for index, row in enumerate(walk.fragmotion.findings) if row.code == "ground"]
        assert len(said) == len(rows) == raised
    assert "'walk forward': the feet stand " in said[0]
    bpy.context.window_manager.fragmotion.active_action = bpy.data.actions.find(walk.name)
    assert bpy.ops.fragmotion.mend_finding(index=rows[0]) == {"FINISHED"}
    assert not [text for text in gather(bpy.context, obj, obj.fragmotion.build).warnings if "the ground" in text]


@pytest.mark.parametrize(("turn", "is_said"), ((0, False), (math.pi / 2, True), (-math.pi / 2, True), (math.pi, True)))
def test_build_says_that_the_body_lies(addon: ModuleType, turn: float, is_said: bool) -> None:
    obj = making.open_sample()
    for action in bpy.data.actions:
        action.fragmotion.use = action.name in ("stand", "walk forward")
    obj.rotation_mode, obj.rotation_euler = "XYZ", (turn, 0, 0)
    bpy.context.view_layer.update()
    said = addon.character.building.gather(bpy.context, obj, obj.fragmotion.build).warnings
    assert any("In none of the Actions the body stands" in each for each in said) == is_said


@pytest.mark.parametrize("times", (1, 100))
def test_build_says_that_the_body_goes_too_far_up_and_down(addon: ModuleType, times: int) -> None:
    """As where a scale was applied after the Actions were made."""
    obj = making.open_sample()
    for action in bpy.data.actions:
        action.fragmotion.use = action.name in ("stand", "walk forward")
        for curve in addon.compat.versions.curves_of(action, obj):
            if curve.data_path == 'pose.bones["hips"].location':
                for key in curve.keyframe_points:
                    key.co.y *= times
                curve.update()
    said = addon.character.building.gather(bpy.context, obj, obj.fragmotion.build).warnings
    told = [text for text in said if "times as far up and down" in text]
    assert len(told) == (times > 1)
    for text in told:
        assert "'hips'" in text
        assert times / 2 < float(text.split()[3]) < 2 * times, text
