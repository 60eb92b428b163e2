# SPDX-License-Identifier: MIT
"""A recording is edited as curves: what is not changed stays to the bit, and nothing is lost."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import making
import numpy as np
import pytest

CHANNELS = ("velocity_right", "velocity_forward", "turn", "jump")


@pytest.fixture
def versions(addon: ModuleType) -> ModuleType:
    return import_module(f"{addon.__name__}.compat.versions")


def press(name: str, **fields: Any) -> None:
    """A button, as one undo step."""
    assert getattr(bpy.ops.fragmotion, name)("EXEC_DEFAULT", True, **fields) == {"FINISHED"}


def stroll() -> Any:
    """The recording that is there after undo, too."""
    armatures = [obj for obj in bpy.data.objects if obj.type == "ARMATURE"]
    return armatures[0].fragmotion.recordings["Stroll"]


def curve(versions: ModuleType, name: str) -> Any:
    empty = stroll().curves
    action, _ = versions.assignment(empty)
    return next(each for each in versions.curves_of(action, empty) if each.data_path == f'["{name}"]')


def frame_of(control: int) -> float:
    return 5 + 2.4 * control


def trace_of(addon: ModuleType) -> np.ndarray:
    trace: np.ndarray = addon.recordings.recordings.trace_of(stroll())
    return trace


def test_curves_show_the_controls_and_nothing_changes_by_itself(
    addon: ModuleType, versions: ModuleType, obj: bpy.types.Object, recording: Any, trace: np.ndarray
) -> None:
    shown = recording.shown
    press("edit_curves")
    empty = stroll().curves
    assert bpy.context.view_layer.objects.active == empty and empty.parent == obj
    assert [each.name for each in bpy.context.selected_objects] == [empty.name] == ["Stroll Curves"]
    assert empty.animation_data.action.name == "Stroll Curves"
    for column, name in enumerate(CHANNELS):
        values = [curve(versions, name).evaluate(frame_of(i)) for i in range(len(trace))]
        np.testing.assert_allclose(values, trace[:, column], atol=1e-6)
    bpy.context.scene.frame_set(round(frame_of(50)))
    assert empty["velocity_forward"] == pytest.approx(trace[50, 1], abs=0.2)
    press("play_again")
    np.testing.assert_array_equal(trace_of(addon), trace)
    assert stroll().shown == shown


def test_a_changed_curve_changes_what_comes_from_there_on_alone(
    addon: ModuleType, versions: ModuleType, obj: bpy.types.Object, recording: Any, trace: np.ndarray
) -> None:
    _, before = addon.recordings.recordings.shown_of(recording)
    press("edit_curves")
    turn = curve(versions, "turn")
    for control in range(60, 80):
        key = turn.keyframe_points.insert(frame_of(control), 0.5)
        key.interpolation = "CONSTANT"
    press("play_again")
    edited = trace_of(addon)
    first = int(np.flatnonzero((edited != trace).any(1))[0])
    assert 58 <= first <= 60
    np.testing.assert_array_equal(edited[:first], trace[:first])
    np.testing.assert_array_equal(edited[60:80, 2], 0.5)
    np.testing.assert_array_equal(edited[:, [0, 1, 3]], trace[:, [0, 1, 3]])
    times, after = addon.recordings.recordings.shown_of(stroll())
    assert len(times) == 6 * len(trace) + 1
    for name in ("root_positions", "rotations", "path", "classes"):
        one, other = getattr(before, name), getattr(after, name)
        np.testing.assert_array_equal(one[: 6 * first + 1], other[: 6 * first + 1])
    replayed = addon.edits.replaying.replay(obj, addon.character.building.load(obj), stroll(), edited, 3)
    np.testing.assert_allclose(after.root_positions, replayed.root_positions, atol=1e-4)
    assert np.abs(after.path[-1] - before.path[-1]).max() > 0.05, "the change shows"


def test_an_edit_is_undone_and_redone(
    addon: ModuleType, versions: ModuleType, obj: bpy.types.Object, recording: Any, trace: np.ndarray
) -> None:
    bpy.ops.ed.undo_push(message="recorded")
    shown = recording.shown
    press("edit_curves")
    curve(versions, "velocity_forward").keyframe_points[-1].co.y = 3.0
    bpy.ops.ed.undo_push(message="drawn")
    press("play_again")
    edited = trace_of(addon)
    assert (edited != trace).any() and stroll().shown != shown
    bpy.ops.ed.undo()
    np.testing.assert_array_equal(trace_of(addon), trace)
    assert stroll().shown == shown
    bpy.ops.ed.undo()
    bpy.ops.ed.undo()
    assert stroll().curves is None and "Stroll Curves" not in bpy.data.objects
    for _ in range(3):
        bpy.ops.ed.redo()
    np.testing.assert_array_equal(trace_of(addon), edited)


def test_a_jump_that_is_drawn_for_a_moment_is_jumped(
    addon: ModuleType, versions: ModuleType, recording: Any, trace: np.ndarray
) -> None:
    press("edit_curves")
    jump = curve(versions, "jump")
    for frame, value in ((frame_of(30) + 1.2, 1.0), (frame_of(30) + 2.0, 0.0)):
        jump.keyframe_points.insert(frame, value).interpolation = "CONSTANT"
    press("play_again")
    expected = trace[:, 3].copy()
    expected[30] = 1
    np.testing.assert_array_equal(trace_of(addon)[:, 3], expected)


def test_keys_outside_the_recording_are_told_and_kept(
    addon: ModuleType, versions: ModuleType, recording: Any, trace: np.ndarray
) -> None:
    press("edit_curves")
    turn = curve(versions, "turn")
    turn.keyframe_points.insert(-20, 0.0)
    turn.keyframe_points.insert(900, 1.0)
    drawn = addon.recordings.curves.read_curves(stroll().id_data, stroll())
    assert drawn.remarks == [
        "2 keys of 'turn' are outside the recording, frames 5 to 291, and count only for the way to them"
    ]
    press("play_again")
    assert len(trace_of(addon)) == len(trace) and len(turn.keyframe_points) > 2


def test_what_is_no_number_is_one_message_and_changes_nothing(
    addon: ModuleType, versions: ModuleType, recording: Any, trace: np.ndarray
) -> None:
    press("edit_curves")
    forward = curve(versions, "velocity_forward")
    forward.keyframe_points.insert(frame_of(40), float("nan"))
    controls, shown = recording.controls, recording.shown
    with pytest.raises(RuntimeError, match=r"Curve 'velocity_forward' is not a number at frame \d+: delete or mend"):
        bpy.ops.fragmotion.play_again()
    assert (stroll().controls, stroll().shown) == (controls, shown)


def test_too_much_is_held_within_what_a_recording_may_be(
    addon: ModuleType, versions: ModuleType, recording: Any
) -> None:
    press("edit_curves")
    for name, value in (("turn", -50.0), ("velocity_right", 1e6)):
        for key in curve(versions, name).keyframe_points:
            key.co.y = value
    press("play_again")
    assert (trace_of(addon)[:, :3].min(), trace_of(addon)[:, :3].max()) == (-6, 100)


def test_curves_that_were_deleted_or_muted(
    addon: ModuleType, versions: ModuleType, recording: Any, trace: np.ndarray
) -> None:
    press("edit_curves")
    empty = stroll().curves
    holder = versions.holder_for(empty.animation_data.action, empty)
    holder.fcurves.remove(curve(versions, "turn"))
    curve(versions, "velocity_forward").mute = True
    for key in curve(versions, "velocity_forward").keyframe_points:
        key.co.y = 9
    drawn = addon.recordings.curves.read_curves(stroll().id_data, stroll())
    assert drawn.remarks == [
        "curve 'velocity_forward' is muted: it stays as recorded",
        "there is no curve 'turn': it is 0",
    ]
    np.testing.assert_array_equal(drawn.trace, trace * (1, 1, 0, 1))


def test_play_again_needs_curves_and_edit_curves_makes_them_anew(
    addon: ModuleType, obj: bpy.types.Object, recording: Any, trace: np.ndarray
) -> None:
    with pytest.raises(RuntimeError, match="has no curves: press Edit Curves first"):
        bpy.ops.fragmotion.play_again()
    press("edit_curves")
    bpy.ops.object.delete()
    making.activate(obj)
    with pytest.raises(RuntimeError, match="has no curves: press Edit Curves first"):
        bpy.ops.fragmotion.play_again()
    press("edit_curves")
    press("edit_curves")
    assert [each.name for each in bpy.data.objects if each.parent == obj and each.type == "EMPTY"] == [
        bpy.context.view_layer.objects.active.name
    ]


def test_curves_follow_a_trimmed_recording_and_go_with_a_deleted_one(
    addon: ModuleType, versions: ModuleType, recording: Any, trace: np.ndarray
) -> None:
    press("edit_curves")
    press("trim_recording", start=2, end=6)
    values = [curve(versions, "velocity_forward").evaluate(frame_of(i)) for i in range(40)]
    np.testing.assert_allclose(values, trace[20:60, 1], atol=1e-6)
    actions = len(bpy.data.actions)
    press("delete_recording")
    assert "Stroll Curves" not in bpy.data.objects and len(bpy.data.actions) == actions - 1


def test_a_copy_of_the_recording_or_the_armature_has_curves_of_its_own(
    addon: ModuleType, obj: bpy.types.Object, recording: Any
) -> None:
    press("edit_curves")
    making.activate(obj)
    press("duplicate_recording")
    assert obj.fragmotion.recordings[1].curves is None and obj.fragmotion.recordings[0].curves is not None
    copy = obj.copy()
    assert addon.recordings.curves.curves_of(copy, copy.fragmotion.recordings[0]) is None


def test_curves_survive_saving(
    addon: ModuleType, versions: ModuleType, recording: Any, trace: np.ndarray, tmp_path: Path
) -> None:
    press("edit_curves")
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "kept.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "kept.blend"))
    curve(versions, "turn").keyframe_points[-1].co.y = 0.75
    press("play_again")
    assert trace_of(addon)[-1, 2] == 0.75
    np.testing.assert_array_equal(trace_of(addon)[:, [0, 1, 3]], trace[:, [0, 1, 3]])


def test_a_recording_of_a_body_that_only_slid_is_edited_without_poses(addon: ModuleType) -> None:
    armature = making.add_armature()
    addon.recordings.recordings.add_recording(armature, np.tile([0, 1.2, 0, 0], (30, 1)), name="Stroll")
    press("edit_curves")
    versions = import_module(f"{addon.__name__}.compat.versions")
    for key in curve(versions, "velocity_forward").keyframe_points:
        key.co.y = 0.5
    press("play_again")
    np.testing.assert_array_equal(trace_of(addon)[:, 1], 0.5)
    assert not stroll().shown
