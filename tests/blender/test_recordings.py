# SPDX-License-Identifier: MIT
"""Recordings stay with their armature, to the bit, whatever is done to the file."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import making
import numpy as np
import pytest


def make_trace(length: int = 50, seed: int = 1) -> np.ndarray:
    """A trace whose numbers have no short decimal form."""
    trace = making.waves(length, 4, seed)
    trace[:, 3] = np.abs(trace[:, 3])
    return trace


@pytest.fixture
def obj(addon: ModuleType) -> bpy.types.Object:
    """An armature with two recordings."""
    armature = making.add_armature()
    addon.recordings.recordings.add_recording(
        armature, make_trace(), name="Stroll", seed=7, policy="svm", start=(1, 2, 0.5), quality=0.75
    )
    addon.recordings.recordings.add_recording(armature, make_trace(120, 2)).train = True
    return armature


def assert_kept(addon: ModuleType, obj: bpy.types.Object) -> None:
    """The armature has the fixture's recordings."""
    stroll, other = obj.fragmotion.recordings
    assert (stroll.name, stroll.seed, stroll.policy, tuple(stroll.start)) == ("Stroll", 7, "svm", (1, 2, 0.5))
    assert (stroll.seconds, stroll.quality, stroll.train) == (5, 0.75, False)
    assert (other.name, other.seconds, other.train) == ("Recording", 12, True)
    np.testing.assert_array_equal(addon.recordings.recordings.trace_of(stroll), make_trace())
    np.testing.assert_array_equal(addon.recordings.recordings.trace_of(other), make_trace(120, 2))
    assert addon.recordings.recordings.trained_on(obj) == [other]
    assert addon.recordings.recordings.active_recording(obj) == other


def append(path: Path, link: bool) -> bpy.types.Object:
    """The file's only armature, appended or linked into an empty file."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    with bpy.data.libraries.load(str(path), link=link) as (_, wanted):
        wanted.objects = ["Rig"]
    bpy.context.scene.collection.objects.link(wanted.objects[0])
    return wanted.objects[0]


def test_recordings_survive_saving_and_loading(addon: ModuleType, obj: bpy.types.Object, tmp_path: Path) -> None:
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "kept.blend"))
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "kept.blend"))
    assert_kept(addon, bpy.data.objects["Rig"])


def test_recordings_survive_append_and_making_a_link_local(
    addon: ModuleType, obj: bpy.types.Object, tmp_path: Path
) -> None:
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "kept.blend"))
    assert_kept(addon, append(tmp_path / "kept.blend", link=False))
    linked = append(tmp_path / "kept.blend", link=True)
    assert_kept(addon, linked)
    assert_kept(addon, linked.make_local())


def test_recordings_survive_a_renamed_armature_and_go_with_its_copy(addon: ModuleType, obj: bpy.types.Object) -> None:
    obj.name = obj.data.name = "Hero"
    assert_kept(addon, obj)
    copy = obj.copy()
    assert_kept(addon, copy)
    copy.fragmotion.recordings.remove(0)
    assert_kept(addon, obj)
    making.activate(obj)
    assert bpy.ops.object.duplicate() == {"FINISHED"}
    assert_kept(addon, bpy.context.active_object)


def test_recordings_survive_undo_and_redo(addon: ModuleType, obj: bpy.types.Object) -> None:
    bpy.ops.ed.undo_push(message="two recordings")
    trace = make_trace(3)  # once: NumPy's sine of a few numbers may differ by a bit from call to call
    addon.recordings.recordings.add_recording(obj, trace)
    bpy.ops.ed.undo_push(message="three recordings")
    bpy.ops.ed.undo()
    assert_kept(addon, bpy.data.objects["Rig"])
    bpy.ops.ed.redo()
    recordings = bpy.data.objects["Rig"].fragmotion.recordings
    assert [each.name for each in recordings] == ["Stroll", "Recording", "Recording.001"]
    np.testing.assert_array_equal(addon.recordings.recordings.trace_of(recordings[2]), trace)


@pytest.mark.parametrize(
    "trace",
    [np.zeros((0, 4)), np.zeros((5, 3)), np.zeros(4), [[0, np.nan, 0, 0]], [[0, 1, 7, 0]], [[0, 1, 0, -0.1]]],
)
def test_what_is_no_trace_is_refused_and_changes_nothing(addon: ModuleType, obj: bpy.types.Object, trace: Any) -> None:
    with pytest.raises(addon.errors.UserError, match="A recording"):
        addon.recordings.recordings.add_recording(obj, trace)
    with pytest.raises(addon.errors.UserError, match="A recording"):
        addon.recordings.recordings.set_trace(obj.fragmotion.recordings[0], trace)
    assert_kept(addon, obj)


@pytest.mark.parametrize(
    "damage", [b"", b"not packed", lambda data: data[:-6], lambda data: data[:9] + b"?" + data[10:]]
)
def test_a_damaged_recording_says_so(addon: ModuleType, obj: bpy.types.Object, damage: Any) -> None:
    recording = obj.fragmotion.recordings[0]
    recording.controls = damage(recording.controls) if callable(damage) else damage
    with pytest.raises(addon.errors.UserError, match="Recording 'Stroll' is damaged: delete it"):
        addon.recordings.recordings.trace_of(recording)


def press(name: str, **fields: Any) -> None:
    """A button of the Recordings panel, as one undo step."""
    assert getattr(bpy.ops.fragmotion, name)("EXEC_DEFAULT", True, **fields) == {"FINISHED"}


def recordings() -> Any:
    """The recordings of the armature that is there after undo, too."""
    return bpy.data.objects["Rig"].fragmotion.recordings


def test_recordings_are_duplicated_and_deleted_and_that_is_undone(addon: ModuleType, obj: bpy.types.Object) -> None:
    obj.fragmotion.active_recording = 0
    bpy.ops.ed.undo_push(message="two recordings")
    press("duplicate_recording")
    assert [each.name for each in recordings()] == ["Stroll", "Stroll.001", "Recording"]
    assert bpy.data.objects["Rig"].fragmotion.active_recording == 1
    original, copy = recordings()[:2]
    for field in ("date", "seconds", "quality", "policy", "seed", "train", "controls"):
        assert getattr(copy, field) == getattr(original, field)
    assert tuple(copy.start) == tuple(original.start)
    press("delete_recording")
    press("delete_recording")
    assert [each.name for each in recordings()] == ["Stroll"]
    press("delete_recording")
    assert not recordings() and not bpy.ops.fragmotion.delete_recording.poll()
    for names in (["Stroll"], ["Stroll", "Recording"], ["Stroll", "Stroll.001", "Recording"], ["Stroll", "Recording"]):
        bpy.ops.ed.undo()
        assert [each.name for each in recordings()] == names
    bpy.data.objects["Rig"].fragmotion.active_recording = 1
    assert_kept(addon, bpy.data.objects["Rig"])


def test_trimming_keeps_the_controls_between_start_and_end(addon: ModuleType, obj: bpy.types.Object) -> None:
    bpy.ops.ed.undo_push(message="two recordings")
    press("trim_recording", start=2.04, end=7.96)
    assert recordings()[1].seconds == pytest.approx(6)
    np.testing.assert_array_equal(addon.recordings.recordings.trace_of(recordings()[1]), make_trace(120, 2)[20:80])
    press("trim_recording", start=0, end=100)
    assert recordings()[1].seconds == pytest.approx(6)
    with pytest.raises(RuntimeError, match=r"'Recording' lasts 6.0 s: nothing is left between 6.5 s and 7.0 s"):
        bpy.ops.fragmotion.trim_recording(start=6.5, end=7)
    bpy.ops.ed.undo()
    bpy.ops.ed.undo()
    assert_kept(addon, bpy.data.objects["Rig"])


def test_what_was_shown_survives_saving_and_is_trimmed_with_its_recording(
    addon: ModuleType, obj: bpy.types.Object, tmp_path: Path
) -> None:
    random = np.random.default_rng(3)
    times = np.arange(150) / 30
    motion = addon.rig.motion.Motion(
        random.normal(size=(150, 3)), random.normal(size=(150, 7, 4)), random.normal(size=(150, 3)), np.arange(150)
    )
    addon.recordings.recordings.add_recording(obj, make_trace(), name="Seen", shown=(times, motion))
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "kept.blend"))
    recording = append(tmp_path / "kept.blend", link=False).fragmotion.recordings["Seen"]

    def assert_shown(first: int, last: int) -> None:
        seen, shown = addon.recordings.recordings.shown_of(recording)
        np.testing.assert_allclose(seen, times[: last - first], atol=1e-6)
        for given, back in zip(motion, shown):
            np.testing.assert_allclose(back, given[first:last], atol=1e-6)

    assert_shown(0, 150)
    addon.recordings.recordings.trim_recording(recording, 1, 3)
    assert_shown(30, 91)
    assert tuple(recording.start) == pytest.approx(tuple(motion.path[30]), abs=1e-6)
    recording.shown = recording.shown[:-3]
    with pytest.raises(addon.errors.UserError, match="'Seen' is damaged"):
        addon.recordings.recordings.shown_of(recording)


def test_recordings_go_out_to_csv_and_come_back_to_the_bit(
    addon: ModuleType, obj: bpy.types.Object, tmp_path: Path
) -> None:
    for index, name in enumerate(("one", "two")):
        obj.fragmotion.active_recording = index
        assert bpy.ops.fragmotion.export_recording(filepath=str(tmp_path / name)) == {"FINISHED"}
    assert (tmp_path / "one.csv").read_text().startswith("velocity_x,velocity_y,turn,jump\n")
    addon.recordings.recordings.add_recording(obj, make_trace(1))
    with pytest.raises(RuntimeError, match=r"'Recording\.001' holds a single control"):
        bpy.ops.fragmotion.export_recording(filepath=str(tmp_path / "three"))
    assert not (tmp_path / "three.csv").exists()
    addon.recordings.recordings.remove_recording(obj, 2)
    bpy.ops.ed.undo_push(message="two recordings")
    press("import_recordings", directory=str(tmp_path), files=[{"name": "one.csv"}, {"name": "two.csv"}])
    assert [each.name for each in recordings()] == ["Stroll", "Recording", "one", "two"]
    np.testing.assert_array_equal(addon.recordings.recordings.trace_of(recordings()[2]), make_trace())
    np.testing.assert_array_equal(addon.recordings.recordings.trace_of(recordings()[3]), make_trace(120, 2))
    press("import_recordings", filepath=str(tmp_path / "one.csv"))
    assert recordings()[4].name == "one.001"
    bpy.ops.ed.undo()
    bpy.ops.ed.undo()
    assert_kept(addon, bpy.data.objects["Rig"])


@pytest.mark.parametrize(
    ("text", "cause"),
    [
        ("velocity_x,velocity_y,turn\n0,0,0\n", r"bad\.csv:1: the header is"),
        ("velocity_x,velocity_y,turn,jump\n0,1,0,0\n0,1,0\n", r"bad\.csv:3: expected 4 values"),
        ("velocity_x,velocity_y,turn,jump\n0,1,7,0\n", r"bad\.csv:2: turn is"),
        ('velocity_x,velocity_y,turn,jump,move\n0,1,0,0,\n0,1,0,0,"wave\n', r"bad\.csv:3: quotes are not closed"),
    ],
)
def test_a_malformed_file_among_those_imported_is_named_by_its_line_and_none_is_kept(
    addon: ModuleType, obj: bpy.types.Object, tmp_path: Path, text: str, cause: str
) -> None:
    (tmp_path / "good.csv").write_text("velocity_x,velocity_y,turn,jump\n0,1,0,0\n0,1,0,0\n")
    (tmp_path / "bad.csv").write_text(text)
    with pytest.raises(RuntimeError, match=cause):
        bpy.ops.fragmotion.import_recordings(directory=str(tmp_path), files=[{"name": "good.csv"}, {"name": "bad.csv"}])
    with pytest.raises(RuntimeError, match="No file is chosen"):
        bpy.ops.fragmotion.import_recordings(filepath="")
    assert_kept(addon, obj)


def test_build_learns_from_the_ticked_recordings(
    addon: ModuleType, obj: bpy.types.Object, monkeypatch: pytest.MonkeyPatch
) -> None:
    for seed in range(3):
        making.add_action(obj, 60, seed=seed, name=f"mocap {seed}").fragmotion.use = True
    given = []
    build = addon.character.building.core.build

    def spy(skeleton: object, clips: object, traces: list[np.ndarray], *others: object) -> object:
        given.extend(traces)
        return build(skeleton, clips, traces, *others)

    monkeypatch.setattr(addon.character.building.core, "build", spy)
    fields = {"trace_source": "RECORDINGS", "classes": 6, "mirror": False, "synthesize": False}
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", **fields) == {"FINISHED"}
    assert len(given) == 1
    np.testing.assert_array_equal(given[0], make_trace(120, 2))
    obj.fragmotion.recordings[0].train = True
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", **fields) == {"FINISHED"}
    np.testing.assert_array_equal(given[1], make_trace())
    np.testing.assert_array_equal(given[2], make_trace(120, 2))
    for recording in obj.fragmotion.recordings:
        recording.train = False
    with pytest.raises(RuntimeError, match="No recording of armature 'Rig' is ticked to train on"):
        bpy.ops.fragmotion.build("EXEC_DEFAULT", **fields)


def test_the_buttons_of_recordings_say_why_they_are_grey() -> None:
    names = ("delete_recording", "duplicate_recording", "trim_recording", "export_recording")
    assert not any(getattr(bpy.ops.fragmotion, name).poll() for name in (*names, "import_recordings"))
    making.add_armature()
    for name in names:
        with pytest.raises(RuntimeError, match="'Rig' has no recordings: record or import one"):
            getattr(bpy.ops.fragmotion, name)()
    assert bpy.ops.fragmotion.import_recordings.poll()


@pytest.mark.parametrize(
    "text", ["{}", '{"a": 1}', '""', '"ab"', "5", "null", "[5]", "[{}]", '["ab", "abc"]', "[" * 100_000]
)
def test_json_of_another_shape_is_damage(addon: ModuleType, text: str) -> None:
    recordings = addon.recordings.recordings
    recording = recordings.add_recording(making.add_armature(), np.zeros((9, 4)))
    recording.moves = recording.styles = text
    for read in (recordings.moves_of, recordings.styles_of):
        with pytest.raises(addon.errors.UserError, match="is damaged"):
            read(recording)
