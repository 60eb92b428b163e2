# SPDX-License-Identifier: MIT
"""The stick takes over for a stretch of a recording; before it nothing changes, after it the recording goes on."""

from __future__ import annotations

from importlib import import_module
from types import ModuleType
from typing import Any

import bpy
import driving
import numpy as np
import pytest
from driving import go_on
from test_modal_operators import Pressed


def start(session: ModuleType, obj: bpy.types.Object, begin: float, end: float) -> Any:
    obj.fragmotion.drive.relative = "CHARACTER"
    return driving.recorded(session).record_over(bpy.context, obj, obj.fragmotion.recordings[0], begin, end)


def test_the_stick_is_recorded_over_a_stretch_and_the_rest_follows(
    addon: ModuleType, session: ModuleType, obj: bpy.types.Object, recording: Any, trace: np.ndarray
) -> None:
    before = addon.recordings.recordings.shown_of(recording)[1]
    driven = start(session, obj, 5.0, 7.0)
    np.testing.assert_allclose(driven.actor.frame, before.path[180], atol=1e-5)
    driven.inputs.keyboard.press("Q")
    go_on(driven, 2)
    np.testing.assert_allclose(driven.actor.frame, before.path[300], atol=1e-5)
    go_on(driven, 2.5)
    frame = driven.actor.frame
    over = addon.recordings.recordings.trace_of(obj.fragmotion.recordings[0])
    session.stop()
    np.testing.assert_array_equal(over[:50], trace[:50])
    np.testing.assert_array_equal(over[50:70], np.tile([0, 0, 1, 0], (20, 1)))
    np.testing.assert_array_equal(over[70:], trace[70:])
    after = addon.recordings.recordings.shown_of(obj.fragmotion.recordings[0])[1]
    np.testing.assert_array_equal(after.rotations[:301], before.rotations[:301])
    np.testing.assert_array_equal(after.path[:301], before.path[:301])
    np.testing.assert_allclose(after.path[450], frame, atol=1e-3)
    assert len(obj.fragmotion.recordings) == 1 and len(after.path) == len(before.path)


def test_what_was_taken_until_the_drive_ends_is_kept(
    addon: ModuleType, session: ModuleType, obj: bpy.types.Object, recording: Any, trace: np.ndarray
) -> None:
    driven = start(session, obj, 1.0, 11.0)
    driven.inputs.keyboard.press("W")
    go_on(driven, 1.5)
    session.stop()
    over = addon.recordings.recordings.trace_of(obj.fragmotion.recordings[0])
    assert (over[10:15] != trace[10:15]).any()
    np.testing.assert_array_equal(over[15:], trace[15:])
    np.testing.assert_array_equal(over[:10], trace[:10])


def test_a_drive_that_ends_before_the_stretch_changes_nothing(
    session: ModuleType, obj: bpy.types.Object, recording: Any
) -> None:
    controls, shown = recording.controls, recording.shown
    go_on(start(session, obj, 5.0, 7.0), 1)
    session.stop()
    assert (obj.fragmotion.recordings[0].controls, obj.fragmotion.recordings[0].shown) == (controls, shown)


def test_a_stick_that_is_not_touched_leaves_what_was_there(
    addon: ModuleType, session: ModuleType, obj: bpy.types.Object, recording: Any
) -> None:
    controls, shown = recording.controls, recording.shown
    before = addon.recordings.recordings.shown_of(recording)[1]
    driven = start(session, obj, 5.0, 7.0)
    driven.inputs.keyboard.press("W")  # before it is the user's turn
    go_on(driven, 1)
    driven.inputs.keyboard.let_go("W")
    go_on(driven, 2.5)
    np.testing.assert_allclose(driven.actor.frame, before.path[390], atol=1e-5)
    go_on(driven, 1)
    assert "Nothing was touched: 'Stroll' is as it was" in driven.inputs.messages
    np.testing.assert_allclose(driven.actor.frame, before.path[450], atol=5e-3)
    session.stop()
    assert (obj.fragmotion.recordings[0].controls, obj.fragmotion.recordings[0].shown) == (controls, shown)


@pytest.mark.parametrize("late", [0.5, 0.53])
def test_what_is_recorded_over_begins_with_the_first_touch(
    addon: ModuleType, session: ModuleType, obj: bpy.types.Object, recording: Any, trace: np.ndarray, late: float
) -> None:
    before = addon.recordings.recordings.shown_of(recording)[1]
    driven = start(session, obj, 5.0, 7.0)
    go_on(driven, 2 + late)
    driven.inputs.keyboard.press("Q")
    go_on(driven, 2.5)
    frame, seconds = driven.actor.frame, 7.5 + late
    session.stop()
    first = 50 + int(np.ceil(10 * late - 1e-9))
    over = addon.recordings.recordings.trace_of(obj.fragmotion.recordings[0])
    np.testing.assert_array_equal(over[:first], trace[:first])
    np.testing.assert_array_equal(over[first:70], np.tile([0, 0, 1, 0], (70 - first, 1)))
    np.testing.assert_array_equal(over[70:], trace[70:])
    after = addon.recordings.recordings.shown_of(obj.fragmotion.recordings[0])[1]
    np.testing.assert_array_equal(after.path[: 6 * first + 1], before.path[: 6 * first + 1])
    np.testing.assert_allclose(after.path[round(60 * seconds)], frame, atol=1e-3)


def test_a_jump_within_a_tenth_of_a_second_takes_over(
    addon: ModuleType, session: ModuleType, obj: bpy.types.Object, recording: Any
) -> None:
    driven = start(session, obj, 5.0, 7.0)
    go_on(driven, 2 + 1 / 60)
    driven.inputs.keyboard.press("SPACE")
    go_on(driven, 2 / 60)
    driven.inputs.keyboard.let_go("SPACE")
    go_on(driven, 2.5)
    session.stop()
    over = addon.recordings.recordings.trace_of(obj.fragmotion.recordings[0])
    assert over[50:70, 3].tolist() == [0, 1, *[0] * 18]


def test_the_view_says_whose_turn_it_is(session: ModuleType, obj: bpy.types.Object, recording: Any) -> None:
    driven = start(session, obj, 5.0, 7.0)
    driven.span = (120.0, 168.0)
    driven.update(0.5)
    assert driven.shown().title == "Playing what was there: yours in 1.9 s", "an update goes on by 0.1 s at most"
    go_on(driven, 1.9)
    assert driven.shown().title == "Yours now, for 2.0 s: what was there stays until you do something"
    assert not driven.shown().recording and driven.shown().span == (120.0, 168.0)
    driven.inputs.keyboard.press("W")
    go_on(driven, 1)
    assert driven.shown().title == "Recording over: 1.0 s left" and driven.shown().recording
    go_on(driven, 1)
    assert driven.shown().title == "Kept: 'Stroll' is recorded over from 5.0 s to 7.0 s"
    assert driven.shown().span is None
    go_on(driven, 3)
    assert driven.shown().title == "Kept: playing the rest, 3.0 of 5.0 s" and not driven.is_done
    go_on(driven, 1.9)
    assert not driven.is_done
    go_on(driven, 0.2)
    assert driven.is_done


def test_what_was_kept_is_said_again_where_the_drive_ends_right_after(
    addon: ModuleType, session: ModuleType, obj: bpy.types.Object, recording: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What an operator reports before it ends is seen nowhere but in the Info editor."""
    operators = import_module(f"{addon.__name__}.operators.directing.drive")
    driven = start(session, obj, 9.7, 11.7)
    go_on(driven, 2)
    driven.inputs.keyboard.press("W")
    go_on(driven, 2.2)
    assert not driven.is_done and driven.shown().title.startswith("Kept: 'Stroll' is recorded over")
    driven.inputs.messages.clear()  # told while it went on
    go_on(driven, 0.2)
    assert driven.is_done
    session.stop()
    monkeypatch.setattr(operators, "rest", lambda _: None)
    monkeypatch.setattr(operators.preferences, "end_first_steps", lambda _: None)  # which are for other tests to end
    pressed = Pressed(operators.FRAGMOTION_OT_drive, _session=driven, _timer=None)
    assert pressed._end() == {"FINISHED"}
    assert pressed.told == [({"INFO"}, "Kept: 'Stroll' is recorded over from 9.7 s to 11.7 s")]


@pytest.mark.parametrize(("begin", "end"), [(-3.0, 2.0), (12.5, 14.0)])
def test_only_a_stretch_of_the_recording_is_recorded_over(
    addon: ModuleType, session: ModuleType, obj: bpy.types.Object, recording: Any, begin: float, end: float
) -> None:
    with pytest.raises(addon.errors.UserError, match=r"lasts 12\.0 s: there is nothing of it to record over"):
        start(session, obj, begin, end)
    assert session.current is None
