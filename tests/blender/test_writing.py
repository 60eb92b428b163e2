# SPDX-License-Identifier: MIT
"""Poses written to an Action come back the same."""

from __future__ import annotations

from types import ModuleType

import bpy
import making
import numpy as np
import pytest

FRAMES = 30


@pytest.mark.parametrize("mode", ["QUATERNION", "AXIS_ANGLE", "XYZ", "ZXY", "YZX"])
def test_written_poses_are_read_back(addon: ModuleType, mode: str) -> None:
    obj = making.add_armature()
    for bone in obj.pose.bones:
        bone.rotation_mode = mode
    source = making.add_action(obj, FRAMES)
    rig = addon.rig.rigs.make_rig(obj)
    clip = addon.mocap.sampling.sample(bpy.context, obj, source, rig)
    locations, rotations = rig.channels(clip.root_positions, clip.rotations)
    copy = bpy.data.actions.new("copy")
    moving = addon.rig.rigs.carriers(obj, rig)
    assert moving == ["root", "hips"]
    addon.rig.writing.write_poses(copy, obj, np.arange(1.0, FRAMES + 1), locations, rotations, moving)
    again = addon.mocap.sampling.sample(bpy.context, obj, copy, rig)
    body = making.body_bones(rig.skeleton)
    np.testing.assert_allclose(again.root_positions, clip.root_positions, atol=1e-5)
    np.testing.assert_allclose(again.rotations[:, body], clip.rotations[:, body], atol=1e-5)
    names = [rig.skeleton.names[index] for index in body]
    heads, turned = clip.world_transforms(rig.skeleton)
    matrices = making.blender_poses(obj, copy, (1, 2, FRAMES), names)
    making.assert_same_poses(matrices, heads[[0, 1, -1]][:, body], turned[[0, 1, -1]][:, body], 1e-4)


def test_keys_are_linear_whole_and_grouped_by_bone(addon: ModuleType) -> None:
    obj = making.add_armature()
    rig = addon.rig.rigs.make_rig(obj)
    action = bpy.data.actions.new("written")
    count = len(obj.data.bones)
    rest = np.tile([1.0, 0, 0, 0], (3, count, 1))
    for _ in range(2):  # the second time replaces the first
        addon.rig.writing.write_poses(action, obj, np.array([4.0, 5, 6]), np.zeros((3, count, 3)), rest, ["hips"])
    curves = addon.compat.versions.curves_of(action, obj)
    assert len(curves) == 4 * count + 3
    assert {curve.group.name for curve in curves} == {bone.name for bone in obj.data.bones}
    keys = [key for curve in curves for key in curve.keyframe_points]
    assert {key.interpolation for key in keys} == {"LINEAR"}
    assert sorted({key.co.x for key in keys}) == [4, 5, 6]
    assert rig.skeleton.roles["hips"] == "hips"


def test_euler_angles_stay_continuous_through_a_full_turn(addon: ModuleType) -> None:
    angles = np.linspace(0, 4 * np.pi, 100)
    turn = np.column_stack((np.cos(angles / 2), 0 * angles, 0 * angles, np.sin(angles / 2)))
    channel, eulers = addon.rig.keys.from_quaternions("XYZ", turn)
    assert channel == "rotation_euler"
    assert np.abs(np.diff(eulers, axis=0)).max() < 0.2
    assert eulers[-1, 2] - eulers[0, 2] == pytest.approx(4 * np.pi, abs=1e-6)
