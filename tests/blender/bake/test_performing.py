# SPDX-License-Identifier: MIT
"""Every bake shows, frame by frame in Blender's evaluation, what the core's player plays."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import bpy
import making
import numpy as np
import pytest
from baked import FIRST, RATE, SEED, assert_seen, bake_recording, on_a_treadmill, play, seen_at


@pytest.mark.parametrize("root", ["BONE", "OBJECT", "IN_PLACE"])
@pytest.mark.parametrize("target", ["NEW", "NLA"])
def test_a_recording_is_shown_as_the_player_plays_it(
    addon: ModuleType, obj: bpy.types.Object, trace: np.ndarray, recording: Any, root: str, target: str
) -> None:
    oracle = play(addon, obj, trace)
    assert np.ptp(oracle.performance.path, axis=0).min() > 0.5, "the character neither travels nor turns"
    bake_recording(root=root, target=target)
    assert_seen(obj, on_a_treadmill(oracle) if root == "IN_PLACE" else oracle)
    assert "Stroll Bake" in bpy.data.actions
    hips = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).matrix_world.translation
    travels = np.hypot(*(np.array(hips)[:2] - (2, -1))) > 0.5
    assert travels == (root == "OBJECT")


def test_the_object_carries_the_character_and_its_root_bone_rests(
    addon: ModuleType, obj: bpy.types.Object, trace: np.ndarray, recording: Any
) -> None:
    obj.rotation_mode = "QUATERNION"
    obj.rotation_quaternion = (np.cos(0.35), 0, 0, np.sin(0.35))
    parent = making.add_mesh()
    parent.location, parent.rotation_euler = (1, 2, 0.25), (0.2, -0.1, 0.4)
    obj.parent = parent
    bpy.context.view_layer.update()
    obj.matrix_parent_inverse = parent.matrix_world.inverted()
    bake_recording(root="OBJECT")
    assert_seen(obj, play(addon, obj, trace))
    character = addon.character.building.load(obj)
    root = seen_at(obj, range(FIRST, FIRST + 100, 9), [character.skeleton.names[0]])[0][:, 0]
    frames = play(addon, obj, trace).performance.path[:100:9]
    np.testing.assert_allclose(root[:, :2], frames[:, :2], atol=1e-3)


@pytest.mark.parametrize(
    ("option", "value"), [("responsiveness", 0.0), ("root_adjustment", 0.25), ("lock_feet", False)]
)
def test_a_bake_moves_as_the_armature_is_set_to(
    addon: ModuleType, obj: bpy.types.Object, option: str, value: Any
) -> None:
    trace = np.repeat([(0, 1.2, 0, 0), (0, -1.2, 0, 0), (1.2, 0, 0, 0), (0, 3.0, 0, 0), (0, 1.2, 1, 0)], 9, axis=0)
    addon.recordings.recordings.add_recording(obj, trace, seed=SEED, start=(2, -1, 0.7 + np.pi))
    usual, oracle = play(addon, obj, trace), play(addon, obj, trace, **{option: value})
    assert np.abs(oracle.heads - usual.heads).max() > 1e-3, "it makes no difference here"
    setattr(obj.fragmotion.feel, option, value)
    bake_recording()
    assert_seen(obj, oracle)


@pytest.mark.parametrize(("fps", "base"), [(24, 1.001), (60, 1.0), (12, 1.0)])
def test_a_bake_keeps_time_at_any_frame_rate(
    addon: ModuleType, obj: bpy.types.Object, trace: np.ndarray, recording: Any, fps: int, base: float
) -> None:
    render = bpy.context.scene.render
    render.fps, render.fps_base = fps, base
    bake_recording()
    frames = obj.animation_data.action.frame_range
    assert (frames[1] - frames[0]) / (fps / base) == pytest.approx(4, abs=0.5 / fps)
    assert_seen(obj, play(addon, obj, trace, fps / render.fps_base), step=3)


def test_a_recording_is_baked_with_its_own_seed_policy_and_start_or_others(
    addon: ModuleType, obj: bpy.types.Object, trace: np.ndarray, recording: Any
) -> None:
    recording.policy, recording.start = "greedy", (-3, 4, 1.5)
    bake_recording(seed=99)
    assert_seen(obj, play(addon, obj, trace, start=(-3, 4, 1.5), policy="greedy"))
    bake_recording(as_recorded=False, seed=SEED, policy="svm")
    assert_seen(obj, play(addon, obj, trace, policy="svm"))
    bake_recording(as_recorded=False, seed=SEED)
    assert_seen(obj, play(addon, obj, trace))
    recording.policy = "unheard-of"
    before = making.contents()
    with pytest.raises(RuntimeError, match=r"Bake: .*unheard-of"):
        bake_recording()
    assert making.contents() == before


def test_a_recording_that_was_seen_is_baked_as_it_was_seen(
    addon: ModuleType, obj: bpy.types.Object, trace: np.ndarray, recording: Any
) -> None:
    oracle = play(addon, obj, trace)
    played, motion = oracle.performance, addon.rig.motion.Motion
    shown = motion(played.root_positions, played.rotations, played.path, played.classes)
    uneven = np.sort(np.random.default_rng(1).permutation(len(shown.classes))[:-20])  # a preview that left frames out
    uneven[[0, -1]] = 0, len(shown.classes) - 1
    some = motion(*(values[uneven] for values in shown))
    addon.recordings.recordings.set_shown(recording, uneven / RATE, some)
    recording.seed = 99  # what was seen counts
    bake_recording()
    heads, _ = seen_at(obj, FIRST + uneven[::5], oracle.names)
    np.testing.assert_allclose(heads, oracle.heads[uneven[::5]], atol=1e-4)
    between = np.setdiff1d(np.arange(len(shown.classes)), uneven)
    heads, _ = seen_at(obj, FIRST + between, oracle.names)
    np.testing.assert_allclose(heads, oracle.heads[between], atol=0.07)

    addon.recordings.recordings.trim_recording(recording, 1.0, 3.0)
    assert tuple(recording.start) == pytest.approx(tuple(played.path[uneven[uneven >= RATE][0]]), abs=1e-4)
    bake_recording()
    assert tuple(obj.animation_data.action.frame_range) == pytest.approx((FIRST, FIRST + 2 * RATE), abs=1)
    inside = uneven[(uneven >= RATE) & (uneven <= 3 * RATE)]
    heads, _ = seen_at(obj, FIRST + inside - RATE, oracle.names)
    np.testing.assert_allclose(heads, oracle.heads[inside], atol=1e-4)
