# SPDX-License-Identifier: MIT
"""Trace files that ask for moves and styles: written, read, baked and played."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import driving
import making
import numpy as np
import pytest

TIRED = 2
HEADER = "velocity_x,velocity_y,turn,jump"
WALK = (0.0, 1.0, 0.0, 0.0)


@pytest.fixture(scope="module")
def styled(addon: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The sample file after Build with the takes of all its styles, saved."""
    making.open_sample()
    assert bpy.ops.fragmotion.tick_actions(use=True) == {"FINISHED"}
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=24) == {"FINISHED"}
    addon.character.moves.bring_up_to_date(bpy.context, bpy.context.view_layer.objects.active)
    path = tmp_path_factory.mktemp("styled") / "styled.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


@pytest.fixture
def obj(addon: ModuleType, styled: Path) -> Iterator[bpy.types.Object]:
    """The armature in that file, active."""
    addon.character.building.forget()
    bpy.ops.wm.open_mainfile(filepath=str(styled))
    return bpy.context.view_layer.objects.active


def record(addon: ModuleType, obj: bpy.types.Object) -> Any:
    """A recording of four seconds of a walk that begins proud, becomes tired, and with moves at the same time."""
    recordings = addon.recordings.recordings
    started = [recordings.StartedMove(5, "wave", 12), recordings.StartedMove(10, "kick", 1)]
    changes = [addon.recordings.styles.StyleChange(25, "tired")]
    trace = np.tile(np.array(WALK), (40, 1))
    return recordings.add_recording(
        obj,
        trace,
        name="Asks",
        moves=started,
        style="proud",
        styles=changes,
        looks=[addon.recordings.looks.LookChange(12, 2, 0.5, -3.0, 1.25)],
        reaches=[
            addon.recordings.reaches.ReachChange(8, 1, 0.75, 1, 0.25, 0.5, 1.25),
            addon.recordings.reaches.ReachChange(20, 1, 0.0, 1, 0.25, 0.5, 1.25),
        ],
    )


def write(path: Path, *rows: str, columns: str = "move,style") -> str:
    """A trace file of these rows' moves and styles, at a walk."""
    path.write_text("\n".join([f"{HEADER},{columns}", *(f"0,1,0,0,{row}" for row in rows)]))
    return str(path)


def keys_of(obj: bpy.types.Object, versions: Any, **fields: Any) -> dict[tuple[str, int], np.ndarray]:
    """What a bake writes."""
    obj.fragmotion.bake.as_recorded = False
    assert bpy.ops.fragmotion.bake("EXEC_DEFAULT", **fields) == {"FINISHED"}
    curves = versions.curves_of(obj.animation_data.action, obj)
    return {(c.data_path, c.array_index): np.array([key.co[:] for key in c.keyframe_points]) for c in curves}


def test_moves_and_styles_go_out_to_csv_and_come_back(addon: ModuleType, obj: bpy.types.Object, tmp_path: Path) -> None:
    recordings, recording = addon.recordings.recordings, record(addon, obj)
    asked = recordings.asked_of(recording)
    assert bpy.ops.fragmotion.export_recording(filepath=str(tmp_path / "asks")) == {"FINISHED"}
    lines = (tmp_path / "asks.csv").read_text().splitlines()
    assert lines[0] == f"{HEADER},move,move,style,look,right_hand"
    assert lines[1 + 10] == "0,1,0,0,wave,kick,proud,,0.75 with 0.25 0.5 1.25"
    assert lines[1 + 30] == "0,1,0,0,,,tired,at 0.5 -3 1.25,0 with 0.25 0.5 1.25"
    assert bpy.ops.fragmotion.import_recordings(filepath=str(tmp_path / "asks.csv")) == {"FINISHED"}
    read = obj.fragmotion.recordings[-1]
    assert recordings.asked_of(read) == asked and read.quality > 0
    np.testing.assert_array_equal(recordings.trace_of(read), np.tile(np.array(WALK), (40, 1)))


def test_a_bake_of_a_file_plays_its_moves_and_styles(addon: ModuleType, obj: bpy.types.Object, tmp_path: Path) -> None:
    record(addon, obj)
    path, versions = str(tmp_path / "asks.csv"), addon.compat.versions
    assert bpy.ops.fragmotion.export_recording(filepath=path) == {"FINISHED"}
    by_recording = keys_of(obj, versions, trace_source="RECORDING")
    by_file = keys_of(obj, versions, trace_source="FILE", trace_file=path)
    assert by_recording.keys() == by_file.keys()
    for curve, keys in by_file.items():
        np.testing.assert_array_equal(keys, by_recording[curve])


def test_a_file_without_a_style_begins_in_that_of_the_bake(
    addon: ModuleType, obj: bpy.types.Object, tmp_path: Path
) -> None:
    path, versions = write(tmp_path / "walk.csv", *["wave"] * 30, columns="move"), addon.compat.versions
    told = write(tmp_path / "told.csv", "wave,tired", *["wave,"] * 29)
    fields = {"trace_source": "FILE", "style": "tired"}
    by_field, by_file = (keys_of(obj, versions, **fields, trace_file=each) for each in (path, told))
    plain = keys_of(obj, versions, trace_source="FILE", trace_file=path)
    assert all(np.array_equal(keys, by_file[curve]) for curve, keys in by_field.items())
    assert not all(np.array_equal(keys, plain[curve]) for curve, keys in by_field.items())


def test_what_the_character_does_not_have_is_told(
    addon: ModuleType, obj: bpy.types.Object, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    path = write(tmp_path / "asks.csv", ",", "wave,", "wave,", "juggle,", ",")
    with pytest.raises(RuntimeError, match=r"asks\.csv', line 5, starts the move 'juggle', which the character does"):
        bpy.ops.fragmotion.bake("EXEC_DEFAULT", trace_source="FILE", trace_file=path)
    path = write(tmp_path / "asks.csv", ",", ",happy", ",")
    assert bpy.ops.fragmotion.bake("EXEC_DEFAULT", trace_source="FILE", trace_file=path) == {"FINISHED"}
    assert "without style 'happy', which the character does not have" in capfd.readouterr().out


def test_a_file_is_played_while_driving(
    addon: ModuleType, session: ModuleType, obj: bpy.types.Object, tmp_path: Path
) -> None:
    driven = driving.start(session, obj)
    settings = obj.fragmotion.drive
    rows = ["wave,tired", *["wave,"] * 19, *[",proud"] * 20]
    settings.trace_source, settings.trace_file = "FILE", write(tmp_path / "asks.csv", *rows)
    assert bpy.ops.fragmotion.play_trace() == {"FINISHED"}
    driving.go_on(driven, 1.8)
    wave = driven.actor.character.move_names.index("wave")
    assert driven.player.playing_style == TIRED and wave in driven.player.playing_moves
    driving.go_on(driven, 2)
    assert driven.player.playing_style == TIRED - 1
    settings.trace_file = write(tmp_path / "asks.csv", *["juggle,"] * 3)
    with pytest.raises(RuntimeError, match="line 2, starts the move 'juggle'"):
        bpy.ops.fragmotion.play_trace()
