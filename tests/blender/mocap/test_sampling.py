# SPDX-License-Identifier: MIT
"""An Action sampled as a clip equals the pose that Blender evaluates."""

from __future__ import annotations

from types import ModuleType

import bpy
import making
import numpy as np
import pytest

MODES = ("QUATERNION", "AXIS_ANGLE", "XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX")
FRAMES = 12


def check_sampling(addon: ModuleType, obj: bpy.types.Object, action: bpy.types.Action) -> None:
    """Compare heads and rotations of the whole body, in world space, in every frame."""
    bpy.context.view_layer.update()
    rig = addon.rig.rigs.make_rig(obj)
    bpy.context.scene.frame_set(7)
    clip = addon.mocap.sampling.sample(bpy.context, obj, action, rig)
    assert clip.root_positions.shape == (FRAMES, 3)
    heads, rotations = clip.world_transforms(rig.skeleton)
    body = making.body_bones(rig.skeleton)
    assert len(body) == len(obj.data.bones) - 1
    names = [rig.skeleton.names[index] for index in body]
    matrices = making.blender_poses(obj, action, range(1, FRAMES + 1), names)
    making.assert_same_poses(matrices, heads[:, body], rotations[:, body], 1e-4)
    assert np.ptp(heads, axis=0).max() > 0.1, "nothing moves, so nothing was compared"


def uses_poses(addon: ModuleType, obj: bpy.types.Object, action: bpy.types.Action) -> bool:
    """Whether sampling would step frame by frame."""
    curves = {(c.data_path, c.array_index): c for c in addon.compat.versions.curves_of(action, obj)}
    return bool(addon.rig.posing.is_needed(obj, curves))


@pytest.mark.parametrize("mode", MODES)
def test_every_rotation_mode(addon: ModuleType, mode: str) -> None:
    obj = making.add_armature()
    for bone in obj.pose.bones:
        bone.rotation_mode = mode
    action = making.add_action(obj, FRAMES)
    assert not uses_poses(addon, obj, action)
    check_sampling(addon, obj, action)


@pytest.mark.parametrize("flag", ["use_inherit_rotation", "use_local_location"])
def test_bones_that_do_not_inherit(addon: ModuleType, flag: str) -> None:
    obj = making.add_armature()
    for name in ("hips", "spine", "thigh.L", "foot.R"):
        setattr(obj.data.bones[name], flag, False)
    action = making.add_action(obj, FRAMES)
    assert not uses_poses(addon, obj, action)
    check_sampling(addon, obj, action)


def test_an_object_turned_moved_and_uniformly_scaled(addon: ModuleType) -> None:
    obj = making.add_armature()
    obj.location, obj.rotation_euler, obj.scale = (1, -2, 0.5), (0.4, -0.3, 2), (0.01, 0.01, 0.01)
    obj.scale = (1.7, 1.7, 1.7)
    action = making.add_action(obj, FRAMES)
    assert not uses_poses(addon, obj, action)
    check_sampling(addon, obj, action)


@pytest.mark.parametrize("mode", MODES[:3])
def test_an_object_that_its_own_keys_move(addon: ModuleType, mode: str) -> None:
    obj = making.add_armature()
    obj.scale = (2, 2, 2)
    obj.rotation_mode = mode
    action = making.add_action(obj, FRAMES)
    channel = {"QUATERNION": "rotation_quaternion", "AXIS_ANGLE": "rotation_axis_angle"}.get(mode, "rotation_euler")
    for frame, values in enumerate(making.waves(FRAMES, 7, 3), 1):
        obj.location = values[:3].tolist()
        setattr(obj, channel, values[3 : 3 + len(getattr(obj, channel))].tolist())
        obj.keyframe_insert("location", frame=frame)
        obj.keyframe_insert(channel, frame=frame)
    assert not uses_poses(addon, obj, action)
    check_sampling(addon, obj, action)


def test_connected_bones_ignore_their_location_keys(addon: ModuleType) -> None:
    obj = making.add_armature(connected=("shin.L", "head"))
    action = making.add_action(obj, FRAMES)
    for frame in (1, FRAMES):
        obj.pose.bones["shin.L"].location = (0.3, frame, 0)
        obj.pose.bones["shin.L"].keyframe_insert("location", frame=frame)
    check_sampling(addon, obj, action)


def test_sparse_keys_and_modifiers_are_evaluated(addon: ModuleType) -> None:
    obj = making.add_armature()
    action = making.add_action(obj, FRAMES)
    curves = addon.compat.versions.curves_of(action, obj)
    for curve in curves[::2]:
        for index in (7, 6, 4, 2):
            curve.keyframe_points.remove(curve.keyframe_points[index])
        curve.update()
    noisy = next(c for c in curves if "spine" in c.data_path)
    noisy.modifiers.new("NOISE")
    check_sampling(addon, obj, action)


def test_a_constraint_is_followed_and_everything_restored(addon: ModuleType) -> None:
    obj = making.add_armature()
    action = making.add_action(obj, FRAMES)
    other = making.add_action(obj, FRAMES, seed=40, name="other")
    constraint = obj.pose.bones["foot.L"].constraints.new("COPY_ROTATION")
    constraint.target, constraint.subtarget, constraint.influence = obj, "head", 0.7
    bpy.context.scene.frame_set(5, subframe=0.5)
    assert uses_poses(addon, obj, action)
    rig = addon.rig.rigs.make_rig(obj)
    before = making.contents()
    addon.mocap.sampling.sample(bpy.context, obj, action, rig)
    assert making.contents() == before
    assert obj.animation_data.action == other
    check_sampling(addon, obj, action)


def test_a_driver_is_followed(addon: ModuleType) -> None:
    obj = making.add_armature()
    action = making.add_action(obj, FRAMES)
    obj.pose.bones["head"].rotation_mode = "XYZ"
    obj.pose.bones["head"].rotation_euler = (0, 0, 0)
    obj.driver_add('pose.bones["head"].rotation_euler', 0).driver.expression = "frame * 0.1"
    assert uses_poses(addon, obj, action)
    check_sampling(addon, obj, action)


@pytest.mark.parametrize("scale", ["NONE", "ALIGNED"])
def test_scale_that_is_not_inherited(addon: ModuleType, scale: str) -> None:
    obj = making.add_armature()
    obj.data.bones["head"].inherit_scale = scale
    action = making.add_action(obj, FRAMES)
    assert uses_poses(addon, obj, action)
    check_sampling(addon, obj, action)


@pytest.mark.parametrize("scale", [1, 1.2])
def test_scale_that_is_keyed_matters_where_it_is_not_one(addon: ModuleType, scale: float) -> None:
    """Blender's FBX importer keys a scale of 1 in all bones."""
    obj = making.add_armature()
    action = making.add_action(obj, FRAMES)
    for bone in obj.pose.bones:
        for frame in (1, FRAMES):
            bone.scale = (scale if frame > 1 and bone.name == "spine" else 1,) * 3
            bone.keyframe_insert("scale", frame=frame)
    assert uses_poses(addon, obj, action) == (scale != 1)
    if scale == 1:
        check_sampling(addon, obj, action)


def test_channels_without_keys_rest_whatever_the_pose_is_now(addon: ModuleType) -> None:
    obj = making.add_armature()
    action = making.add_action(obj, FRAMES)
    curves = addon.compat.versions.holder_for(action, obj).fcurves
    for curve in [c for c in curves if "foot.L" in c.data_path]:
        curves.remove(curve)
    rig = addon.rig.rigs.make_rig(obj)
    obj.pose.bones["foot.L"].rotation_quaternion = (0.5, 0.5, 0.5, 0.5)
    clip = addon.mocap.sampling.sample(bpy.context, obj, action, rig)
    foot = rig.skeleton.names.index("foot.L")
    expected = np.tile(rig.skeleton.rest_rotations[foot], (FRAMES, 1))
    np.testing.assert_allclose(np.abs((clip.rotations[:, foot] * expected).sum(1)), 1, atol=1e-9)


def test_an_imported_take_is_sampled_at_its_own_rate(addon: ModuleType) -> None:
    bpy.context.scene.render.fps = 24
    obj = making.add_armature()
    action = making.add_action(obj, 25)
    action[addon.mocap.actions.RATE] = 60.0
    clip = addon.mocap.sampling.sample(bpy.context, obj, action, addon.rig.rigs.make_rig(obj))
    assert clip.rate == 60
    assert len(clip.root_positions) == 61  # 24 frames at 24 a second are one second


def test_a_manual_frame_range_limits_the_take(addon: ModuleType) -> None:
    obj = making.add_armature()
    action = making.add_action(obj, FRAMES)
    action.use_frame_range = True
    action.frame_start, action.frame_end = 3, 8
    rig = addon.rig.rigs.make_rig(obj)
    whole_range = addon.mocap.sampling.sample(bpy.context, obj, action, rig)
    action.use_frame_range = False
    whole = addon.mocap.sampling.sample(bpy.context, obj, action, rig)
    np.testing.assert_array_equal(whole_range.root_positions, whole.root_positions[2:8])


def test_an_action_whose_channels_are_all_muted_is_refused(addon: ModuleType) -> None:
    obj = making.add_armature()
    action = making.add_action(obj, FRAMES)
    for curve in addon.compat.versions.curves_of(action, obj):
        curve.mute = True
    with pytest.raises(addon.errors.UserError, match="all of its channels are muted"):
        addon.mocap.sampling.sample(bpy.context, obj, action, addon.rig.rigs.make_rig(obj))


def test_channels_of_a_muted_group_rest_or_play_as_in_blender(addon: ModuleType) -> None:
    obj = making.add_armature()
    action = making.add_action(obj, FRAMES)
    groups = addon.compat.versions.holder_for(action, obj).groups
    body, spine = groups.new("body"), groups.new("back")
    for curve in addon.compat.versions.curves_of(action, obj):
        curve.group = spine if "spine" in curve.data_path else body
    spine.mute = True
    action.update_tag()
    addon.rig.posing.reset_pose(obj)  # Blender leaves a muted channel as it stands
    check_sampling(addon, obj, action)
    body.mute = True
    action.update_tag()
    if addon.compat.versions.SLOTTED:
        check_sampling(addon, obj, action)
        return
    with pytest.raises(addon.errors.UserError, match="all of its channels are muted"):
        addon.mocap.sampling.sample(bpy.context, obj, action, addon.rig.rigs.make_rig(obj))


def test_an_action_lasts_as_long_as_the_scene_plays_it(addon: ModuleType) -> None:
    obj = making.add_armature()
    action = making.add_action(obj, FRAMES)
    bpy.context.scene.render.fps = 60
    clip = addon.mocap.sampling.sample(bpy.context, obj, action, addon.rig.rigs.make_rig(obj))
    assert clip.rate == 60 and len(clip.root_positions) == FRAMES


def linear_loop(addon: ModuleType, obj: bpy.types.Object, keys: np.ndarray) -> bpy.types.Action:
    """An Action that has these keys alone, in scene frames, and is the same at its end as at its beginning."""
    action = making.add_action(obj, FRAMES)
    for curve in addon.compat.versions.curves_of(action, obj):
        curve.keyframe_points.clear()
        curve.keyframe_points.add(len(keys))
        values = 1 + 0.1 * curve.array_index * np.sin(np.linspace(0, 2 * np.pi, len(keys)))
        curve.keyframe_points.foreach_set("co", np.column_stack((keys, values)).astype(np.float32).ravel())
        for point in curve.keyframe_points:
            point.interpolation = "LINEAR"
        curve.update()
    return action


@pytest.mark.parametrize("fps", (24, 25, 30, 60, 120))
def test_a_file_of_another_rate_is_sampled_at_its_keys(addon: ModuleType, fps: int) -> None:
    obj = making.add_armature()
    bpy.context.scene.render.fps = fps
    action = linear_loop(addon, obj, np.arange(25) * fps / 30)
    clip = addon.mocap.sampling.sample(bpy.context, obj, action, addon.rig.rigs.make_rig(obj))
    assert clip.rate == pytest.approx(30, rel=1e-5)
    assert len(clip.root_positions) == 25
    np.testing.assert_allclose(clip.root_positions[-1], clip.root_positions[0], atol=1e-6)
    np.testing.assert_allclose(np.abs((clip.rotations[-1] * clip.rotations[0]).sum(1)), 1, atol=1e-6)


@pytest.mark.parametrize("keys", ((0.0, 3.3, 8.0, 12.7), (0.0, 12.7), tuple(np.arange(128) / 10)))
def test_an_action_is_sampled_to_its_last_key(addon: ModuleType, keys: tuple[float, ...]) -> None:
    obj = making.add_armature()
    bpy.context.scene.render.fps = 24
    action = linear_loop(addon, obj, np.array(keys))
    clip = addon.mocap.sampling.sample(bpy.context, obj, action, addon.rig.rigs.make_rig(obj))
    times = addon.mocap.sampling.sample_times(bpy.context.scene, obj, action)
    assert len(times) == len(clip.root_positions) == 14
    assert times[0] == 0 and times[-1] == pytest.approx(12.7, abs=1e-5)
    assert clip.rate == pytest.approx(24 * 13 / 12.7, rel=1e-5)
