# SPDX-License-Identifier: MIT
"""Moves of an armature: in its list, in its character, and on keys."""

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

JUMP, STAND = "jump up", "stand"


def part(addon: ModuleType, name: str) -> Any:
    return import_module(f"{addon.__name__}.{name}")


def add(addon: ModuleType, obj: bpy.types.Object, action: str, frames: tuple[int, int] | None = None) -> Any:
    """A move of an Action of the sample."""
    moves = part(addon, "character.moves")
    return moves.add_move(bpy.context, obj, bpy.data.actions[action], frames, ["W", "R"])


def test_a_move_is_in_the_character_at_once(addon: ModuleType, obj: bpy.types.Object) -> None:
    building = part(addon, "character.building")
    before = building.load(obj)
    row = add(addon, obj, JUMP)
    assert (row.name, row.key, row.whole) == (JUMP, "F", True)
    character = building.load(obj)
    assert character.move_names == [JUMP]
    np.testing.assert_array_equal(character.table, before.table)
    assert len(character.moves[0].clip.root_positions) == pytest.approx(4 * 30 + 1, abs=1)


def test_a_move_may_be_some_frames_and_loop(addon: ModuleType, obj: bpy.types.Object) -> None:
    row = add(addon, obj, JUMP, (31, 91))
    row.loop, row.loop_first, row.loop_last, row.upper_body, row.wait = True, 46, 76, True, 1.5
    part(addon, "character.moves").bring_up_to_date(bpy.context, obj)
    move = part(addon, "character.building").load(obj).moves[0]
    assert len(move.clip.root_positions) == 61
    assert move.loop == pytest.approx((0.5, 1.5), abs=0.02)
    assert (move.upper_body, move.wait) == (True, 1.5)


@pytest.mark.thorough
def test_moves_outlast_a_build_saving_and_their_action(
    addon: ModuleType, obj: bpy.types.Object, tmp_path: Path
) -> None:
    add(addon, obj, JUMP).name = "leap"
    part(addon, "character.moves").bring_up_to_date(bpy.context, obj)
    assert bpy.ops.fragmotion.save_policy(filepath=str(tmp_path / "moves.policy")) == {"FINISHED"}
    clip = part(addon, "character.building").load(obj).moves[0].clip
    bpy.data.actions.remove(bpy.data.actions[JUMP])
    obj.fragmotion.build.synthesize = False
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    part(addon, "character.moves").bring_up_to_date(bpy.context, obj)
    kept = part(addon, "character.building").load(obj).moves
    assert [move.name for move in kept] == ["leap"]
    np.testing.assert_allclose(kept[0].clip.root_positions, clip.root_positions, atol=1e-3)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "kept.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "kept.blend"))
    obj = bpy.data.objects[making.ARMATURE]
    assert part(addon, "character.building").load(obj).move_names == ["leap"]


def test_a_policy_file_brings_its_moves(addon: ModuleType, obj: bpy.types.Object, tmp_path: Path) -> None:
    add(addon, obj, JUMP)
    bpy.ops.fragmotion.save_policy(filepath=str(tmp_path / "moves.policy"))
    bpy.ops.fragmotion.remove_move()
    assert not obj.fragmotion.moves
    assert part(addon, "character.building").load(obj).move_names == []
    assert bpy.ops.fragmotion.load_policy(filepath=str(tmp_path / "moves.policy")) == {"FINISHED"}
    assert [(row.name, row.key, row.action) for row in obj.fragmotion.moves] == [(JUMP, "F", None)]
    part(addon, "character.moves").bring_up_to_date(bpy.context, obj)
    assert part(addon, "character.building").load(obj).move_names == [JUMP]


@pytest.mark.parametrize(
    ("frames", "message"),
    [
        ((40, 40), "is of one frame"),
        ((40, 41), "a move lasts 0.1 s to 60 s"),
        ((900, 950), "has nothing from frame 900 to 950"),
    ],
)
def test_what_cannot_be_a_move_is_refused_and_nothing_changes(
    addon: ModuleType, obj: bpy.types.Object, frames: tuple[int, int], message: str
) -> None:
    add(addon, obj, STAND)
    data = obj.fragmotion.policy
    with pytest.raises(addon.errors.UserError, match=message):
        add(addon, obj, JUMP, frames)
    assert [row.name for row in obj.fragmotion.moves] == [STAND]
    assert obj.fragmotion.policy == data


def test_an_action_of_another_rig_and_a_long_one_are_refused(addon: ModuleType, obj: bpy.types.Object) -> None:
    bpy.data.actions.new("empty")
    with pytest.raises(addon.errors.UserError, match="belongs to another rig"):
        add(addon, obj, "empty")
    action = bpy.data.actions[STAND].copy()
    action.name = "long"
    action.use_frame_range, action.frame_end = True, action.frame_start + 61 * 30
    with pytest.raises(addon.errors.UserError, match=r"a move lasts 0.1 s to 60 s"):
        add(addon, obj, "long")
    assert not obj.fragmotion.moves


def test_two_moves_on_one_key_are_told_before_anything_is_driven(
    addon: ModuleType, session: ModuleType, obj: bpy.types.Object
) -> None:
    first, second = add(addon, obj, JUMP), add(addon, obj, STAND)
    first, second = obj.fragmotion.moves
    assert (first.key, second.key) == ("F", "G")
    second.key = "F"
    before = driving.everything(obj)
    with pytest.raises(addon.errors.UserError, match="moves 'jump up' and 'stand' are both on key F"):
        session.start(bpy.context, obj)
    second.key = "W"
    with pytest.raises(addon.errors.UserError, match="move 'stand' is on key W, which does 'forward' already"):
        session.start(bpy.context, obj)
    second.key, first.button, second.button = "G", "X", "X"
    with pytest.raises(addon.errors.UserError, match="are both on button X"):
        session.start(bpy.context, obj)
    assert session.current is None
    assert driving.everything(obj) == before


def test_a_key_starts_a_move_and_a_recording_keeps_it(
    addon: ModuleType, session: ModuleType, obj: bpy.types.Object
) -> None:
    add(addon, obj, JUMP)
    driven = driving.start(session, obj)
    driving.go_on(driven, 0.5)
    driven.toggle_recording()
    driving.go_on(driven, 1)
    driven.inputs.keyboard.press("F")
    driving.go_on(driven, 0.05)
    driven.inputs.keyboard.let_go("F")
    heights = []
    for _ in range(240):
        driving.go_on(driven, 1 / 60)
        heights.append(driving.hips(obj)[2])
    assert max(heights) > 1.2, "it leapt"
    driven.toggle_recording()
    recording = obj.fragmotion.recordings[0]
    session.stop()
    recordings = part(addon, "recordings.recordings")
    (move,) = recordings.moves_of(recording)
    assert (move.control, move.name, move.held) == (10, JUMP, 1)
    assert_replays(addon, session, obj, recording)


def assert_replays(addon: ModuleType, session: ModuleType, obj: bpy.types.Object, recording: Any) -> None:
    """A replay, and the core's player, show what was recorded."""
    recordings = part(addon, "recordings.recordings")
    _, shown = recordings.shown_of(recording)
    building = part(addon, "character.building")
    player = building.make_player(obj, building.load(obj), recording.seed, recording.policy)
    player.reset(*recording.start)
    moves = recordings.numbered_moves(recording, [JUMP])
    ran = player.run(recordings.trace_of(recording), 60, moves=moves)
    count = min(len(ran.root_positions), len(shown.root_positions))
    np.testing.assert_allclose(ran.root_positions[:count], shown.root_positions[:count], atol=1e-5)
    again = driving.recorded(session).replay(bpy.context, obj, recording)
    roots = []
    for _ in range(count - 2):
        driving.go_on(again, 1 / 60)
        roots.append(driving.hips(obj))
    session.stop()
    np.testing.assert_allclose(np.array(roots)[:, 2], shown.root_positions[1 : count - 1, 2], atol=0.02)


def test_a_bake_plays_a_recordings_moves(addon: ModuleType, obj: bpy.types.Object) -> None:
    add(addon, obj, JUMP)
    recordings = part(addon, "recordings.recordings")
    trace = np.zeros((40, 4))
    recordings.add_recording(obj, trace, name="Leap", moves=[recordings.StartedMove(5, JUMP, 1)])
    settings = obj.fragmotion.bake
    settings.trace_source, settings.as_recorded = "RECORDING", False
    assert bpy.ops.fragmotion.bake("EXEC_DEFAULT") == {"FINISHED"}
    heights = []
    for frame in range(1, 110):
        bpy.context.scene.frame_set(frame)
        heights.append(driving.hips(obj)[2])
    assert max(heights) > 1.2
    obj.fragmotion.moves[0].name = "other"
    with pytest.raises(RuntimeError, match="starts the move 'jump up', which the character does not have"):
        bpy.ops.fragmotion.bake("EXEC_DEFAULT")


def test_recordings_keep_their_moves_when_they_are_trimmed_and_copied(addon: ModuleType, obj: bpy.types.Object) -> None:
    recordings = part(addon, "recordings.recordings")
    started = [recordings.StartedMove(5, "a", 1), recordings.StartedMove(20, "b", 3)]
    recording = recordings.add_recording(obj, np.zeros((40, 4)), moves=started)
    recordings.trim_recording(recording, 1, 3)
    assert recordings.moves_of(recording) == [recordings.StartedMove(10, "b", 3)]
    assert recordings.moves_of(recordings.duplicate_recording(obj, 0)) == [recordings.StartedMove(10, "b", 3)]


def test_a_glued_recording_asks_for_what_both_asked_for(addon: ModuleType, obj: bpy.types.Object) -> None:
    add(addon, obj, JUMP)
    recordings, styles = part(addon, "recordings.recordings"), part(addon, "recordings.styles")
    trace = np.zeros((40, 4))
    first = recordings.add_recording(
        obj, trace, moves=[recordings.StartedMove(5, JUMP, 1)], styles=[styles.StyleChange(30, "tired")]
    )
    recordings.add_recording(
        obj, trace, moves=[recordings.StartedMove(20, JUMP, 3)], style="proud", styles=[styles.StyleChange(9, "tired")]
    )
    seam = part(addon, "edits.cutting").append(obj, obj.fragmotion.recordings[0], obj.fragmotion.recordings[1])
    moved = seam.end - seam.beginning
    first = obj.fragmotion.recordings[0]
    assert recordings.moves_of(first) == [
        recordings.StartedMove(5, JUMP, 1),
        recordings.StartedMove(20 + moved, JUMP, 3),
    ]
    assert recordings.styles_of(first) == [(30, "tired"), (seam.end, "proud"), (9 + moved, "tired")]


def test_a_cut_takes_out_the_moves_of_its_stretch(addon: ModuleType, obj: bpy.types.Object) -> None:
    add(addon, obj, JUMP)
    recordings = part(addon, "recordings.recordings")
    started = [recordings.StartedMove(at, JUMP, 1) for at in (2, 20, 38)]
    recording = recordings.add_recording(obj, np.zeros((40, 4)), moves=started)
    seam = part(addon, "edits.cutting").cut_out(obj, recording, 1.5, 2.5)
    assert recordings.moves_of(recording) == [
        recordings.StartedMove(2, JUMP, 1),
        recordings.StartedMove(38 - (seam.beginning - seam.end), JUMP, 1),
    ]


def test_playing_again_plays_the_moves_and_a_pin_says_that_it_cannot(addon: ModuleType, obj: bpy.types.Object) -> None:
    add(addon, obj, JUMP)
    recordings, replaying = part(addon, "recordings.recordings"), part(addon, "edits.replaying")
    recording = recordings.add_recording(obj, np.zeros((40, 4)), moves=[recordings.StartedMove(5, JUMP, 1)])
    character = part(addon, "character.building").load(obj)
    shown = replaying.replay(obj, character, recording, np.zeros((40, 4)), 1)
    assert shown.root_positions[:, 2].max() > 1.2
    pinning = part(addon, "edits.pinning")
    with pytest.raises(addon.errors.UserError, match=r"starts the move 'jump up' 0\.5 s after its beginning"):
        pinning.prepare(obj, recording, [pinning.Goal(3.0, 1.0, (0.0, 0.0, 0.0))])
    assert pinning.prepare(obj, recording, [pinning.Goal(0.4, 0.0, (0.0, 0.0, 0.0))])


@pytest.mark.parametrize(
    "forged",
    [
        *("nonsense", "5", "[[1]]", '[["1", "a", 2]]', "[[1, 2, 3]]", '[[99, "a", 1]]', '[[1, "a", -1]]', "{}{"),
        *making.OTHER_JSON,
    ],
)
def test_forged_moves_of_a_recording_are_refused(addon: ModuleType, obj: bpy.types.Object, forged: str) -> None:
    recordings = part(addon, "recordings.recordings")
    recording = recordings.add_recording(obj, np.zeros((40, 4)))
    recording.moves = forged
    with pytest.raises(addon.errors.UserError, match="is damaged"):
        recordings.moves_of(recording)


def test_the_display_names_the_move(addon: ModuleType, session: ModuleType, obj: bpy.types.Object) -> None:
    add(addon, obj, JUMP)
    driven = driving.start(session, obj)
    driven.inputs.keyboard.press("F")
    driving.go_on(driven, 0.7)
    assert driven.move == JUMP
    rows = part(addon, "drive.hud.figures").rows(driven.shown())
    assert ("Move", JUMP) in rows


def test_a_removed_move_is_gone_from_the_character(addon: ModuleType, obj: bpy.types.Object) -> None:
    assert bpy.ops.fragmotion.remove_move.poll() is False
    add(addon, obj, JUMP)
    assert bpy.ops.fragmotion.remove_move.poll()
    assert bpy.ops.fragmotion.remove_move() == {"FINISHED"}
    assert part(addon, "character.building").load(obj).move_names == []
