# SPDX-License-Identifier: MIT
"""The sample character: from an empty file to one that can be driven."""

from __future__ import annotations

from itertools import combinations
from types import ModuleType

import bpy
import numpy as np
import pytest
from mathutils import Vector


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


def test_a_slope_and_stairs_come_with_it_out_of_the_way(addon: ModuleType) -> None:
    assert bpy.ops.fragmotion.add_sample() == {"FINISHED"}
    obj = bpy.context.active_object
    (layer,) = (each for each in bpy.context.view_layer.layer_collection.children if each.name == "Sample Grounds")
    ground = obj.fragmotion.ground
    assert layer.exclude and ground.kind == "PLANE" and ground.collection == layer.collection
    assert {thing.name for thing in bpy.context.view_layer.objects} == {"Fragmotion Sample", "Fragmotion Sample Body"}
    ground.kind = "COLLECTION"
    find_ground = addon.ground.meshes.find_ground
    with pytest.raises(addon.errors.UserError, match="'Sample Grounds' holds no mesh that is visible: tick it"):
        find_ground(bpy.context, obj)
    layer.exclude = False
    bpy.context.view_layer.update()
    found = find_ground(bpy.context, obj)
    height, *normal = found(3.0, -10.0, 5.0)
    assert height == pytest.approx(2 * 0.36397, abs=1e-4) and normal[2] == pytest.approx(0.9397, abs=1e-3)
    assert found(0.0, 0.0, 5.0)[0] == pytest.approx(0, abs=1e-5), "no level ground before the slope"
    assert bpy.ops.fragmotion.add_sample() == {"FINISHED"}
    assert bpy.context.active_object.fragmotion.ground.collection == layer.collection, "there are two of it"
    assert len(bpy.data.collections) == 1


def test_it_can_be_added_twice(addon: ModuleType) -> None:
    for _ in range(2):
        assert bpy.ops.fragmotion.add_sample() == {"FINISHED"}
    armatures = [thing for thing in bpy.data.objects if thing.type == "ARMATURE"]
    assert len(armatures) == 2 and bpy.context.active_object in armatures


def in_the_way(context: bpy.types.Context) -> list[set[str]]:
    """Pairs of objects whose boxes meet above the ground."""
    context.view_layer.update()
    corners = {
        thing.name: np.array([thing.matrix_world @ Vector(corner) for corner in thing.bound_box])
        for thing in context.visible_objects
        if thing.type in {"MESH", "ARMATURE"} and thing.dimensions.z > 0.1
    }
    return [
        {one, other}
        for one, other in combinations(corners, 2)
        if (corners[one].min(0) < corners[other].max(0)).all() and (corners[other].min(0) < corners[one].max(0)).all()
    ]


def test_it_stands_beside_what_is_there(addon: ModuleType) -> None:
    context = bpy.context
    bpy.ops.mesh.primitive_cube_add(size=2)
    bpy.ops.mesh.primitive_cube_add(size=2, location=(2.4, 0, 1))
    bpy.ops.mesh.primitive_plane_add(size=100)
    bpy.ops.object.light_add()
    assert bpy.ops.fragmotion.add_sample() == {"FINISHED"}
    own = {"Fragmotion Sample", "Fragmotion Sample Body"}
    assert in_the_way(context) == [own]
    body = context.active_object
    assert body.location.x == pytest.approx(5.15, abs=0.05) and tuple(body.location)[1:] == (0, 0)
    assert bpy.ops.fragmotion.add_sample() == {"FINISHED"}
    assert [own, {f"{name}.001" for name in own}] == sorted(in_the_way(context), key=lambda pair: sorted(pair))


def test_it_stands_at_the_origin_where_nothing_is_in_its_way(addon: ModuleType) -> None:
    bpy.ops.mesh.primitive_plane_add(size=100)
    bpy.ops.mesh.primitive_cube_add(size=2, location=(0, 9, 0))
    bpy.ops.mesh.primitive_cube_add(size=2)
    bpy.context.active_object.hide_set(True)
    assert bpy.ops.fragmotion.add_sample() == {"FINISHED"}
    assert tuple(bpy.context.active_object.location) == (0, 0, 0)


def test_nothing_is_amiss_on_the_console(addon: ModuleType, capfd: pytest.CaptureFixture[str]) -> None:
    assert bpy.ops.fragmotion.add_sample() == {"FINISHED"}
    said = capfd.readouterr()
    assert "matches no enum" not in said.out + said.err
