# SPDX-License-Identifier: MIT
"""`fragmotion retarget`: what its JSON file says, and bad input."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import fragmotion_core as core
import numpy as np
import pytest
from conftest import BANDAI, CMU, NAMES, walking_arrays
from evaluated import write_bvh
from fragmotion_command import main
from fragmotion_command.retarget import roles
from sample_motions import write_sample

FIGURES = {"foot_skate_ratio", "contact_error_m", "knee_beyond_degrees", "limb_degrees"}


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
    assert main(["retarget", *map(str, takes), "--onto", str(onto), "--json", str(saved)]) == 0
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
        assert max(take["limb_degrees"].values()) < 30
        assert take["findings"] == []


@pytest.mark.thorough
def test_the_character_has_its_figures(result: dict[str, Any]) -> None:
    character = result["character"]
    assert set(character) == {"fragments", "percent_of_optimal", "velocity_error", "foot_skate_ratio"}
    assert character["fragments"] > 20
    assert 0 < character["percent_of_optimal"] <= 100


def refusal(capsys: pytest.CaptureFixture[str], *arguments: str | Path) -> str:
    """What is said where nothing is done."""
    assert main(["retarget", *map(str, arguments)]) == 1
    return capsys.readouterr().err


def test_a_source_without_knees_is_refused_by_name(legless: Path, capsys: pytest.CaptureFixture[str]) -> None:
    said = refusal(capsys, legless, "--onto", legless).splitlines()[-1]
    assert said.startswith(f"fragmotion: {legless}: no bone is known to be left_shin, right_shin: ")


def test_what_cannot_be_read_is_refused(legless: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert "no such file" in refusal(capsys, legless, "--onto", tmp_path / "missing.bvh")
    (tmp_path / "notes.txt").write_text("")
    assert "neither a skeleton" in refusal(capsys, legless, "--onto", tmp_path / "notes.txt")
    assert "--armature is for rigs" in refusal(capsys, legless, "--onto", legless, "--armature", "Hero")
    assert "no such file" in refusal(capsys, tmp_path / "missing.bvh", "--onto", legless)
    (tmp_path / "empty.bvh").write_text("")
    assert "empty.bvh" in refusal(capsys, legless, "--onto", tmp_path / "empty.bvh")


def test_bones_that_are_told_are_roles(legless: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert "tells no role or no bone" in refusal(capsys, legless, "--onto", legless, "--role", "Hips")
    write_sample(tmp_path)
    skeleton = core.read_bvh(next(tmp_path.glob("*.bvh"))).skeleton
    toe = skeleton.role_map()["left_foot"][0]
    assert roles.role_of(f"Foot.L={toe}") == ("left_foot", toe)
    with pytest.raises(ValueError, match="there is no bone 'Knee'"):
        roles.check_bones([skeleton], [("left_shin", "Knee")])
    chest = skeleton.role_map()["spine_1"][0]
    assert roles.make_body(skeleton, [], []).roles["head"] != chest
    told = roles.make_body(skeleton, [], [roles.role_of(f"head={chest}"), ("head", "of another skeleton")]).roles
    assert told["head"] == chest and "spine_1" not in told


def test_options_that_do_not_fit_are_refused(legless: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert "--unit is 0" in refusal(capsys, legless, "--onto", legless, "--unit", "0")
    assert "--onto-unit is -1" in refusal(capsys, legless, "--onto", legless, "--onto-unit", "-1")


def test_takes_are_written_as_they_move_on_the_other_skeleton(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "takes").mkdir()
    write_sample(tmp_path / "takes")
    files = sorted((tmp_path / "takes").glob("*.bvh"))
    words = ("retarget", tmp_path / "takes", "--onto", files[0], "--into", tmp_path / "moved", "--json", "-")
    assert main([*map(str, words)]) == 0
    figures = json.loads(capsys.readouterr().out)
    assert [Path(take["path"]).name for take in figures["takes"]] == [file.name for file in files]
    assert sorted(file.name for file in (tmp_path / "moved").iterdir()) == [file.name for file in files]
    for file in files:
        before, after = (core.read_bvh(path).world_transforms()[0] for path in (file, tmp_path / "moved" / file.name))
        np.testing.assert_allclose(after[:, -1], before[:, -1], atol=0.02)


def without_bpy(*words: object, version: tuple[int, int]) -> subprocess.CompletedProcess[str]:
    """Run the command in a Python that has no bpy and says that it is of that version."""
    lines = (
        "import sys, fragmotion_command, fragmotion_command.parser",
        f"sys.modules['bpy'], sys.version_info = None, {(*version, 0)}",
        f"sys.exit(fragmotion_command.main({[*map(str, words)]!r}))",
    )
    code = "; ".join(lines)
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)


def test_without_bpy_it_is_said_how_to_get_it(tmp_path: Path) -> None:
    write_sample(tmp_path)
    take = next(tmp_path.glob("*.bvh"))
    (tmp_path / "a.fbx").write_text("")
    (tmp_path / "b.glb").write_text("")
    for words in (
        ("retarget", tmp_path / "a.fbx", "--onto", take),
        ("retarget", take, "--onto", tmp_path / "b.glb"),
        ("build", tmp_path / "a.fbx", "--policy", tmp_path / "a.policy"),
        ("doctor", tmp_path / "a.fbx"),
    ):
        ended = without_bpy(*words, version=(3, 11))
        assert ended.returncode == 1 and "pip install 'bpy==4.5.*'" in ended.stderr + ended.stdout, ended
    ended = without_bpy("retarget", tmp_path / "a.fbx", "--onto", take, version=(3, 12))
    assert "not there for Python 3.12" in ended.stderr and "3.13 (bpy 5.2)" in ended.stderr
    ended = without_bpy("retarget", tmp_path, "--onto", take, version=(3, 11))
    assert ended.returncode == 0 and ended.stderr.count("left out: ") == 1 and "(and 1 more like it)" in ended.stderr
