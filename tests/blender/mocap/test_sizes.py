# SPDX-License-Identifier: MIT
"""A character that comes in as large as no person is told, and by what to scale it."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import bpy
import making
import pytest


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
