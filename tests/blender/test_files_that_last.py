# SPDX-License-Identifier: MIT
"""What earlier versions saved opens with everything working; `tests/data/make_files_that_last.py` made the files."""

from __future__ import annotations

import shutil
from pathlib import Path
from types import ModuleType

import bpy
import driving
import making
import numpy as np
import pytest
from driving import everything, go_on, start

_FOLDERS = sorted(path.parent for path in (Path(__file__).parents[1] / "data").glob("*/kept.blend"))


@pytest.fixture(params=_FOLDERS, ids=[folder.name for folder in _FOLDERS])
def file(request: pytest.FixtureRequest, addon: ModuleType, tmp_path: Path) -> Path:
    """The .blend that a version saved, with the policy beside it, open."""
    folder = tmp_path / "kept"
    shutil.copytree(request.param, folder)
    addon.character.building.forget()
    bpy.ops.wm.open_mainfile(filepath=str(folder / "kept.blend"))
    return folder / "kept.blend"


def armature(name: str) -> bpy.types.Object:
    obj = bpy.data.objects[name]
    making.activate(obj)
    return obj


def assert_complete(addon: ModuleType, obj: bpy.types.Object) -> None:
    """The character, its classes and its recordings are those that were saved."""
    character = addon.character.building.load(obj)
    assert len(character.labels) == obj.fragmotion.figures.fragments == 6
    names = [row.name for row in obj.fragmotion.classes]
    assert len(names) == len(character.class_names) == 4 and names[1] == "Stride" and all(names)
    assert addon.character.classes.excluded(obj) == (2,)
    assert obj.fragmotion.feel.responsiveness == 0.25
    assert [(each.name, each.train) for each in obj.fragmotion.recordings] == [
        ("Imported", True),
        ("Recorded", False),
    ]
    assert obj.fragmotion.active_recording == 1
    np.testing.assert_allclose(
        addon.recordings.recordings.trace_of(obj.fragmotion.recordings[0]), making.waves(30, 4, 1) ** 2, atol=1e-12
    )
    times, motion = addon.recordings.recordings.shown_of(obj.fragmotion.recordings[1])
    assert len(times) == 61 and motion.rotations.shape == (61, len(obj.data.bones), 4)


def test_there_is_a_file_of_the_first_version() -> None:
    assert "0.1.0" in [folder.name for folder in _FOLDERS]


@pytest.mark.parametrize("name", ["Hero", "Twin"])
def test_the_character_and_its_recordings_are_there(addon: ModuleType, file: Path, name: str) -> None:
    assert_complete(addon, armature(name))
    assert [action.fragmotion.use for action in bpy.data.actions] == [True, True]
    assert addon.mocap.left_out.spans_of(bpy.data.actions["way 0"]) == [(1, 3)]
    bpy.ops.wm.save_mainfile()
    addon.character.building.forget()
    bpy.ops.wm.open_mainfile(filepath=str(file))
    assert_complete(addon, armature(name))


@pytest.mark.parametrize("name", ["Hero", "Twin"])
def test_a_recording_is_replayed_and_baked(addon: ModuleType, session: ModuleType, file: Path, name: str) -> None:
    obj = armature(name)
    _, shown = addon.recordings.recordings.shown_of(obj.fragmotion.recordings[1])
    driven = driving.recorded(session).replay(bpy.context, obj, obj.fragmotion.recordings[1])
    for _ in shown.path[1:]:  # another way, since the bodies of the program before had no weight
        driven.update(1 / 60)
        assert np.isfinite(driven.player.frame).all()
    assert np.linalg.norm(np.subtract(driven.player.frame, shown.path[0])[:2]) > 0.3
    session.stop()
    bpy.context.scene.render.fps = 60
    assert bpy.ops.fragmotion.bake(trace_source="RECORDING", recording=1, as_recorded=True) == {"FINISHED"}
    action = obj.animation_data.action
    assert action.name == "Recorded Bake" and tuple(action.frame_range) == (1, 61)


def test_a_drive_that_was_cut_off_by_the_save_is_healed_and_another_gives_all_back(
    addon: ModuleType, session: ModuleType, file: Path
) -> None:
    obj = armature("Twin")
    assert obj.animation_data.action == bpy.data.actions["way 1"] and "fragmotion_put_aside" not in obj
    before = everything(obj)
    driven = start(session, obj)
    driven.inputs.keyboard.press("W")
    go_on(driven, 0.5)
    assert everything(obj)["matrices"] != before["matrices"]
    session.stop()
    before["properties"] = everything(obj)["properties"]
    assert everything(obj) == before


def test_what_is_linked_has_all_too(addon: ModuleType, file: Path) -> None:
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    with bpy.data.libraries.load(str(file), link=True) as (_, linked):
        linked.objects = ["Hero"]
    bpy.context.scene.collection.objects.link(linked.objects[0])
    bpy.ops.wm.save_as_mainfile(filepath=str(file.with_name("linking.blend")))
    bpy.ops.wm.open_mainfile(filepath=str(file.with_name("linking.blend")))
    settings = bpy.data.objects["Hero"].fragmotion
    assert [each.name for each in settings.recordings] == ["Imported", "Recorded"]
    assert settings.feel.responsiveness == 0.25


def test_what_was_recorded_before_the_update_stands_before_what_was_since(addon: ModuleType, file: Path) -> None:
    obj = armature("Hero")
    kept = addon.compat.versions.kept_properties(obj)["fragmotion"]
    kept["takes"], kept["active_take"] = [{"name": "Earlier", "seed": 5, "start": [1.0, 2.0, 0.5]}], 0
    kept["feel"]["promptness"], kept["feel"]["pull"] = 0.75, 0.5
    bpy.ops.wm.save_mainfile()
    bpy.ops.wm.open_mainfile(filepath=str(file))
    settings = bpy.data.objects["Hero"].fragmotion
    assert [each.name for each in settings.recordings] == ["Earlier", "Imported", "Recorded"]
    assert settings.recordings[0].seed == 5 and tuple(settings.recordings[0].start) == (1, 2, 0.5)
    assert (settings.active_recording, settings.feel.responsiveness, settings.feel.root_adjustment) == (1, 0.25, 0.5)
    assert not {"takes", "active_take"} & set(
        addon.compat.versions.kept_properties(settings.id_data)["fragmotion"].keys()
    )


def test_build_learns_as_before(addon: ModuleType, file: Path) -> None:
    obj = armature("Hero")
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=4, seconds=2.0, synthesize=False) == {"FINISHED"}
    assert addon.character.building.load(obj).table.shape == (4, 102)
