# SPDX-License-Identifier: MIT
"""A stumble is cut out, recordings are glued: what follows moves as it did."""

from __future__ import annotations

from importlib import import_module
from types import MethodType, ModuleType, SimpleNamespace
from typing import Any

import bpy
import making
import numpy as np
import pytest

_JOINED = 48  # poses after which a join is over


def press(name: str, **fields: Any) -> None:
    assert getattr(bpy.ops.fragmotion, name)("EXEC_DEFAULT", True, **fields) == {"FINISHED"}


def seen(addon: ModuleType, obj: bpy.types.Object, motion: Any) -> np.ndarray:
    """Roots and rotations [F,*] with the character frame at the origin."""
    hips = addon.character.building.load(obj).skeleton
    still = addon.rig.motion.carried(motion, hips.names.index(hips.roles["hips"]), np.zeros(3))
    rotations = still.rotations * np.sign(still.rotations[..., :1])
    return np.column_stack((still.root_positions, rotations.reshape(len(rotations), -1)))


def shown(addon: ModuleType, recording: Any) -> Any:
    return addon.recordings.recordings.shown_of(recording)[1]


def test_what_follows_a_cut_moves_as_it_did_and_what_comes_before_stays(
    addon: ModuleType, obj: bpy.types.Object, recording: Any, trace: np.ndarray
) -> None:
    before = shown(addon, recording)
    press("cut_recording", start=4, end=6)
    after, rest = shown(addon, recording), addon.recordings.recordings.trace_of(recording)
    end = int(np.flatnonzero((rest != trace[: len(rest)]).any(1))[0])
    removed = len(trace) - len(rest)
    seams = [e for e in range(38, 41) if np.array_equal(rest, np.concatenate((trace[:e], trace[e + removed :])))]
    assert 20 <= removed <= 25 and seams, "half a second more at most"
    end = seams[-1]
    np.testing.assert_array_equal(after.root_positions[: 6 * seams[0] + 1], before.root_positions[: 6 * seams[0] + 1])
    np.testing.assert_array_equal(after.rotations[: 6 * seams[0] + 1], before.rotations[: 6 * seams[0] + 1])
    moves, moved = seen(addon, obj, after), seen(addon, obj, before)
    np.testing.assert_allclose(moves[6 * end + _JOINED :], moved[6 * (end + removed) + _JOINED :], atol=1e-5)
    steps = np.linalg.norm(np.diff(after.path[:, :2], axis=0), axis=1)
    assert steps.max() < 1.3 * np.linalg.norm(np.diff(before.path[:, :2], axis=0), axis=1).max(), "it never leaps"
    assert recording.seconds == pytest.approx(len(rest) / 10)


def test_a_cut_is_undone_and_is_baked_as_it_is_shown(
    addon: ModuleType, obj: bpy.types.Object, recording: Any, trace: np.ndarray
) -> None:
    bpy.ops.ed.undo_push(message="recorded")
    press("cut_recording", start=4, end=6)
    motion = shown(addon, recording)
    press("bake", trace_source="RECORDING", recording=0, as_recorded=True)
    seconds = (len(motion.path) - 1) / 60
    frames = obj.animation_data.action.frame_range
    assert (frames[1] - frames[0]) / 24 == pytest.approx(seconds, abs=0.05)
    bpy.ops.ed.undo()
    bpy.ops.ed.undo()
    again = next(each for each in bpy.data.objects if each.type == "ARMATURE").fragmotion.recordings[0]
    np.testing.assert_array_equal(addon.recordings.recordings.trace_of(again), trace)


@pytest.mark.parametrize(("start", "end"), [(0, 2), (10, 12), (6, 4), (20, 30)])
def test_only_the_middle_is_cut_out(
    addon: ModuleType, obj: bpy.types.Object, recording: Any, start: float, end: float
) -> None:
    controls, poses = recording.controls, recording.shown
    with pytest.raises(RuntimeError, match=r"'Stroll' lasts 12.0 s: from .* is no stretch of its middle"):
        bpy.ops.fragmotion.cut_recording(start=start, end=end)
    assert (recording.controls, recording.shown) == (controls, poses)


def test_an_imported_recording_is_cut_as_it_is_played(
    addon: ModuleType, obj: bpy.types.Object, recording: Any, trace: np.ndarray
) -> None:
    other = addon.recordings.recordings.add_recording(obj, trace, name="Imported", seed=3, start=(2, -1, 0.5))
    press("cut_recording", start=4, end=6)
    obj.fragmotion.active_recording = 0
    press("cut_recording", start=4, end=6)
    np.testing.assert_allclose(
        shown(addon, other).root_positions, shown(addon, obj.fragmotion.recordings[0]).root_positions, atol=1e-5
    )


def test_glued_recordings_follow_each_other_from_where_the_character_is(
    addon: ModuleType, obj: bpy.types.Object, recording: Any, trace: np.ndarray
) -> None:
    other = np.tile([0, 1.2, 0.5, 0], (40, 1))
    addon.recordings.recordings.add_recording(obj, other, name="More", seed=9, start=(50, 0, 0))
    obj.fragmotion.active_recording = 0
    first, second = (
        shown(addon, obj.fragmotion.recordings[0]),
        addon.edits.replaying.shown_poses(obj, obj.fragmotion.recordings[1]),
    )
    press("glue_recording")
    glued, whole = obj.fragmotion.recordings[0], shown(addon, obj.fragmotion.recordings[0])
    assert [each.name for each in obj.fragmotion.recordings] == ["Stroll", "More"]
    length = len(addon.recordings.recordings.trace_of(glued))
    assert len(trace) + len(other) - 10 <= length <= len(trace) + len(other)
    np.testing.assert_array_equal(whole.root_positions[:400], first.root_positions[:400])
    np.testing.assert_allclose(seen(addon, obj, whole)[-120:], seen(addon, obj, second)[-120:], atol=1e-5)
    steps = np.linalg.norm(np.diff(whole.path[:, :2], axis=0), axis=1)
    assert steps.max() < 0.1


def test_recordings_without_a_character_are_cut_and_glued_as_controls(addon: ModuleType) -> None:
    obj = making.add_armature()
    for name in ("one", "two"):
        addon.recordings.recordings.add_recording(obj, making.waves(50, 4, 1) / 2 + 0.5, name=name)
    obj.fragmotion.active_recording = 0
    press("glue_recording")
    press("cut_recording", start=2, end=3)
    trace = addon.recordings.recordings.trace_of(obj.fragmotion.recordings[0])
    rows = making.waves(50, 4, 1) / 2 + 0.5
    np.testing.assert_array_equal(trace, np.concatenate((rows[:20], rows[30:], rows)))
    obj.fragmotion.active_recording = 1
    with pytest.raises(RuntimeError, match="No recording comes after it"):
        bpy.ops.fragmotion.glue_recording()


def test_where_it_would_be_cut_is_found_before(addon: ModuleType, obj: bpy.types.Object, recording: Any) -> None:
    controls, poses = recording.controls, recording.shown
    seam = addon.edits.cutting.cut_finder(obj, recording)(4.0, 6.0)
    assert (recording.controls, recording.shown) == (controls, poses)
    assert 38 <= seam.end <= 40 and 60 <= seam.beginning <= 63 and 0 <= seam.distance < 1
    assert addon.edits.cutting.cut_out(obj, recording, 4.0, 6.0) == seam


@pytest.fixture
def pressed(addon: ModuleType, obj: bpy.types.Object, recording: Any) -> Any:
    """The operator as it is begun in a window that shows no time."""
    operators = import_module(f"{addon.__name__}.operators.directing.cut_recording")
    tool = SimpleNamespace(_length=recording.seconds, _first=1.0, _rate=24.0, told=[])
    tool.report = lambda kind, text: tool.told.append(text)
    for name in ("_ask", "_seconds_at", "execute"):
        setattr(tool, name, MethodType(getattr(operators.FRAGMOTION_OT_cut_recording, name), tool))
    return tool


@pytest.mark.parametrize(("now", "kept"), [(40, (11.8, 11.9)), (4, (4, 5)), (-3, (0.1, 0.2)), (11.5, (11.5, 11.9))])
def test_what_is_first_offered_is_within_the_recording(pressed: Any, now: float, kept: tuple[float, float]) -> None:
    pressed._ask(bpy.context.scene, now)
    assert (pressed.start, pressed.end) == pytest.approx(kept)


@pytest.mark.parametrize("ranged", [True, False])
def test_a_preview_range_that_is_cut_out_is_over(pressed: Any, recording: Any, ranged: bool) -> None:
    scene = bpy.context.scene
    scene.use_preview_range, scene.frame_preview_start, scene.frame_preview_end = True, 97, 145
    scene.use_preview_range = ranged
    pressed._ask(scene, 5.0)
    assert (pressed.start, pressed.end) == pytest.approx((4.0, 6.0) if ranged else (5.0, 6.0))
    scene.use_preview_range = True
    assert pressed.execute(bpy.context) == {"FINISHED"}
    assert scene.use_preview_range != ranged and recording.seconds < 11.1
    assert "the poses are" in pressed.told[0]
