# SPDX-License-Identifier: MIT
"""What is recorded over a recording with moves and styles is kept as it was shown."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import driving
import making
import numpy as np
import pytest

TAKES = {"stand", "walk forward", "run forward", "jump up", "tired stand", "tired walk forward"}
JUMP, WAVE = "jump up", "wave"
NEUTRAL, TIRED = 0, 1
NEAR = 2e-3  # m: what is shown is kept in single precision


def part(addon: ModuleType, name: str) -> Any:
    return import_module(f"{addon.__name__}.{name}")


@pytest.fixture(scope="module")
def asking(addon: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A file with a character of two styles, a move of the whole body and one of the upper body, saved."""
    obj = making.open_sample()
    obj.fragmotion.moves.clear()
    for action in bpy.data.actions:
        action.fragmotion.use = action.name in TAKES
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=8, synthesize=False) == {"FINISHED"}
    moves = part(addon, "character.moves")
    moves.add_move(bpy.context, obj, bpy.data.actions[JUMP], None, ["W", "R"])
    wave = moves.add_move(bpy.context, obj, bpy.data.actions["stand"], (1, 60), ["W", "R"])
    wave.name, wave.upper_body = WAVE, True
    moves.bring_up_to_date(bpy.context, obj)
    path = tmp_path_factory.mktemp("asking") / "asking.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


@pytest.fixture
def obj(addon: ModuleType, asking: Path) -> bpy.types.Object:
    """The armature in that file, active, with a recording that asks for moves and styles all the time."""
    part(addon, "character.building").forget()
    bpy.ops.wm.open_mainfile(filepath=str(asking))
    obj = bpy.context.view_layer.objects.active
    obj.fragmotion.drive.relative = "CHARACTER"
    recordings, styles = part(addon, "recordings.recordings"), part(addon, "recordings.styles")
    trace = part(addon, "compat.core").core.simulate_trace("walker", 12.0, 5)
    started = [(5, WAVE, 4), (38, WAVE, 20), (45, JUMP, 2), (52, JUMP, 3), (90, WAVE, 5), (100, JUMP, 1)]
    changes = [(10, "tired"), (30, "neutral"), (48, "tired"), (95, "tired"), (110, "neutral")]
    recordings.add_recording(
        obj,
        trace,
        seed=3,
        start=(2, -1, 0.5),
        moves=[recordings.StartedMove(*each) for each in started],
        styles=[styles.StyleChange(*each) for each in changes],
    )
    return obj


class Seen:
    """Where the character was after each step."""

    def __init__(self, driven: Any) -> None:
        self._driven, self.frames, self.heads, self.played = driven, [], [], []

    def go_on(self, seconds: float) -> None:
        for _ in range(round(seconds * driving.RATE)):
            self._driven.update(1 / driving.RATE)
            self.frames.append(self._driven.actor.frame)
            self.heads.append(driving.hips(self._driven.obj))
            self.played.append((self._driven.player.playing_style, *self._driven.player.playing_moves))


def record_over(session: ModuleType, obj: bpy.types.Object) -> Seen:
    """From 4 s to 7 s: a walk while the recording still waves, a jump, another style, and a wave to the very end."""
    driven = driving.recorded(session).record_over(bpy.context, obj, obj.fragmotion.recordings[0], 4.0, 7.0)
    press, let_go = driven.inputs.keyboard.press, driven.inputs.keyboard.let_go
    jump, wave = (row.key for row in obj.fragmotion.moves)
    seen = Seen(driven)
    press(jump)  # before it is the user's turn
    let_go(jump)
    driven.styling.step_by(1)
    seen.go_on(2.0)
    press("W")
    seen.go_on(0.55)
    press(jump)
    seen.go_on(0.23)
    let_go(jump)
    driven.styling.step_by(1)
    seen.go_on(1.3)
    press(wave)
    driven.toggle_recording()
    seen.go_on(0.92)
    seen.go_on(5.0 - 0.05)
    return seen


@pytest.mark.thorough
def test_what_is_recorded_over_moves_and_styles_is_kept_as_it_was_shown(
    addon: ModuleType, session: ModuleType, obj: bpy.types.Object
) -> None:
    seen = record_over(session, obj)
    session.stop()
    recording = obj.fragmotion.recordings[0]
    _, kept = part(addon, "recordings.recordings").shown_of(recording)
    first = 2 * driving.RATE + 1
    np.testing.assert_allclose(kept.path[first : first + len(seen.frames), :2], np.array(seen.frames)[:, :2], atol=NEAR)
    again = Seen(driving.recorded(session).replay(bpy.context, obj, recording))
    again.go_on(12.0)
    shown = slice(first - 1, first - 1 + len(seen.heads))
    np.testing.assert_allclose(again.heads[shown], seen.heads, atol=NEAR)
    assert again.played[shown] == seen.played
    styles, whole, upper = (set(column) for column in zip(*seen.played))
    assert styles == {NEUTRAL, TIRED} and {0, -1} <= whole and {1, -1} <= upper, "all that is asked for is played"
    assert len(obj.fragmotion.recordings) == 1


@pytest.mark.thorough
def test_the_users_moves_and_styles_stand_where_the_recordings_were(
    addon: ModuleType, session: ModuleType, obj: bpy.types.Object
) -> None:
    record_over(session, obj)
    session.stop()
    recordings, recording = part(addon, "recordings.recordings"), obj.fragmotion.recordings[0]
    assert recordings.moves_of(recording) == [
        *[(5, WAVE, 4), (38, WAVE, 20), (46, JUMP, 2), (61, WAVE, 9), (90, WAVE, 5), (100, JUMP, 1)]
    ]
    assert recordings.styles_of(recording) == [
        *[(10, "tired"), (30, "neutral"), (48, "tired"), (95, "tired"), (110, "neutral")]
    ]


def test_a_replay_that_fails_leaves_the_recording_as_it_was(
    addon: ModuleType, session: ModuleType, obj: bpy.types.Object, monkeypatch: pytest.MonkeyPatch
) -> None:
    replaying, fields = part(addon, "edits.replaying"), ("controls", "moves", "style", "styles", "shown")
    before = [getattr(obj.fragmotion.recordings[0], field) for field in fields]

    def fail(*_arguments: Any) -> None:
        raise ValueError("injected")

    driven = driving.recorded(session).record_over(bpy.context, obj, obj.fragmotion.recordings[0], 4.0, 5.0)
    driven.inputs.keyboard.press("W")
    driving.go_on(driven, 2.5)
    monkeypatch.setattr(replaying, "from_then_on", fail)
    with pytest.raises(ValueError, match="injected"):
        session.stop()
    assert [getattr(obj.fragmotion.recordings[0], field) for field in fields] == before
    assert session.current is None


def cut(addon: ModuleType, obj: bpy.types.Object, recording: Any) -> None:
    part(addon, "edits.cutting").cut_out(obj, recording, 1.0, 3.0)


def pinned(addon: ModuleType, obj: bpy.types.Object, recording: Any) -> None:
    """A quarter of a metre aside at 3 s; the search plays controls alone."""
    pinning, recordings = part(addon, "edits.pinning"), part(addon, "recordings.recordings")
    recordings.set_asked(recording, recordings.Asked([], "", []))
    aside = part(addon, "edits.replaying").shown_poses(obj, recording).path[180] + (0.2, 0.15, 0.2)
    goal = pinning.Goal(3.0, 0.5, tuple(aside))
    pinning.keep_pins(obj, recording, [goal], pinning.prepare(obj, recording, [goal])(lambda *_: True))


@pytest.mark.parametrize("edit", [cut, pinned])
@pytest.mark.parametrize("begin", [0.0, 4.0])
def test_what_is_recorded_over_an_edited_recording_is_kept_as_it_was_shown(
    addon: ModuleType, session: ModuleType, obj: bpy.types.Object, edit: Any, begin: float
) -> None:
    recording, replaying = obj.fragmotion.recordings[0], part(addon, "edits.replaying")
    shown_of = part(addon, "recordings.recordings").shown_of
    edit(addon, obj, recording)
    before = shown_of(recording)[1]
    driven = driving.recorded(session).record_over(bpy.context, obj, recording, begin, begin + 2.5)
    seen = Seen(driven)
    seen.go_on(min(begin, 2.0))
    driven.inputs.keyboard.press("W")
    seen.go_on(5.0)
    session.stop()
    kept = shown_of(recording)[1]
    end, first = round(begin * driving.RATE), round(max(begin - 2.0, 0.0) * driving.RATE) + 1
    np.testing.assert_array_equal(kept.path[: end + 1], before.path[: end + 1])
    part_seen = slice(first, first + len(seen.frames))
    np.testing.assert_allclose(kept.path[part_seen], np.array(seen.frames), atol=NEAR)
    np.testing.assert_allclose(kept.root_positions[part_seen], seen.heads, atol=NEAR)
    character = part(addon, "character.building").load(obj)
    trace = part(addon, "recordings.recordings").trace_of(recording)
    played = replaying.replay(obj, character, recording, trace, recording.seed)
    assert begin == 0 or np.hypot(*(played.path[end] - kept.path[end])[:2]) > 2 * NEAR, "it is not what a replay shows"
