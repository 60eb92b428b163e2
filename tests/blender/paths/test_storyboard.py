# SPDX-License-Identifier: MIT
"""A storyboard: places by frames, with a style, a move and a look each, as one recording, changed entry by entry."""

from __future__ import annotations

import math
from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import making
import numpy as np
import pytest

FIRST = 1


@pytest.fixture(scope="module")
def built(addon: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The sample file after Build, with its moves and styles, saved."""
    making.open_sample()
    for action in bpy.data.actions:
        if action.name.startswith("tired"):
            action.fragmotion.use, action.fragmotion.style = True, "tired"
        elif action.fragmotion.use:
            action.fragmotion.style = "plain"
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    path = tmp_path_factory.mktemp("built") / "built.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


def add(obj: bpy.types.Object, place: tuple[float, float] | None, frame: int, **fields: Any) -> Any:
    """An entry, by the add-on's own button."""
    bpy.context.scene.cursor.location = (*(place or (0, 0)), 0)
    assert bpy.ops.fragmotion.add_beat() == {"FINISHED"}
    beat = obj.fragmotion.story[-1]
    beat.frame = frame
    if place is None:
        beat.place = None
    for name, value in fields.items():
        setattr(beat, name, value)
    bpy.context.view_layer.update()
    return beat


def test_a_new_place_is_selected_to_be_moved(obj: bpy.types.Object) -> None:
    beat = add(obj, (1, 2), 49)
    assert bpy.context.selected_objects == [beat.place]
    assert bpy.context.view_layer.objects.active == obj


def test_a_new_place_has_time_to_be_walked_to(addon: ModuleType, obj: bpy.types.Object) -> None:
    start, fps = addon.bake.performing.origin_frame(obj), bpy.context.scene.render.fps
    frames = [obj.fragmotion.bake.frame_start]
    for x, y in ((0.5, 0), (6, 0), (6, 8)):
        bpy.context.scene.cursor.location = (start[0] + x, start[1] + y, 0)
        assert bpy.ops.fragmotion.add_beat() == {"FINISHED"}
        bpy.context.view_layer.update()
        frames.append(obj.fragmotion.story[-1].frame)
    walk = addon.character.building.load(obj).space.walk
    near, far, farther = (seconds / fps for seconds in np.diff(frames))
    assert near == 2 and 5.5 / walk < far < 5.5 / walk + 1 and 8 / walk < farther < 8 / walk + 1
    shown, told = addon.edits.storyboard.record(bpy.context, obj)
    assert shown.seconds > near + far + farther - 1 and told == []


def record(addon: ModuleType, obj: bpy.types.Object) -> tuple[Any, Any]:
    """The recording, and what it shows."""
    assert bpy.ops.fragmotion.record_story() == {"FINISHED"}
    recording = obj.fragmotion.recordings["Storyboard"]
    return recording, addon.recordings.recordings.shown_of(recording)[1]


def at(shown: Any, frame: int) -> np.ndarray:
    """The place on a scene frame."""
    scene = bpy.context.scene
    place: np.ndarray = shown.path[round((frame - FIRST) * 60 * scene.render.fps_base / scene.render.fps)][:2]
    return place


def names(addon: ModuleType, obj: bpy.types.Object) -> list[str]:
    return list(addon.character.building.load(obj).move_names)


def test_it_is_at_the_places_by_the_frames_and_does_the_moves_there(addon: ModuleType, obj: bpy.types.Object) -> None:
    door, chair = (0.5, -4.0), (-2.0, -6.0)
    add(obj, door, 121, move="wave")
    add(obj, chair, 271, move="sit", style="tired")
    recording, shown = record(addon, obj)
    assert math.dist(at(shown, 121), door) < 0.3
    assert math.dist(at(shown, 271), chair) < 0.3
    assert abs(shown.path[0][:2]).max() < 1e-6
    recordings = addon.recordings.recordings
    (wave, sit) = recordings.moves_of(recording)
    fps = bpy.context.scene.render.fps
    assert (wave.name, sit.name) == ("wave", "sit")
    assert wave.control == pytest.approx(10 * 120 / fps, abs=1)
    assert sit.control == pytest.approx(10 * 270 / fps, abs=5)
    assert sit.control + sit.held == len(recordings.trace_of(recording))
    assert [change.name for change in recordings.styles_of(recording)] == ["tired"]
    assert shown.root_positions[-1, 2] < shown.root_positions[0, 2] - 0.2  # it sits
    replay = addon.edits.replaying.replay(
        obj, addon.character.building.load(obj), recording, recordings.trace_of(recording), recording.seed
    )
    np.testing.assert_allclose(replay.path, shown.path, atol=1e-5)


def test_an_entry_changes_the_same_recording_and_its_bake(addon: ModuleType, obj: bpy.types.Object) -> None:
    beat = add(obj, (0.0, -3.0), 91)
    recording, before = record(addon, obj)
    assert bpy.ops.fragmotion.bake("EXEC_DEFAULT") == {"FINISHED"}
    beat.place.location = (2.0, -3.0, 0.0)
    bpy.context.view_layer.update()
    recording, after = record(addon, obj)
    assert len(obj.fragmotion.recordings) == 1
    assert math.dist(at(after, 91), (2.0, -3.0)) < 0.3 < math.dist(at(before, 91), (2.0, -3.0))
    assert addon.recordings.recordings.is_bake_stale(recording)
    assert bpy.ops.fragmotion.bake("EXEC_DEFAULT", update=True) == {"FINISHED"}
    assert not addon.recordings.recordings.is_bake_stale(obj.fragmotion.recordings["Storyboard"])


def test_a_recording_that_has_its_name_stays(addon: ModuleType, obj: bpy.types.Object) -> None:
    own = addon.recordings.recordings.add_recording(obj, np.zeros((20, 4)), name="Storyboard")
    trace = addon.recordings.recordings.trace_of(own)
    add(obj, (0.0, -3.0), 91)
    for _ in range(2):
        assert bpy.ops.fragmotion.record_story() == {"FINISHED"}
        assert [each.name for each in obj.fragmotion.recordings] == ["Storyboard", "Storyboard.001"]
        assert obj.fragmotion.active_recording == 1
    np.testing.assert_array_equal(addon.recordings.recordings.trace_of(obj.fragmotion.recordings[0]), trace)


def test_a_move_with_a_loop_is_held_until_it_must_leave(addon: ModuleType, obj: bpy.types.Object) -> None:
    add(obj, None, 31, move="sit")
    add(obj, (0.0, -3.0), 331)
    _, shown = record(addon, obj)
    assert at(shown, 200) == pytest.approx(at(shown, 40), abs=0.5)
    assert math.dist(at(shown, 331), (0.0, -3.0)) < 0.3


def test_it_looks_at_what_an_entry_says(addon: ModuleType, obj: bpy.types.Object) -> None:
    beat = add(obj, (0.0, -3.0), 91)
    beat.look.kind, beat.look.object = "OBJECT", bpy.data.objects.new("Sign", None)
    add(obj, None, 121)
    recording, _ = record(addon, obj)
    looks = addon.recordings.recordings.looks_of(recording)
    assert [(look.control, look.look) for look in looks] == [(0, 2), (pytest.approx(30, abs=6), 0)]


def test_what_cannot_be_done_in_time_is_told(
    addon: ModuleType, obj: bpy.types.Object, capsys: pytest.CaptureFixture[str]
) -> None:
    add(obj, (0.0, -30.0), 31)
    _, shown = record(addon, obj)
    assert "give it more time" in capsys.readouterr().out
    assert math.dist(shown.path[-1][:2], (0.0, -30.0)) < 0.4


@pytest.mark.parametrize(
    ("change", "why"),
    [
        ({"frame": 0}, "before frame 1, where Bake begins"),
        ({"move": "dance"}, "asks for the move 'dance'"),
        ({"style": "odd"}, "asks for the style 'odd'"),
    ],
)
def test_what_is_not_there_is_refused(
    addon: ModuleType, obj: bpy.types.Object, change: dict[str, Any], why: str
) -> None:
    add(obj, (0.0, -2.0), **{"frame": 61, **change})
    with pytest.raises(RuntimeError, match=why):
        bpy.ops.fragmotion.record_story()
    assert not len(obj.fragmotion.recordings)


def test_an_empty_storyboard_is_refused_and_entries_can_be_removed(addon: ModuleType, obj: bpy.types.Object) -> None:
    with pytest.raises(RuntimeError, match="is empty"):
        bpy.ops.fragmotion.record_story()
    add(obj, (0.0, -2.0), 61)
    add(obj, (0.0, -4.0), 121)
    obj.fragmotion.active_beat = 0
    assert bpy.ops.fragmotion.remove_beat() == {"FINISHED"}
    assert [beat.frame for beat in obj.fragmotion.story] == [121]
    assert "Place 1" in bpy.data.objects
