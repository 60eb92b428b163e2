# SPDX-License-Identifier: MIT
"""Fewer keys, a loop and markers are of the same motion."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import bpy
import numpy as np
import pytest
from baked import FIRST, Oracle, about_z, bake_recording, play, seen_at


@pytest.mark.thorough
@pytest.mark.parametrize("root", ["BONE", "OBJECT"])
@pytest.mark.parametrize("modes", [("QUATERNION",), ("XYZ", "AXIS_ANGLE", "ZYX", "QUATERNION")])
def test_reduced_keys_keep_every_bone_within_the_bound_on_every_frame(
    addon: ModuleType, obj: bpy.types.Object, recording: Any, root: str, modes: tuple[str, ...]
) -> None:
    for index, bone in enumerate(obj.pose.bones):
        bone.rotation_mode = modes[index % len(modes)]
    names = obj.pose.bones.keys()
    bake_recording(root=root, action="all")
    expected = seen_at(obj, range(FIRST, FIRST + 121), names)
    every = count_keys(addon, obj)
    counts = []
    for distance, angle in ((0.02, 3.0), (0.005, 0.5)):
        bake_recording(root=root, action="few", reduce=True, reduce_distance=distance, reduce_angle=np.radians(angle))
        heads, turned = seen_at(obj, range(FIRST, FIRST + 121), names)
        assert np.linalg.norm(heads - expected[0], axis=-1).max() <= distance + 2e-6
        chord = np.linalg.norm(turned - expected[1], axis=(-2, -1))
        assert np.degrees(2 * np.arcsin(chord / np.sqrt(8))).max() <= angle + 1e-3
        counts.append(count_keys(addon, obj))
    assert counts[0] < 0.5 * every and counts[0] < counts[1] < every
    print(f"\n{root} {modes}: {every} keys, {counts[0]} within 20 mm and 3 degrees, {counts[1]} within 5 mm and 0.5")


def count_keys(addon: ModuleType, obj: bpy.types.Object) -> int:
    action = obj.animation_data.action
    return sum(len(curve.keyframe_points) for curve in addon.compat.versions.curves_of(action, obj))


@pytest.mark.parametrize("root", ["BONE", "IN_PLACE"])
def test_a_loop_ends_as_it_began(addon: ModuleType, obj: bpy.types.Object, recording: Any, root: str) -> None:
    names = play(addon, obj, np.zeros((10, 4))).names
    bake_recording(root=root, action="once")
    once = seen_from_itself(obj, names, root)
    bake_recording(root=root, action="round", loop=True, loop_seconds=0.5)
    heads, turned, path = seen_from_itself(obj, names, root)
    np.testing.assert_allclose(heads[:-15], once[0][:-15], atol=1e-4, err_msg="it began to turn too early")
    assert np.abs(once[0][-1] - once[0][0]).max() > 0.05, "the recording ends as it began by itself"
    np.testing.assert_allclose(heads[-1], heads[0], atol=1e-4)
    np.testing.assert_allclose(turned[-1], turned[0], atol=1e-4)
    steps = np.diff(heads, axis=0)  # the bones turn as fast, so that their heads, on circles, move nearly as fast
    np.testing.assert_allclose(steps[-1], steps[0], atol=0.2 * np.abs(steps[0]).max())
    np.testing.assert_allclose(path[-1], path[0], atol=1e-4)
    fastest = np.abs(np.diff(once[0], axis=0)).max()
    assert np.abs(np.diff(heads, axis=0)).max() < 1.5 * fastest, "the end jerks"


def seen_from_itself(obj: bpy.types.Object, names: list[str], root: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Heads [F,B,3] and rotations seen from the root bone's heading and place, and the root's steps [F-1,2] from there;
    in place, as the world sees them."""
    heads, turned = seen_at(obj, range(FIRST, FIRST + 121), names)
    if root == "IN_PLACE":
        return heads, turned, np.diff(heads[:, 0, :2], axis=0)
    frames = np.array([character_frame(obj, frame) for frame in range(FIRST, FIRST + 121)])
    back = about_z(-frames[:, 2])
    ground = np.column_stack((frames[:, :2], np.zeros(len(frames))))
    steps = np.einsum("fij,fj->fi", back[:-1], np.diff(ground, axis=0))[:, :2]
    return np.einsum("fij,fbj->fbi", back, heads - ground[:, None]), np.einsum("fij,fbjk->fbik", back, turned), steps


def character_frame(obj: bpy.types.Object, frame: int) -> tuple[float, float, float]:
    """Under the hips, along the line between the thighs."""
    bpy.context.scene.frame_set(frame)
    posed = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    hips, left, right = (
        np.array(posed.matrix_world @ posed.pose.bones[name].head) for name in ("hips", "thigh.L", "thigh.R")
    )
    return hips[0], hips[1], np.arctan2(right[1] - left[1], right[0] - left[0])


def changes_of_class(oracle: Oracle, names: list[str]) -> list[tuple[int, str]]:
    classes = oracle.performance.classes
    return [(FIRST + i, names[c]) for i, c in enumerate(classes) if i == 0 or classes[i - 1] != c]


def test_markers_stand_where_the_class_changes(
    addon: ModuleType, obj: bpy.types.Object, trace: np.ndarray, recording: Any
) -> None:
    oracle = play(addon, obj, trace)
    obj.fragmotion.classes[oracle.performance.classes[60]].name = "my own wave"
    expected = changes_of_class(oracle, [row.name for row in obj.fragmotion.classes])
    assert len(expected) > 5 and "my own wave" in dict(expected).values()
    scene = bpy.context.scene
    bake_recording(action="none")
    assert not scene.timeline_markers and not obj.animation_data.action.pose_markers
    bake_recording(action="scene", markers="SCENE")
    assert sorted((m.frame, m.name) for m in scene.timeline_markers) == expected
    for _ in range(2):
        bake_recording(action="action", markers="ACTION")
        markers = bpy.data.actions["action"].pose_markers
        assert sorted((m.frame, m.name) for m in markers) == expected
    assert len(scene.timeline_markers) == len(expected)
