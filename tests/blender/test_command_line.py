# SPDX-License-Identifier: MIT
"""`blender -c fragmotion`: files in, files out, a message and an exit code."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import making
import numpy as np
import pytest

WALKS = sorted((making.MOCAP / "bandai-namco").glob("dataset-1_walk_normal_00[12].bvh"))


@pytest.fixture(scope="module")
def takes(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of takes."""
    folder = tmp_path_factory.mktemp("takes")
    making.write_gaits(folder)
    return folder


@pytest.fixture(scope="module")
def hero(addon: ModuleType, takes: Path) -> Path:
    """A .blend with a character that the command built of them, beside its policy file and its figures."""
    path = takes.parent / f"{takes.name} built" / "hero.blend"
    path.parent.mkdir()
    files = ["--blend", path, "--policy", path.with_suffix(".policy"), "--json", path.with_suffix(".json")]
    assert run(addon, "build", takes, "--classes", 12, *files) == 0
    return path


def run(addon: ModuleType, *words: object) -> int:
    code: int = addon.command_line.run([str(word) for word in words])
    return code


def test_a_folder_of_takes_becomes_a_character_and_a_policy_file(addon: ModuleType, takes: Path, hero: Path) -> None:
    figures = json.loads(hero.with_suffix(".json").read_text())
    assert figures["takes"] == len(list(takes.glob("*.bvh"))) and figures["classes"] == 12
    assert figures["fragments"] > 12 and 0 < figures["percent_of_optimal"] <= 100
    bpy.ops.wm.open_mainfile(filepath=str(hero))
    obj = bpy.context.view_layer.objects[figures["armature"]]
    assert addon.character.building.load(obj).to_bytes() == hero.with_suffix(".policy").read_bytes()


@pytest.mark.skipif(not WALKS, reason="no motion capture beside the project")
def test_takes_move_the_armature_of_another_file(addon: ModuleType, tmp_path: Path) -> None:
    (tmp_path / "walks").mkdir()
    for path in WALKS:
        (tmp_path / "walks" / path.name).write_bytes(path.read_bytes())
    making.add_armature(name="Rig")
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "rig.blend"))
    words = ("build", tmp_path / "walks", "--onto", tmp_path / "rig.blend", "--armature", "Rig", "--classes", 12)
    assert run(addon, *words, "--blend", tmp_path / "built.blend", "--json", tmp_path / "built.json") == 0
    figures = json.loads((tmp_path / "built.json").read_text())
    assert figures["armature"] == "Rig" and figures["takes"] == len(WALKS)


def test_a_bake_is_an_action_of_the_new_file(
    addon: ModuleType, hero: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = hero.read_bytes()
    out = tmp_path / "shot.blend"
    assert (
        run(addon, "bake", hero, "--player", "walker", "--seconds", 2, "--seed", 3, "--blend", out, "--json", "-") == 0
    )
    said = capsys.readouterr().out
    baked = json.loads(said[said.index("{") :])["baked"]
    assert hero.read_bytes() == before
    bpy.ops.wm.open_mainfile(filepath=str(out))
    (row,) = baked
    assert tuple(bpy.data.actions[row["action"]].frame_range) == (row["first"], row["last"])
    assert row["last"] - row["first"] == 2 * bpy.context.scene.render.fps


def test_every_recording_is_baked(addon: ModuleType, hero: Path, tmp_path: Path) -> None:
    bpy.ops.wm.open_mainfile(filepath=str(hero))
    trace = tmp_path / "trace.csv"
    trace.write_text("velocity_x,velocity_y,turn,jump\n" + "0,1.2,0,0\n" * 15)
    for _ in range(3):
        assert bpy.ops.fragmotion.import_recordings(filepath=str(trace)) == {"FINISHED"}
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "recorded.blend"))
    words = ("bake", tmp_path / "recorded.blend", "--recordings", "--blend", tmp_path / "shots.blend")
    assert run(addon, *words, "--json", tmp_path / "shots.json") == 0
    names = [row["action"] for row in json.loads((tmp_path / "shots.json").read_text())["baked"]]
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "shots.blend"))
    assert len(set(names)) == 3 and set(names) <= set(bpy.data.actions.keys())


def test_one_recording_is_baked(
    addon: ModuleType, hero: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bpy.ops.wm.open_mainfile(filepath=str(hero))
    recordings = addon.recordings.recordings
    for name, controls in (("Long", 30), ("Short", 15)):
        recordings.add_recording(bpy.context.view_layer.objects.active, [[0, 1.2, 0, 0]] * controls, name=name)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "recorded.blend"))
    words = ("bake", tmp_path / "recorded.blend", "--blend", tmp_path / "shot.blend", "--recording")
    assert run(addon, *words, "Short", "--json", tmp_path / "shot.json") == 0
    (row,) = json.loads((tmp_path / "shot.json").read_text())["baked"]
    assert row["action"] == "Short Bake"
    assert row["last"] - row["first"] == pytest.approx(1.5 * bpy.context.scene.render.fps, abs=1)
    assert run(addon, *words, "Tall") == 1
    assert "has no recording 'Tall': it has 'Long', 'Short'" in capsys.readouterr().err


def test_the_farms_tasks_build_and_bake(addon: ModuleType, takes: Path, hero: Path, tmp_path: Path) -> None:
    """Those of the jobs that the job type's script was compiled with."""
    bpy.ops.wm.open_mainfile(filepath=str(hero))
    for name in ("Stroll", "Up & down"):
        addon.recordings.recordings.add_recording(
            bpy.context.view_layer.objects.active, [[0, 1.2, 0, 0]] * 15, name=name
        )
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "hero.blend"))
    shutil.copytree(takes, tmp_path / "takes")
    (tmp_path / "shots").mkdir()
    jobs = json.loads((Path(__file__).parents[1] / "data" / "farm" / "jobs.json").read_text())
    tasks = [task for job in jobs for task in job.get("tasks", ())]
    made = []
    for task in tasks:
        (command,) = task["commands"]
        exe, (option, name, *words) = command["parameters"]["exe"], command["parameters"]["args"]
        assert (command["name"], exe, option, name) == ("exec", "{blender}", "-c", "fragmotion")
        assert run(addon, *(word.replace("/farm", str(tmp_path)) for word in words)) == 0
        made.append(Path(words[words.index("--blend") + 1]).name)
    assert {path.name for path in (tmp_path / "shots").iterdir()} == set(made) - {"built.blend"}
    assert len(made) == len(set(made)) == 5
    lengths = {}
    for path in (tmp_path / "shots").iterdir():
        bpy.ops.wm.open_mainfile(filepath=str(path))
        obj = bpy.context.view_layer.objects.active
        lengths[path.name] = np.ptp(obj.animation_data.action.frame_range)
    assert lengths["built runner 7.blend"] == 2 * bpy.context.scene.render.fps


@pytest.mark.thorough
def test_several_files_are_baked_into_a_folder(addon: ModuleType, hero: Path, tmp_path: Path) -> None:
    """In Blenders of their own, where this is no module of Python's."""
    copies = [tmp_path / f"{name}.blend" for name in ("first", "second")]
    for copy in copies:
        copy.write_bytes(hero.read_bytes())
    words = ("bake", *copies, "--player", "walker", "--seconds", 2, "--into", tmp_path / "shots")
    assert run(addon, *words, "--json", tmp_path / "shots.json") == 0
    rows = json.loads((tmp_path / "shots.json").read_text())["baked"]
    assert [Path(row["blend"]) for row in rows] == [tmp_path / "shots" / copy.name for copy in copies]
    for row in rows:
        bpy.ops.wm.open_mainfile(filepath=row["blend"])
        assert tuple(bpy.data.actions[row["action"]].frame_range) == (row["first"], row["last"])


@pytest.mark.thorough
def test_the_file_that_cannot_be_baked_is_named(
    addon: ModuleType, hero: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "good.blend").write_bytes(hero.read_bytes())
    words = ("bake", tmp_path / "good.blend", tmp_path / "missing.blend", "--player", "walker", "--seconds", 1)
    assert run(addon, *words, "--into", tmp_path / "shots") == 1
    assert "missing.blend" in capsys.readouterr().err
    assert run(addon, *words, "--into", tmp_path) == 1
    assert "would be written over" in capsys.readouterr().err


def test_a_character_is_measured(addon: ModuleType, hero: Path, tmp_path: Path) -> None:
    figures = []
    for player in ("walker", "runner"):
        words = ("evaluate", hero, "--player", player, "--seconds", 5, "--json", tmp_path / "figures.json")
        assert run(addon, *words) == 0
        figures += json.loads((tmp_path / "figures.json").read_text())["traces"]
    assert [row["trace"] for row in figures] == ["walker", "runner"]
    for row in figures:
        assert 0 < row["percent_of_optimal"] < 100.001 and 0 < row["quality"] <= 1 and row["velocity_error"] >= 0
    assert figures[0]["commanded_speed"] < figures[1]["commanded_speed"]


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("evaluate", "{hero}", "--recordings"), "has no recordings"),
        (("info", "missing.blend"), "missing.blend"),
        (("build", "missing", "--blend", "x.blend"), "missing"),
        (("build", "missing"), "say where to"),
        (("bake", "{hero}", "--player", "walker"), "say where to"),
        (("bake", "{hero}", "--recordings", "--blend", "x.blend"), "has no recordings"),
        (("bake", "{hero}", "--trace", "missing.csv", "--blend", "x.blend"), "missing.csv"),
        (("build", "{hero}", "--classes", "1", "--blend", "x.blend"), "--classes is 1, and must be from 2 to"),
        (("build", "{hero}", "--seed", "4294967296", "--blend", "x.blend"), "must be from 0 to 2147483647"),
        (("bake", "{hero}", "--player", "walker", "--seed", "4294967296", "--blend", "x.blend"), "must be from 0 to"),
        (
            ("bake", "{hero}", "--player", "walker", "--seconds", "4000", "--blend", "x.blend"),
            "--seconds is 4000.0, and must be from 0.5 to 3600.0",
        ),
        (("info", "{hero}", "--armature", "Nobody"), "has no armature 'Nobody'"),
        (("bake", "{hero}", "--player", "walker", "--style", "sad", "--blend", "x.blend"), "has no style 'sad'"),
        (("build", "{hero}", "--style", "tired", "--blend", "x.blend"), "--style tired tells no name or no pattern"),
        (("build", "{hero}", "--style", "tired=no*", "--blend", "x.blend"), "No take's name fits 'no*'"),
        (("build", "{hero}", "--folder-styles", "--blend", "x.blend"), "--folder-styles asks for a folder of takes"),
    ],
)
def test_what_cannot_be_done_is_told(
    addon: ModuleType,
    hero: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    words: tuple[str, ...],
    message: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(addon, *(word.format(hero=hero) for word in words)) == 1
    said = capsys.readouterr().err
    assert said.startswith("fragmotion: ") and message in said
    assert list(tmp_path.iterdir()) == []


def test_info_and_help_end_well_and_nonsense_does_not(
    addon: ModuleType, hero: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(addon, "info", hero) == 0
    assert "classes 12" in capsys.readouterr().out
    assert run(addon, "--help") == 0 and "examples:" in capsys.readouterr().out
    assert run(addon, "dance") == 2


def test_controls_are_told_on_the_command_line(
    addon: ModuleType, takes: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ("build", takes, "--classes", 12, "--blend", tmp_path / "own.blend", "--json", tmp_path / "own.json")
    assert run(addon, *words, "--speeds", 3, "--directions", 4, "--no-turn", "--no-jump") == 0
    assert json.loads((tmp_path / "own.json").read_text())["controls"] == 13
    assert run(addon, *words, "--controls", "found") == 0
    assert run(addon, *words, "--controls", "found", "--speeds", 3) == 1
    assert "--controls found and --speeds say two different things" in capsys.readouterr().err
    assert run(addon, *words, "--controls", "paper") == 0
    assert json.loads((tmp_path / "own.json").read_text())["controls"] == 102


def test_styles_are_told_by_names_and_by_folders(addon: ModuleType, takes: Path, tmp_path: Path) -> None:
    for style in ("Tired", "neutral"):
        (tmp_path / "takes" / style).mkdir(parents=True)
        for path in takes.glob("*.bvh"):
            (tmp_path / "takes" / style / f"{path.stem} {style}.bvh").write_bytes(path.read_bytes())
    built, told = tmp_path / "styled.blend", tmp_path / "told.json"
    words = ("build", tmp_path / "takes", "--classes", 12, "--blend", built, "--json", told)
    for way in (("--folder-styles",), ("--style", "Tired=*tired", "--style", "neutral=*neutral")):
        assert run(addon, *words, *way) == 0
        assert json.loads(told.read_text())["styles"] == ["neutral", "Tired"]
    words = ("bake", built, "--player", "walker", "--seconds", 2, "--style", "Tired")
    assert run(addon, *words, "--blend", tmp_path / "shot.blend") == 0


def test_words_that_need_no_blend_do_what_the_cores_command_does(
    addon: ModuleType, takes: Path, hero: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    command, policy = addon.compat.core.command("parser").make_parser("fragmotion"), tmp_path / "hero.policy"
    for word in command.words.choices:
        assert run(addon, word, "--help") == 0
    alone = [
        str(word) for word in ("build", takes, "--classes", 12, "--seed", 3, "--policy", tmp_path / "alone.policy")
    ]
    assert addon.compat.core.command("running").run(command.parser, alone) == 0
    assert run(addon, "build", takes, "--classes", 12, "--seed", 3, "--policy", policy) == 0
    assert policy.read_bytes() == (tmp_path / "alone.policy").read_bytes()
    words = ("--player", "walker", "--seconds", 5)
    assert run(addon, "play", policy, *words, "--bvh", tmp_path / "shot.bvh") == 0
    assert (tmp_path / "shot.bvh").stat().st_size > 1000
    for word in (("info", policy), ("evaluate", policy, *words)):
        assert run(addon, *word) == 0
    said = capsys.readouterr().out
    assert "classes 12" in said and "walker: percent of optimal" in said
    assert run(addon, "doctor", takes, "--json", tmp_path / "findings.json") == 0
    assert len(json.loads((tmp_path / "findings.json").read_text())["files"]) == len(list(takes.glob("*.bvh")))
    assert run(addon, "evaluate", policy, "--recordings") == 1
    assert "is no .blend" in capsys.readouterr().err


def test_what_the_core_reads_in_another_unit_is_built_in_it(
    addon: ModuleType, takes: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ("build", takes, "--classes", 12, "--blend", tmp_path / "built.blend")
    assert run(addon, *words, "--unit", "0.5") == 1
    assert "--unit 0.5: for Blender it is one of 0.01, 1, 0.0254" in capsys.readouterr().err
    assert run(addon, *words, "--unit", "0.01") == 0


def _write_vrm(path: str) -> None:
    making.export_gltf(f"{path}.glb")
    Path(f"{path}.glb").rename(path)  # a VRM is a GLB of another name


RIGS: dict[str, Callable[[str], object]] = {
    ".blend": lambda path: bpy.ops.wm.save_as_mainfile(filepath=path, copy=True),
    ".vrm": _write_vrm,
    ".usdc": lambda path: bpy.ops.wm.usd_export(filepath=path),
    ".fbx": lambda path: bpy.ops.export_scene.fbx(filepath=path, bake_anim=False),
}


@pytest.fixture(scope="module")
def walk(addon: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A take of the sample character as a BVH file."""
    obj, core, path = making.open_sample(), addon.compat.core.core, tmp_path_factory.mktemp("walk") / "walk.bvh"
    rig = addon.rig.rigs.make_rig(obj)
    clip = addon.mocap.sampling.sample(bpy.context, obj, bpy.data.actions["walk forward"], rig)
    core.write_bvh(core.Take.from_clip(clip, rig.skeleton), path)
    return path


@pytest.mark.parametrize(
    "ending", [pytest.param(each, marks=() if each == ".blend" else pytest.mark.thorough) for each in RIGS]
)
def test_takes_are_brought_onto_a_rig_of_a_file(addon: ModuleType, walk: Path, tmp_path: Path, ending: str) -> None:
    rig, minute = tmp_path / f"rig{ending}", tmp_path / "minute.blend"
    making.open_sample()
    try:
        RIGS[ending](str(rig))
    except AttributeError:
        pytest.skip(f"this Blender writes no {ending}")
    words = ("retarget", walk, "--onto", rig, "--seed", 3, "--blend", minute, "--json", tmp_path / "told.json")
    assert run(addon, *words) == 0
    told = json.loads((tmp_path / "told.json").read_text())
    assert told["takes"][0]["contact_error_m"] <= 0.01
    assert {"hips", "left_hand", "right_foot"} <= set(told["roles"])
    bpy.ops.wm.open_mainfile(filepath=str(minute))
    assert bpy.data.actions["Driven by a trace"].frame_range[1] > 60 * bpy.context.scene.render.fps


def test_what_is_for_rigs_alone_is_refused(addon: ModuleType, walk: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for option in ("--armature", "--blend"):
        assert run(addon, "retarget", walk, "--onto", walk, option, "x") == 1
        assert f"{option} is for rigs, and walk.bvh is a skeleton alone" in capsys.readouterr().err


def as_fbx(path: Path) -> None:
    bpy.ops.export_scene.fbx(filepath=str(path), object_types={"ARMATURE"}, add_leaf_bones=False, **ONE_ACTION)


def as_glb(path: Path) -> None:
    making.export_gltf(path, export_animation_mode="ACTIVE_ACTIONS")


ONE_ACTION = {"bake_anim_use_nla_strips": False, "bake_anim_use_all_actions": False, "bake_anim_simplify_factor": 0}


@pytest.mark.skipif(bool(bpy.app.binary_path), reason="this Blender is no module of Python's")
@pytest.mark.parametrize("write", [as_fbx, as_glb])
def test_the_command_alone_reads_takes_and_rigs_through_bpy(
    addon: ModuleType, walk: Path, tmp_path: Path, write: Callable[[Path], None]
) -> None:
    """As pip's users have it: without the add-on, and in a process of its own."""
    obj = making.open_sample()
    addon.compat.versions.assign(obj, bpy.data.actions["walk forward"])
    bpy.context.scene.render.fps = 30
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = map(int, obj.animation_data.action.frame_range)
    path = tmp_path / f"again.{write.__name__[3:]}"
    write(path)
    command = addon.compat.core.command("running")
    environment = {**os.environ, "PYTHONPATH": str(Path(command.__file__).parents[1])}

    def told_by(*words: object) -> dict[str, Any]:
        whole = [sys.executable, "-m", "fragmotion_command", *map(str, words), "--json", "-"]
        ended = subprocess.run(whole, env=environment, capture_output=True, text=True, check=False)
        assert ended.returncode == 0, ended.stderr
        told: dict[str, Any] = json.loads(ended.stdout)
        return told

    (examined,) = told_by("doctor", path)["files"]
    assert examined["format"] == write.__name__[3:].upper() and examined["roles"]["left_foot"]
    assert told_by("build", path, "--policy", tmp_path / "alone.policy")["fragments"]
    told = told_by("retarget", walk, path, "--onto", path, "--into", tmp_path / "moved")
    assert [Path(take["path"]).name for take in told["takes"]] == ["walk.bvh", path.name]
    assert all(take["contact_error_m"] <= 0.01 for take in told["takes"])
    first, second = (
        addon.compat.core.core.read_bvh(tmp_path / "moved" / f"{name}.bvh").world_transforms()[0]
        for name in ("walk", "again")
    )
    np.testing.assert_allclose(second[: len(first)], first[: len(second)], atol=0.01)


@pytest.mark.thorough
def test_what_ticked_actions_make_is_measured(addon: ModuleType, tmp_path: Path) -> None:
    making.open_sample()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "sample.blend"))
    assert run(addon, "evaluate", tmp_path / "sample.blend", "--quick", "--json", tmp_path / "told.json") == 0
    assert json.loads((tmp_path / "told.json").read_text())["takes"]["count"] >= 20


@pytest.mark.parametrize(
    "words",
    [
        ("build", "takes", "--seed", "-1"),
        ("build", "takes", "--classes", "99999999999999"),
        ("bake", "hero.blend", "--player", "walker", "--seed", "-1"),
        ("evaluate", "hero.blend", "--player", "walker", "--seed", "one"),
    ],
)
def test_a_number_out_of_its_bounds_is_told(
    addon: ModuleType, capfd: pytest.CaptureFixture[str], words: tuple[str, ...]
) -> None:
    assert run(addon, *words) == 2
    *_, option, value = words
    said = capfd.readouterr().err
    assert f"argument {option}: '{value}' is no " in said and "it must be a whole number from" in said
