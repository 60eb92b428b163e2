# SPDX-License-Identifier: MIT
"""`dev.py retarget`: what its JSON file says, and bad input."""

from __future__ import annotations

import json
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest
from conftest import BANDAI, CMU, NAMES, walking_arrays
from evaluated import write_bvh

from tools.paths import TOP
from tools.retarget.__main__ import main

FIGURES = {"foot_skate_ratio", "contact_error_m", "knee_beyond_degrees"}


@pytest.fixture
def legless(tmp_path: Path) -> Path:
    """A take of a body whose legs have no knees."""
    path = tmp_path / "legless.bvh"
    write_bvh(path, NAMES, *walking_arrays(seconds=1.0))
    return path


@pytest.fixture(scope="module")
def result(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """Takes of two skeletons on a third."""
    takes = [BANDAI / "dataset-1_walk_normal_001.bvh", CMU / "02_04.amc"]
    onto = CMU / "01.asf"
    if not all(path.exists() for path in (*takes, onto)):
        pytest.skip("no motion capture beside the project")
    saved = tmp_path_factory.mktemp("retarget") / "figures" / "retarget.json"
    assert main([*map(str, takes), "--onto", str(onto), "--json", str(saved)]) == 0
    found: dict[str, Any] = json.loads(saved.read_text())
    return found


@pytest.mark.thorough
def test_roles_are_the_targets(result: dict[str, Any]) -> None:
    assert result["roles"]["hips"] == "root"
    assert result["roles"]["left_shin"] == "ltibia"


@pytest.mark.thorough
def test_every_take_has_its_figures(result: dict[str, Any]) -> None:
    assert [Path(take["path"]).name for take in result["takes"]] == ["dataset-1_walk_normal_001.bvh", "02_04.amc"]
    for take in result["takes"]:
        assert set(take) == {"path", "findings", *FIGURES}
        assert take["foot_skate_ratio"] <= 1.1
        assert take["contact_error_m"] <= 0.01
        assert take["knee_beyond_degrees"] <= 0.01
        assert take["findings"] == []


@pytest.mark.thorough
def test_the_character_has_its_figures(result: dict[str, Any]) -> None:
    character = result["character"]
    assert set(character) == {"fragments", "percent_of_optimal", "velocity_error", "foot_skate_ratio"}
    assert character["fragments"] > 20
    assert 0 < character["percent_of_optimal"] <= 100


WRITERS = {
    ".vrm": "bpy.ops.export_scene.gltf(filepath=out + '.glb'); os.rename(out + '.glb', out)",  # a GLB of another name
    ".usdc": "bpy.ops.wm.usd_export(filepath=out)",
    ".fbx": "bpy.ops.export_scene.fbx(filepath=out, bake_anim=False)",
}


@pytest.mark.thorough
@pytest.mark.parametrize("ending", WRITERS)
def test_rigs_of_the_formats_that_blender_reads_are_targets(ending: str, tmp_path: Path) -> None:
    """In processes of their own: bpy is no neighbour for other tests."""
    take, sample, rig = CMU / "02_04.amc", TOP / "sample_rigs" / "fragmotion_sample.blend", tmp_path / f"rig{ending}"
    if not take.exists():
        pytest.skip("no motion capture beside the project")
    if find_spec("bpy") is None:
        pytest.skip("Blender's module bpy is not installed here")
    opened = (
        f"import bpy, os; bpy.ops.wm.open_mainfile(filepath={str(sample)!r}); out = {str(rig)!r}; {WRITERS[ending]}"
    )
    subprocess.run([sys.executable, "-c", opened], cwd=TOP, capture_output=True, check=True)
    command = [sys.executable, "-m", "tools.retarget", take, "--onto", rig, "--json", tmp_path / "saved.json"]
    answer = subprocess.run(command, cwd=TOP, capture_output=True, text=True)
    assert answer.returncode == 0, answer.stderr
    found = json.loads((tmp_path / "saved.json").read_text())
    assert found["takes"][0]["contact_error_m"] <= 0.01
    assert {"hips", "left_hand", "right_foot"} <= set(found["roles"])


def refusal(capsys: pytest.CaptureFixture[str], *arguments: str | Path) -> str:
    """What is said where nothing is done."""
    assert main([str(argument) for argument in arguments]) == 1
    return capsys.readouterr().err


def test_a_source_without_knees_is_refused_by_name(legless: Path, capsys: pytest.CaptureFixture[str]) -> None:
    said = refusal(capsys, legless, "--onto", legless)
    assert said.startswith(f"retarget: {legless}: no bone is known to be left_shin, right_shin: ")


def test_what_cannot_be_read_is_refused(legless: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert "no such file" in refusal(capsys, legless, "--onto", tmp_path / "missing.bvh")
    (tmp_path / "notes.txt").write_text("")
    assert "not a skeleton or rig" in refusal(capsys, legless, "--onto", tmp_path / "notes.txt")
    assert "no such file" in refusal(capsys, tmp_path / "missing.bvh", "--onto", legless)
    (tmp_path / "empty.bvh").write_text("")
    assert "empty.bvh" in refusal(capsys, legless, "--onto", tmp_path / "empty.bvh")


def test_options_that_do_not_fit_are_refused(legless: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert "--armature is for rigs" in refusal(capsys, legless, "--onto", legless, "--armature", "Armature")
    assert "--blend is for rigs" in refusal(capsys, legless, "--onto", legless, "--blend", "out.blend")
    assert "--unit" in refusal(capsys, legless, "--onto", legless, "--unit", "0")
    assert "--seed" in refusal(capsys, legless, "--onto", legless, "--seed", "-1")
