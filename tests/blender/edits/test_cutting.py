# SPDX-License-Identifier: MIT
"""A stumble is cut out, recordings are glued: what follows moves as it did."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType, SimpleNamespace
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
    seam = addon.edits.cutting.find_cut(obj, recording, 4.0, 6.0)
    assert (recording.controls, recording.shown) == (controls, poses)
    assert 38 <= seam.end <= 40 and 60 <= seam.beginning <= 63 and 0 <= seam.distance < 1
    assert addon.edits.cutting.cut_out(obj, recording, 4.0, 6.0) == seam


@pytest.mark.parametrize(("fields", "kept"), [((40, 6), (5.9, 6)), ((4, 60), (4, 11.9)), ((0, 0), (0.1, 0.2))])
def test_the_dialogs_fields_stay_within_the_recording(
    addon: ModuleType, recording: Any, fields: tuple[float, float], kept: tuple[float, float]
) -> None:
    operators = import_module(f"{addon.__name__}.operators.directing.edit_recordings")
    shown: list[tuple[float, float]] = []
    dialog = SimpleNamespace(start=fields[0], end=fields[1])
    dialog._show_joins = lambda context: shown.append((dialog.start, dialog.end))
    assert operators.FRAGMOTION_OT_cut_recording.check(dialog, bpy.context)
    assert shown == [pytest.approx(kept)]


@pytest.mark.parametrize("ranged", [True, False])
def test_a_preview_range_that_is_cut_out_is_over(
    addon: ModuleType, obj: bpy.types.Object, recording: Any, ranged: bool
) -> None:
    operators, scene = import_module(f"{addon.__name__}.operators.directing.edit_recordings"), bpy.context.scene
    scene.use_preview_range, scene.frame_preview_start, scene.frame_preview_end = True, 97, 145
    operator = operators.FRAGMOTION_OT_cut_recording
    dialog = SimpleNamespace(start=4.0, end=6.0, report=lambda *told: None, _is_range=ranged)
    assert operator.execute(dialog, bpy.context) == {"FINISHED"}
    assert scene.use_preview_range != ranged and recording.seconds < 10.1
