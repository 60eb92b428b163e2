# SPDX-License-Identifier: MIT
"""A bone that no Action keys is learned, driven and baked as it is posed, for so Blender shows it."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import driving
import making
import numpy as np
import pytest
from mathutils import Quaternion

TAKES = ("walk forward", "run forward", "stand")
PLACED, TURNED = (0.3, 0.5, 0.2), Quaternion((0.8, 0.0, 0.6, 0.0))  # the bone points up


@pytest.fixture
def carried(addon: ModuleType) -> bpy.types.Object:
    """The sample on a bone that none of its Actions keys, posed half a metre up and turned to the side; its head is
    held to the left."""
    obj = making.open_sample()
    obj.fragmotion.moves.clear()
    for action in bpy.data.actions:
        action.fragmotion.use = action.name in TAKES
        for curve in addon.compat.versions.curves_of(action, obj):
            if '"head"' in curve.data_path:
                curve.data_path = curve.data_path.replace('"head"', '"nobody"')
    with making.editing(obj) as bones:
        bones.new("carrier").tail = (0, 0, 0.2)
        bones["root"].parent = bones["carrier"]
    pose(obj)
    return obj


def pose(obj: bpy.types.Object) -> None:
    bone = obj.pose.bones["carrier"]
    bone.rotation_mode, bone.location, bone.rotation_euler = "ZYX", PLACED, TURNED.to_euler("ZYX")
    obj.pose.bones["head"].rotation_quaternion = Quaternion((0, 0, 1), 0.4)
    bpy.context.view_layer.update()


def shown(addon: ModuleType, obj: bpy.types.Object, action: bpy.types.Action) -> tuple[list[str], np.ndarray]:
    """The body's bones, and their heads [F,B,3] and rotations as the scene shows them in an Action, nothing reset."""
    addon.compat.versions.assign(obj, action)
    pose(obj)
    names = making.body_bones(addon.rig.rigs.make_rig(obj).skeleton)
    order = [addon.rig.rigs.make_rig(obj).skeleton.names[bone] for bone in names]
    frames = range(int(action.frame_range[0]), int(action.frame_range[1]) + 1)
    return order, matrices(obj, frames, order)


def matrices(obj: bpy.types.Object, frames: Any, names: list[str]) -> np.ndarray:
    seen = []
    for frame in frames:
        bpy.context.scene.frame_set(frame)
        posed = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
        seen.append([np.array(posed.matrix_world @ posed.pose.bones[name].matrix) for name in names])
    return np.array(seen)


def learned(addon: ModuleType, obj: bpy.types.Object, action: bpy.types.Action, names: list[str]) -> np.ndarray:
    rig = addon.mocap.sampling.rig_as_posed(obj)
    clip = addon.mocap.sampling.sample(bpy.context, obj, action, rig)
    heads, rotations = clip.world_transforms(rig.skeleton)
    order = [rig.skeleton.names.index(name) for name in names]
    placed = np.tile(np.eye(4), (*heads[:, order].shape[:2], 1, 1))
    placed[..., :3, 3], placed[..., :3, :3] = heads[:, order], making.to_matrices(rotations[:, order])
    return placed


@pytest.mark.parametrize("by", ["keys", "depsgraph"])
def test_it_is_learned_as_blender_shows_it(addon: ModuleType, carried: bpy.types.Object, by: str) -> None:
    if by == "depsgraph":
        carried.pose.bones["carrier"].constraints.new("LIMIT_SCALE")
    action = bpy.data.actions["walk forward"]
    bpy.context.scene.render.fps = 60
    names, seen = shown(addon, carried, action)
    found = learned(addon, carried, action, names)
    step = (len(found) - 1) / (len(seen) - 1)
    assert step == 1
    np.testing.assert_allclose(found, seen, atol=2e-5)


@pytest.mark.parametrize("by", ["pose", "keys"])
def test_a_bone_that_makes_the_whole_body_larger(addon: ModuleType, carried: bpy.types.Object, by: str) -> None:
    action, bone = bpy.data.actions["walk forward"], carried.pose.bones["carrier"]
    bpy.context.scene.render.fps, bone.scale = 60, (3, 3, 3)
    if by == "keys":
        addon.compat.versions.assign(carried, action)
        bone.keyframe_insert("scale", frame=1)
    names, seen = shown(addon, carried, action)
    found = learned(addon, carried, action, names)
    assert addon.rig.rigs.sizes_of(carried) == pytest.approx({"carrier": 3})
    np.testing.assert_allclose(np.linalg.norm(seen[..., :3, :3], axis=-2), 3, atol=1e-5)
    seen[..., :3, :3] /= 3
    np.testing.assert_allclose(found, seen, atol=6e-5)


def test_a_larger_body_is_built_and_baked_as_large(
    addon: ModuleType, carried: bpy.types.Object, capfd: pytest.CaptureFixture[str]
) -> None:
    carried.pose.bones["carrier"].scale = (3, 3, 3)
    skeleton = addon.rig.rigs.make_rig(carried).skeleton
    build(carried)
    assert "the scale of" not in capfd.readouterr().out
    assert carried.fragmotion.figures.stature == pytest.approx(3 * skeleton.stature, rel=1e-3)
    assert bpy.ops.fragmotion.bake("EXEC_DEFAULT", trace_source="PLAYER", seconds=4) == {"FINISHED"}
    assert tuple(carried.pose.bones["carrier"].scale) == pytest.approx((3, 3, 3))
    baked, names = carried.animation_data.action, making.body_bones(skeleton)
    order = [skeleton.names[bone] for bone in names]
    heads, hips = matrices(carried, (20, 60, 90), order)[..., :3, 3], order.index(skeleton.roles["hips"])
    seen = np.linalg.norm(heads - heads[:, hips : hips + 1], axis=2).max()
    at_rest = np.linalg.norm(skeleton.offsets[1:], axis=1).sum()
    assert baked.fragmotion is not None and 0.6 * 3 < seen < at_rest * 3
    feet = heads[:, [order.index(skeleton.roles[foot]) for foot in ("left_foot", "right_foot")], 2]
    assert np.ptp(feet.min(axis=1)) < 0.1 * 3 * skeleton.stature


def test_a_scale_that_is_not_the_same_in_all_actions_is_left_out(addon: ModuleType, carried: bpy.types.Object) -> None:
    bone = carried.pose.bones["carrier"]
    for name, scale in (("walk forward", 3.0), ("run forward", 2.0)):
        addon.compat.versions.assign(carried, bpy.data.actions[name])
        bone.scale = (scale,) * 3
        bone.keyframe_insert("scale", frame=1)
    addon.mocap.sampling.rig_as_posed(carried)
    assert addon.rig.rigs.sizes_of(carried) == {}
    (told,) = addon.rig.scaled.say_scaled(carried, list(bpy.data.actions))
    assert "the scale of bone 'carrier', up to 3 times" in told


def test_what_an_action_of_another_armature_keys_is_held(addon: ModuleType, carried: bpy.types.Object) -> None:
    other = carried.copy()
    bpy.context.scene.collection.objects.link(other)
    other.animation_data.action = bpy.data.actions["stand"].copy()
    other.pose.bones["carrier"].keyframe_insert("location", frame=1)
    for each in (other, carried):
        addon.compat.versions.assign(each, None if each == carried else other.animation_data.action)
    addon.mocap.sampling.rig_as_posed(carried)
    assert addon.rig.rigs.held_of(carried)["carrier"][:3] == pytest.approx(PLACED)
    addon.compat.versions.assign(other, None)
    del carried[addon.rig.rigs.HELD]
    addon.mocap.sampling.rig_as_posed(carried)
    assert addon.rig.rigs.held_of(carried)["carrier"][:3] == [0, 0, 0], "it may be this one's"


def test_what_is_keyed_may_be_posed_as_it_likes(addon: ModuleType, carried: bpy.types.Object) -> None:
    action = bpy.data.actions["walk forward"]
    names, _ = shown(addon, carried, action)
    before = learned(addon, carried, action, names)
    bpy.context.scene.frame_set(17)
    carried.pose.bones["hips"].location = (1, 2, 3)
    carried.pose.bones["thigh.L"].rotation_quaternion = (0, 1, 0, 0)
    assert list(addon.rig.rigs.held_of(carried)) == ["carrier", "head"]
    np.testing.assert_array_equal(learned(addon, carried, action, names), before)


def test_a_bone_that_one_action_keys_is_in_others_as_before_that(addon: ModuleType, carried: bpy.types.Object) -> None:
    action = bpy.data.actions["run forward"]
    names, _ = shown(addon, carried, action)
    before = learned(addon, carried, action, names)
    addon.compat.versions.assign(carried, bpy.data.actions["walk forward"])
    bone = carried.pose.bones["carrier"]
    for bone.location.z, frame in ((0.0, 1), (9.0, 5)):
        bone.keyframe_insert("location", frame=frame)
    bone.rotation_euler = (0, 0, 0)
    bpy.context.scene.frame_set(5)
    rows = addon.rig.rigs.held_of(carried)
    learned(addon, carried, action, names)
    assert addon.rig.rigs.held_of(carried)["carrier"] == [*rows["carrier"][:3], 1, 0, 0, 0], "it turns as posed now"
    pose(carried)
    np.testing.assert_array_equal(learned(addon, carried, action, names), before)


def test_build_gives_the_same_after_a_drive_and_a_bake(
    addon: ModuleType, carried: bpy.types.Object, session: ModuleType
) -> None:
    build(carried)
    first, character = carried.fragmotion.digest, addon.character.building.load(carried)
    poses = addon.rig.posing.pose_of(carried)
    driven = driving.start(session, carried)
    assert driving.hips(carried)[2] > 0
    driving.go_on(driven, 1.0)
    session.stop()
    after = addon.rig.posing.pose_of(carried)
    for channel in addon.rig.posing.CHANNELS:
        np.testing.assert_array_equal(after.bones[channel], poses.bones[channel])
    build(carried)
    assert carried.fragmotion.digest == first
    assert bpy.ops.fragmotion.bake("EXEC_DEFAULT", trace_source="PLAYER", seconds=4) == {"FINISHED"}
    bpy.context.scene.frame_set(60)
    build(carried)
    assert carried.fragmotion.digest == first
    assert list(addon.rig.rigs.held_of(carried)) == ["carrier", "head"]
    assert "alks" in carried.fragmotion.figures.abilities
    assert character.skeleton.names[0] == "carrier"


def test_a_character_is_marked_where_another_pose_was_read(addon: ModuleType, carried: bpy.types.Object) -> None:
    build(carried)
    carried.pose.bones["hips"].location.z += 1
    addon.mocap.sampling.rig_as_posed(carried)
    assert not addon.character.staleness.is_stale(carried)
    carried.pose.bones["carrier"].location.z += 1
    addon.mocap.sampling.rig_as_posed(carried)
    assert addon.character.staleness.is_stale(carried)
    build(carried)
    assert not addon.character.staleness.is_stale(carried)


def test_undo_gives_the_pose_back_that_is_held(addon: ModuleType, carried: bpy.types.Object) -> None:
    name = carried.name
    build(carried)
    first = carried.fragmotion.digest
    bpy.ops.ed.undo_push(message="built")
    carried.pose.bones["carrier"].location.z += 1
    build(carried)
    assert carried.fragmotion.digest != first
    bpy.ops.ed.undo_push(message="built again")
    bpy.ops.ed.undo()
    again = bpy.data.objects[name]
    assert addon.rig.rigs.held_of(again)["carrier"][:3] == pytest.approx(PLACED)
    build(again)
    assert again.fragmotion.digest == first


def test_what_a_driver_moves_is_not_held(addon: ModuleType, carried: bpy.types.Object) -> None:
    carried.pose.bones["carrier"].driver_add("location", 2).driver.expression = "0.7 + frame"
    addon.mocap.sampling.rig_as_posed(carried)
    assert addon.rig.rigs.held_of(carried)["carrier"][:3] == [0, 0, 0]


def test_a_rig_in_a_file_stands_as_it_is_posed(addon: ModuleType, carried: bpy.types.Object, tmp_path: Path) -> None:
    path = tmp_path / "carried.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    skeleton, _ = import_module(f"{addon.__name__}.mocap.alone").read_rig(path, carried.name)
    assert skeleton.names[0] == "carrier"
    np.testing.assert_allclose(skeleton.offsets[0], (PLACED[0], -PLACED[2], PLACED[1]), atol=1e-6)


def test_a_retarget_of_it_leaves_the_others_as_they_were(addon: ModuleType, carried: bpy.types.Object) -> None:
    action = bpy.data.actions["run forward"]
    names, _ = shown(addon, carried, action)
    before = learned(addon, carried, action, names)
    rows = addon.rig.rigs.held_of(carried)
    del carried[addon.rig.rigs.HELD]
    walk = [bpy.data.actions["walk forward"]]
    for _ in addon.mocap.retargeting.retarget_actions(bpy.context, carried, carried, walk):
        pass
    made = next(each for each in bpy.data.actions if " on " in each.name)
    keyed = addon.mocap.actions.animated_bones(made, carried)
    assert {"carrier", "head"} <= keyed
    assert addon.rig.rigs.held_of(carried) == rows
    np.testing.assert_array_equal(learned(addon, carried, action, names), before)


def test_a_policy_is_of_the_armature_as_it_is_posed(
    addon: ModuleType, carried: bpy.types.Object, tmp_path: Path
) -> None:
    insert_middle(carried)
    build(carried)
    addon.character.building.save_policy(carried, tmp_path / "carried.policy")
    del carried[addon.rig.rigs.HELD]
    addon.character.building.load_policy(bpy.context, carried, tmp_path / "carried.policy")
    assert list(addon.rig.rigs.held_of(carried)) == ["carrier", "middle", "head"]


def insert_middle(obj: bpy.types.Object) -> None:
    """A posed bone between root and hips, of which a bake keys its turn alone."""
    with making.editing(obj) as bones:
        middle = bones.new("middle")
        middle.head, middle.tail = bones["hips"].head, bones["hips"].tail
        middle.parent, bones["hips"].parent = bones["root"], middle
    obj.pose.bones["middle"].location = (0.1, 0.2, -0.1)
    obj.pose.bones["middle"].rotation_quaternion = (0.8, 0, 0, 0.6)


def build(obj: bpy.types.Object) -> None:
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=20, seconds=5) == {"FINISHED"}


def test_a_bake_shows_what_was_played(addon: ModuleType, carried: bpy.types.Object) -> None:
    insert_middle(carried)
    build(carried)
    assert list(addon.rig.rigs.held_of(carried)) == ["carrier", "middle", "head"]
    character, core = addon.character.building.load(carried), addon.compat.core.core
    trace = np.tile((0, character.space.speeds[0], 0, 0), (40, 1))
    played = core.Player(character, 3).run(trace, 24)
    rig = addon.rig.rigs.make_rig(carried)
    locations, rotations = rig.channels(played.root_positions, played.rotations)
    action = bpy.data.actions.new("Baked")
    moving = addon.rig.rigs.carriers(carried, rig)
    addon.rig.writing.write_poses(action, carried, np.arange(len(locations)), locations, rotations, moving)
    addon.rig.posing.reset_pose(carried)
    addon.compat.versions.assign(carried, action)
    clip = core.Clip(character.skeleton, "played", 24, played.root_positions, played.rotations)
    heads, _ = clip.world_transforms(character.skeleton)
    body = making.body_bones(character.skeleton)
    seen = matrices(carried, range(0, len(locations), 9), [character.skeleton.names[bone] for bone in body])
    np.testing.assert_allclose(seen[..., :3, 3], heads[::9, body], atol=1e-3)
