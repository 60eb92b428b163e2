# SPDX-License-Identifier: MIT
"""A take is shown beside what was made of it."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import bpy
import making
import numpy as np
import pytest

NAME = "Source and Result"
WALK = making.MOCAP / "bandai-namco" / "dataset-1_walk_normal_001.bvh"


@pytest.fixture
def brought(addon: ModuleType) -> bpy.types.Object:
    """An armature with another body's Action on it, which it plays and which is chosen."""
    source = making.add_armature()
    source.name = "Actor"
    action = making.add_action(source)
    action.fragmotion.use = True
    for curve in addon.compat.versions.curves_of(action, source):
        if curve.data_path.endswith("location"):
            set_keys(curve, 0.0)
    longer = [(*bone[:2], *(tuple(1.2 * np.array(end)) for end in bone[2:])) for bone in making.BODY]
    obj = making.add_armature(longer, name="Hero")
    obj.fragmotion.source = source
    assert bpy.ops.fragmotion.retarget_actions("EXEC_DEFAULT") == {"FINISHED"}
    made = bpy.data.actions["take on Hero"]
    addon.compat.versions.assign(obj, made)
    choose(made)
    return obj


def set_keys(curve: bpy.types.FCurve, value: float) -> None:
    for key in curve.keyframe_points:
        key.co.y = value
    curve.update()


def choose(action: bpy.types.Action) -> None:
    bpy.context.window_manager.fragmotion.active_action = bpy.data.actions.find(action.name)


def halves() -> np.ndarray:
    """The image's colours [6,H,W,3] by figures, the take's and the result's in turn."""
    image: Any = bpy.data.images[NAME]
    width, height = image.size
    pixels = np.array(image.pixels[:]).reshape(height, 6, width // 6, 4)[..., :3]
    return pixels.transpose(1, 0, 2, 3)


def drawn(pixels: np.ndarray) -> np.ndarray:
    """Where a figure [H,W,3] is: grey is no part of it."""
    return np.ptp(pixels, axis=-1) > 0.05


def test_take_and_result_stand_side_by_side_in_three_poses(brought: bpy.types.Object) -> None:
    frame, action = bpy.context.scene.frame_current, brought.animation_data.action
    assert bpy.ops.fragmotion.compare_take() == {"FINISHED"}
    assert bpy.context.scene.frame_current == frame and brought.animation_data.action == action
    for figure, pixels in enumerate(halves()):
        shown = drawn(pixels)
        blue, red = pixels[shown][:, 2].mean(), pixels[shown][:, 0].mean()
        assert shown.sum() > 1000 and (blue > red) == (figure % 2 == 0)
    for take, result in zip(halves()[::2], halves()[1::2]):
        one, other = drawn(take), drawn(result)
        assert abs(np.argwhere(one)[:, 0].max() - np.argwhere(other)[:, 0].max()) < 30, "they are not as tall"


def test_a_limb_that_is_bent_otherwise_is_seen(addon: ModuleType, brought: bpy.types.Object) -> None:
    assert bpy.ops.fragmotion.compare_take() == {"FINISHED"}
    before = halves()
    action = brought.animation_data.action
    for curve in addon.compat.versions.curves_of(action, brought):
        if "upper_arm.L" in curve.data_path and curve.data_path.endswith("rotation_quaternion"):
            set_keys(curve, 0.5)
    assert bpy.ops.fragmotion.compare_take() == {"FINISHED"}
    after = halves()
    np.testing.assert_array_equal(after[::2], before[::2])
    assert all((drawn(a) != drawn(b)).sum() > 200 for a, b in zip(after[1::2], before[1::2]))
    assert [image.name for image in bpy.data.images].count(NAME) == 1


def test_the_meshes_of_the_character_are_drawn(brought: bpy.types.Object) -> None:
    assert bpy.ops.fragmotion.compare_take() == {"FINISHED"}
    bones = halves()
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.5)
    ball = bpy.context.object
    ball.parent, ball.parent_type, ball.parent_bone = brought, "BONE", "head"
    making.activate(brought)
    assert bpy.ops.fragmotion.compare_take() == {"FINISHED"}
    assert all(drawn(a).sum() > 2 * drawn(b).sum() for a, b in zip(halves()[1::2], bones[1::2]))


@pytest.mark.parametrize("kept", [[], [1.0] * 17, [float("nan")] * 36, "bones", 3])
def test_what_a_file_keeps_may_be_anything(brought: bpy.types.Object, kept: object) -> None:
    brought.animation_data.action["fragmotion_source"] = kept
    with pytest.raises(RuntimeError, match="poll"):
        bpy.ops.fragmotion.compare_take()


def test_a_take_of_ones_own_has_no_source(addon: ModuleType) -> None:
    obj = making.add_armature()
    choose(making.add_action(obj))
    assert not bpy.ops.fragmotion.compare_take.poll()


@pytest.mark.skipif(not WALK.exists(), reason="no motion capture beside the project")
def test_imported_takes_tell_of_what_they_were_made(addon: ModuleType) -> None:
    obj = making.add_armature()
    files = [{"name": WALK.name}]
    assert bpy.ops.fragmotion.import_mocap(directory=str(WALK.parent), files=files, onto="ACTIVE") == {"FINISHED"}
    choose(obj.animation_data.action)
    assert bpy.ops.fragmotion.compare_take() == {"FINISHED"}
    assert all(drawn(pixels).sum() > 1000 for pixels in halves())
