# SPDX-License-Identifier: MIT
"""At the playhead the character is where it was pinned, as a bake shows it."""

from __future__ import annotations

import math
from types import ModuleType
from typing import Any

import bpy
import numpy as np
import pytest


def press(name: str, **fields: Any) -> None:
    assert getattr(bpy.ops.fragmotion, name)("EXEC_DEFAULT", True, **fields) == {"FINISHED"}


def shown(addon: ModuleType, recording: Any) -> Any:
    return addon.recordings.recordings.shown_of(recording)[1]


def pin(frame: np.ndarray) -> None:
    """Put an empty at a character frame, which the panel names."""
    empty = bpy.data.objects.new("Mark", None)
    bpy.context.scene.collection.objects.link(empty)
    empty.location, empty.rotation_euler.z = (frame[0], frame[1], 0), frame[2] - math.pi
    bpy.context.view_layer.update()
    settings = bpy.context.view_layer.objects.active.fragmotion
    settings.pin_at, settings.pin.any_heading = empty, False


def playhead(seconds: float) -> int:
    """Put the playhead on a time of the recording, of which whole frames exist; the number of its pose."""
    bpy.context.scene.frame_set(round(5 + 24 * seconds))
    return round(60 * seconds)


def test_the_character_is_at_the_pin_and_was_not_changed_before(
    addon: ModuleType, obj: bpy.types.Object, recording: Any, trace: np.ndarray
) -> None:
    before = shown(addon, recording)
    pose = playhead(8)
    goal = before.path[pose] + (0.15, -0.1, 0.1)
    pin(goal)
    press("pin_recording", stretch=4)
    after, pinned = shown(addon, recording), addon.recordings.recordings.trace_of(recording)
    np.testing.assert_allclose(after.path[pose], goal, atol=1e-5)
    np.testing.assert_array_equal(pinned[:40], trace[:40])
    np.testing.assert_array_equal(pinned[80:], trace[80:])
    np.testing.assert_array_equal(after.rotations[:241], before.rotations[:241])
    np.testing.assert_array_equal(after.root_positions[:241], before.root_positions[:241])
    replayed = addon.edits.replaying.replay(obj, addon.character.building.load(obj), recording, pinned, recording.seed)
    assert np.hypot(*(replayed.path[pose] - goal)[:2]) <= 0.02 + 1e-3, "what is left is small"


def test_a_pin_is_baked_and_undone(addon: ModuleType, obj: bpy.types.Object, recording: Any, trace: np.ndarray) -> None:
    goal = shown(addon, recording).path[playhead(8)] + (0.1, 0.1, -0.05)
    pin(goal)
    bpy.ops.ed.undo_push(message="pinned next")
    press("pin_recording")
    press("bake", trace_source="RECORDING", recording=0, as_recorded=True)
    bpy.context.scene.frame_set(5 + 24 * 8)
    posed = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    np.testing.assert_allclose(np.array(posed.matrix_world @ posed.pose.bones["Hips"].head)[:2], goal[:2], atol=1e-3)
    bpy.ops.ed.undo()
    bpy.ops.ed.undo()
    again = next(each for each in bpy.data.objects if each.type == "ARMATURE").fragmotion.recordings[0]
    np.testing.assert_array_equal(addon.recordings.recordings.trace_of(again), trace)


def test_a_pin_at_the_cursor_and_from_the_beginning_on(
    addon: ModuleType, obj: bpy.types.Object, recording: Any
) -> None:
    pose = playhead(3)
    goal = shown(addon, recording).path[pose] + (0.1, 0.0, 0.05)
    cursor = bpy.context.scene.cursor
    cursor.location, cursor.rotation_mode = (*goal[:2], 0), "XYZ"
    cursor.rotation_euler = (0, 0, goal[2] - math.pi)
    press("pin_recording", place="CURSOR", stretch=10, any_heading=False)
    frame = shown(addon, recording).path[pose]
    np.testing.assert_allclose(frame[:2], goal[:2], atol=1e-5)
    assert math.remainder(frame[2] - goal[2], 2 * math.pi) == pytest.approx(0, abs=1e-5)


def test_a_recording_that_was_cut_is_pinned_where_it_is_shown(
    addon: ModuleType, obj: bpy.types.Object, recording: Any
) -> None:
    press("cut_recording", start=2, end=3)
    before = shown(addon, recording)
    pose = playhead(8)
    goal = before.path[pose] + (0.2, 0.1, 0.05)
    pin(goal)
    press("pin_recording", stretch=4)
    after = shown(addon, recording)
    np.testing.assert_allclose(after.path[pose], goal, atol=1e-4)
    np.testing.assert_array_equal(after.rotations[:241], before.rotations[:241])


@pytest.mark.thorough
def test_a_pin_out_of_reach_says_by_how_much_and_changes_nothing(
    addon: ModuleType, obj: bpy.types.Object, recording: Any
) -> None:
    controls, poses = recording.controls, recording.shown
    pin(shown(addon, recording).path[playhead(8)] + (30, 0, 0))
    with pytest.raises(
        RuntimeError, match=r"The pin is 30\.00 m and 0 degrees from where recording 'Stroll' leads; the near"
    ):
        bpy.ops.fragmotion.pin_recording("EXEC_DEFAULT")
    assert (recording.controls, recording.shown) == (controls, poses)


def test_a_playhead_beside_the_recording_is_told(addon: ModuleType, obj: bpy.types.Object, recording: Any) -> None:
    for frame in (1, 5, 5 + 24 * 13):
        bpy.context.scene.frame_set(frame)
        with pytest.raises(RuntimeError, match=r"The pin is .* s after the beginning of recording 'Stroll', which"):
            bpy.ops.fragmotion.pin_recording("EXEC_DEFAULT")


def test_a_place_is_met_however_the_character_faces_there(
    addon: ModuleType, obj: bpy.types.Object, recording: Any
) -> None:
    assert obj.fragmotion.pin.any_heading, "at first"
    pose = playhead(8)
    before = shown(addon, recording)
    goal = before.path[pose] + (0.15, -0.1, 2.8)  # nearly the other way
    pin(goal)
    obj.fragmotion.pin.any_heading = True
    press("pin_recording", stretch=4)
    after = shown(addon, recording)
    np.testing.assert_allclose(after.path[pose][:2], goal[:2], atol=1e-5)
    turned = math.remainder(after.path[pose][2] - before.path[pose][2], 2 * math.pi)
    assert abs(turned) < math.radians(60), "it faces about as it did, as nobody asked for another heading"
    np.testing.assert_array_equal(after.rotations[:241], before.rotations[:241])


def test_several_places_are_met_in_one_go(addon: ModuleType, obj: bpy.types.Object, recording: Any) -> None:
    before = shown(addon, recording)
    goals = {pose: before.path[pose] + off for pose, off in ((240, (0.1, 0.05, 0)), (480, (0.15, -0.1, 0)))}
    for pose, goal in reversed(goals.items()):
        bpy.context.scene.cursor.location = (*goal[:2], 0)
        press("add_beat")
        obj.fragmotion.story[-1].frame = round(5 + 24 * pose / 60)
    bpy.context.view_layer.update()
    press("pin_recording", place="STORY", stretch=3.5)
    after = shown(addon, obj.fragmotion.recordings[0])
    for pose, goal in goals.items():
        np.testing.assert_allclose(after.path[pose][:2], goal[:2], atol=1e-4)
    np.testing.assert_array_equal(after.rotations[:31], before.rotations[:31])


def test_a_storyboard_without_places_pins_nothing(addon: ModuleType, obj: bpy.types.Object, recording: Any) -> None:
    press("add_beat")
    obj.fragmotion.story[0].place = None
    with pytest.raises(RuntimeError, match="No entry of the storyboard has a place"):
        bpy.ops.fragmotion.pin_recording("EXEC_DEFAULT", place="STORY")
