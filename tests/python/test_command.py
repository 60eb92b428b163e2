# SPDX-License-Identifier: MIT
"""The command `fragmotion`: files in, files out, a message and an exit code."""

from __future__ import annotations

import json
from pathlib import Path

import fragmotion_command
import fragmotion_core as core
import numpy as np
import pytest
from sample_motions import write_sample


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the sample's takes, and hero.policy, built of them."""
    path = tmp_path_factory.mktemp("command")
    (path / "takes").mkdir()
    write_sample(path / "takes")
    assert run("build", path / "takes", "--policy", path / "hero.policy", "--classes", 20) == 0
    return path


def run(*words: object) -> int:
    return fragmotion_command.main([str(word) for word in words])


def figures_of(capsys: pytest.CaptureFixture[str], *words: object) -> dict[str, object]:
    capsys.readouterr()
    assert run(*words, "--json", "-") == 0
    found: dict[str, object] = json.loads(capsys.readouterr().out)
    return found


def rows_of(capsys: pytest.CaptureFixture[str], *words: object) -> list[dict[str, object]]:
    rows = figures_of(capsys, *words)["traces"]
    assert isinstance(rows, list)
    return rows


def test_info_tells_what_was_built(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    character = core.Character.load(folder / "hero.policy")
    found = figures_of(capsys, "info", folder / "hero.policy")
    assert found["classes"] == 20 == len(character.class_names)
    assert found["fragments"] == len(character.fragment_durations) > 100
    assert found["walk"] == character.space.walk and found["policies"] == character.policies
    assert found["undone"] == core.undone_controls(character.space, core.abilities(character)) != []


def test_a_broken_file_is_named_and_the_rest_is_built_from(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for path in (folder / "takes").glob("*.bvh"):
        (tmp_path / path.name).write_bytes(path.read_bytes())
    (tmp_path / "a broken.bvh").write_text("HIERARCHY\n")
    take = core.read_bvh(next(tmp_path.glob("*[!n].bvh")))
    pose = core.Take(take.skeleton, "pose", take.rate, take.translations[:1], take.rotations[:1])
    core.write_bvh(pose, tmp_path / "a pose.bvh")
    capsys.readouterr()
    assert run("build", tmp_path, "--policy", tmp_path / "rest.policy", "--classes", 20) == 0
    assert "left out: " in (said := capsys.readouterr().err) and "a broken.bvh:" in said
    assert "a pose.bvh: holds a single pose, no motion" in said
    assert (tmp_path / "rest.policy").read_bytes() == (folder / "hero.policy").read_bytes()
    for name in ("a broken.bvh", "a pose.bvh"):
        assert run("build", tmp_path / name, "--policy", tmp_path / "none.policy") == 1


def test_a_unit_that_is_surely_wrong_is_put_right_unless_it_is_told(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "takes").mkdir()
    for path in (folder / "takes").glob("*.bvh"):
        take = core.read_bvh(path, 0.01)
        smaller = core.Take(
            core.read_bvh(path, 1e-4).skeleton, take.name, take.rate, take.translations / 100, take.rotations
        )
        core.write_bvh(smaller, tmp_path / "takes" / path.name)
    capsys.readouterr()
    assert run("build", tmp_path / "takes", "--policy", tmp_path / "mended.policy", "--classes", 20) == 0
    assert "mended: " in capsys.readouterr().err
    stature = core.Character.load(folder / "hero.policy").skeleton.stature
    assert core.Character.load(tmp_path / "mended.policy").skeleton.stature == pytest.approx(stature, rel=0.05)
    told = ("--policy", tmp_path / "told.policy", "--classes", 20, "--unit", 0.01)
    assert run("build", tmp_path / "takes", *told) == 0
    assert core.Character.load(tmp_path / "told.policy").skeleton.stature == pytest.approx(stature / 100, rel=0.05)


def test_what_is_played_is_read_back(folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    words = ("play", folder / "hero.policy", "--player", "walker", "--seconds", 5, "--seed", 7)
    found = figures_of(capsys, *words, "--bvh", tmp_path / "shot.bvh")
    character = core.Character.load(folder / "hero.policy")
    trace = core.simulate_trace("walker", 5, 7, character.space)
    expected = core.Player(character, 7).run(trace, 30)
    clip = core.Clip(character.skeleton, "x", 30, expected.root_positions, expected.rotations)
    take = core.read_bvh(tmp_path / "shot.bvh")
    heads = take.world_transforms()[0]
    assert found == {"frames": 151, "rate": 30.0} and len(heads) == 151
    hips = character.skeleton.names.index(character.skeleton.roles["hips"])  # what is above rests in a BVH file
    np.testing.assert_allclose(heads[:, hips:], clip.world_transforms(character.skeleton)[0][:, hips:], atol=1e-4)


def test_a_trace_drives_as_its_player_does(folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    character = core.Character.load(folder / "hero.policy")
    core.write_trace(tmp_path / "trace.csv", core.simulate_trace("runner", 10, 3, character.space))
    words = ("evaluate", folder / "hero.policy", "--seed", 3)
    (by_file,) = rows_of(capsys, *words, "--trace", tmp_path / "trace.csv")
    (by_player,) = rows_of(capsys, *words, "--player", "runner", "--seconds", 10)
    assert (by_file.pop("trace"), by_player.pop("trace")) == ("trace", "runner")
    assert by_file.keys() == by_player.keys()
    for name, value in by_player.items():
        assert by_file[name] == pytest.approx(value, rel=1e-3), name
    assert 0 < float(str(by_player["percent_of_optimal"])) <= 100


def test_all_players_measure_where_none_is_named(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    rows = rows_of(capsys, "evaluate", folder / "hero.policy", "--seconds", 2)
    assert [row["trace"] for row in rows] == list(core.PLAYERS)


@pytest.fixture(scope="module")
def styled(folder: Path) -> Path:
    """A policy file of two styles, built of the same folder."""
    path = folder / "styled.policy"
    words = ("--policy", path, "--classes", 12, "--style", "Tired=*_tired*", "--style", "odd=nobody*")
    assert run("build", folder / "takes", *words) == 1, "a pattern that no name fits"
    for take in sorted((folder / "takes").glob("*.bvh")):
        (folder / "takes" / f"{take.stem}_tired.bvh").write_bytes(take.read_bytes())
    assert run("build", folder / "takes", *words[:-2]) == 0
    return path


def test_a_character_is_built_in_styles(styled: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert (
        figures_of(capsys, "info", styled)["styles"] == ["neutral", "Tired"] == core.Character.load(styled).style_names
    )


def test_folders_tell_styles(folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for style in ("neutral", "proud"):
        (tmp_path / style).mkdir()
        for take in (folder / "takes").glob("*.bvh"):
            (tmp_path / style / take.name).write_bytes(take.read_bytes())
    words = ("build", tmp_path, "--policy", tmp_path / "x.policy", "--classes", 12, "--folder-styles")
    assert figures_of(capsys, *words)["styles"] == ["neutral", "proud"]


def test_a_trace_plays_its_moves_and_styles(folder: Path, styled: Path, tmp_path: Path) -> None:
    character = core.Character.load(styled)
    clip = core.Clip.from_take(core.read_bvh(sorted((folder / "takes").glob("*.bvh"))[0]), character.skeleton)
    character = character.with_moves([core.Move("go", clip)])
    character.save(tmp_path / "moving.policy")
    trace, path = np.tile((0, 1.2, 0, 0), (40, 1)), tmp_path / "trace.csv"
    core.write_trace(path, trace, [(5, "go", 3)], [(0, "Tired"), (30, "neutral")])
    assert core.read_asked(path) == ([(5, "go", 3)], [(0, "Tired"), (30, "neutral")], [], [])
    words = ("play", tmp_path / "moving.policy", "--trace", path)
    assert run(*words, "--bvh", tmp_path / "shot.bvh") == 0
    player = core.Player(character, 1)
    player.reset(style=1)
    expected = player.run(trace, 30, moves=[[5, 0, 3]], styles=[[30, 0]])
    hips = core.read_bvh(tmp_path / "shot.bvh").world_transforms()[0]
    bone = character.skeleton.names.index(character.skeleton.roles["hips"])
    clip = core.Clip(character.skeleton, "x", 30, expected.root_positions, expected.rotations)
    np.testing.assert_allclose(hips[:, bone:], clip.world_transforms(character.skeleton)[0][:, bone:], atol=1e-4)
    core.write_trace(path, trace, [(5, "juggle", 3)])
    assert run(*words, "--bvh", tmp_path / "none.bvh") == 1 and not (tmp_path / "none.bvh").exists()


@pytest.mark.parametrize("seed", ["-1", str(2**64), "one"])
def test_what_is_no_seed_is_told(folder: Path, capsys: pytest.CaptureFixture[str], seed: str) -> None:
    with pytest.raises(SystemExit):
        run("evaluate", folder / "hero.policy", "--player", "walker", "--seed", seed)
    assert f"argument --seed: '{seed}' is no seed: it must be a whole number from 0 to" in capsys.readouterr().err


@pytest.mark.parametrize("classes", ["0", "-1", "99999999999999", "many"])
def test_what_is_no_number_of_classes_is_told(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], classes: str
) -> None:
    with pytest.raises(SystemExit) as end:
        run("build", folder / "takes", "--policy", tmp_path / "x.policy", "--classes", classes)
    assert end.value.code == 2
    words = f"'{classes}' is no number of classes: it must be a whole number from 1 to {core.MOST_CLASSES}"
    assert f"argument --classes: {words}" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("info", "missing.policy"), "missing.policy"),
        (("build", ".", "--policy", "x.policy"), "no takes here"),
        (("build", "alone.amc", "--policy", "x.policy"), "its skeleton alone.asf is not in the folder"),
        (("play", "{hero}", "--trace", "missing.csv", "--bvh", "x.bvh"), "missing.csv"),
        (("play", "{hero}", "--player", "walker", "--bvh", "no/x.bvh"), "no/x.bvh"),
        (("build", "{takes}"), "say where to, by --policy"),
        (
            ("build", "{takes}", "--controls", "found", "--no-turn", "--policy", "x.policy"),
            "--no-turn say two different",
        ),
        (("doctor", "missing.bvh"), "missing.bvh: there is no such file"),
        (("build", "{takes}", "--style", "tired", "--policy", "x.policy"), "tells no name or no pattern"),
        (("play", "{hero}", "--player", "walker", "--style", "sad", "--bvh", "x.bvh"), "its styles are none"),
        (("play", "{hero}", "--player", "walker", "--rate", "0", "--bvh", "x.bvh"), "rate"),
    ],
)
def test_what_cannot_be_done_is_told(
    folder: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    words: tuple[str, ...],
    message: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    if "alone.amc" in words:
        Path("alone.amc").touch()
    before = sorted(tmp_path.iterdir())
    assert run(*(word.format(hero=folder / "hero.policy", takes=folder / "takes") for word in words)) == 1
    said = capsys.readouterr().err
    assert said.startswith("fragmotion: ") and message in said.replace("\\", "/")
    assert sorted(tmp_path.iterdir()) == before
