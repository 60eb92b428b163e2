# SPDX-License-Identifier: MIT
"""`dev.py directing`: its figures and its bad input."""

from __future__ import annotations

import argparse
import json
import math
from pathlib import Path

import fragmotion_core as core
import numpy as np
import pytest
from conftest import Array
from sample_motions import write_sample

from tools.measuring.blend import read_recordings
from tools.measuring.directing import inputs
from tools.measuring.directing.__main__ import main, make_character, measure
from tools.measuring.directing.measures.courses import TIGHTEST, Course, courses, right_angles
from tools.measuring.directing.measures.paths import follow

MOST_WALKING, MOST_RUNNING = 0.15, 0.3  # m from the path, in the mean: the goals
MOST_FROM_END, MOST_FROM_TIME = 0.2, 0.25  # m, s


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("takes")
    write_sample(folder)
    return folder


@pytest.fixture(autouse=True)
def one_player_is_pinned(monkeypatch: pytest.MonkeyPatch) -> None:
    """Since each pin is searched for."""
    monkeypatch.setattr("tools.measuring.directing.measures.pins._PLAYERS", ("walker",))


@pytest.fixture(scope="module")
def made(folder: Path) -> core.Character:
    return make_character(read_recordings([folder], 0.01), 1)


def radii(course: Course) -> Array:
    """Of the circles through points of a course that follow each other, m."""
    a, b, c = course.points[:-2], course.points[1:-1], course.points[2:]
    (x, y), (u, v) = (b - a).T, (c - b).T
    area = np.abs(x * v - y * u) / 2
    sides = np.linalg.norm(b - a, axis=1) * np.linalg.norm(c - b, axis=1) * np.linalg.norm(c - a, axis=1)
    with np.errstate(divide="ignore"):
        found: Array = sides / (4 * area)
    return found


def test_curves_are_as_tight_as_they_say() -> None:
    curves = [course for course in courses(1) if course.name not in ("straight line", "right angles")]
    assert len(curves) > 6
    assert min(radii(course).min() for course in curves) == pytest.approx(TIGHTEST, rel=0.02)
    assert [str(a) for a in courses(1)] == [str(a) for a in courses(1)]


def test_goals_are_met_on_curves_and_corners(made: core.Character) -> None:
    figure = next(course for course in courses(1) if course.name == "figure of eight, 2 m")
    for course in (figure, Course("stairs", right_angles(4.0, 3))):
        for gait, most in (("walk", MOST_WALKING), ("run", MOST_RUNNING)):
            row = follow(made, course, gait)
            assert row["mean_m"] <= most, row
            assert row["arrival_m"] <= MOST_FROM_END and abs(row["arrival_s"]) <= MOST_FROM_TIME, row


@pytest.mark.thorough
def test_figures_have_the_fields_that_were_agreed(made: core.Character, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("tools.measuring.directing.__main__.courses", lambda _seed: courses(1)[:1])
    result = measure(made, [], 1)
    assert set(result) == {"paths", "pins", "moves", "styles", "ground"}
    assert {"name", "speed", "mean_m", "max_m", "arrival_m", "arrival_s"} <= set(result["paths"][0])
    assert all(math.isfinite(row["mean_m"]) for row in result["paths"])
    assert {"name", "depth_m", "skate_ratio", "hips_ratio", "thigh_ratio"} <= set(result["ground"][0])


@pytest.mark.thorough
def test_the_command_prints_a_table_and_saves_the_figures(
    folder: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tools.measuring.directing.__main__.courses", lambda _seed: courses(1)[:2])
    target = tmp_path / "figures.json"
    styles = ["--style", "slow=*walk*", "--style", "fast=*run*"]
    assert main([str(folder), "--json", str(target), "--figures", str(tmp_path / "drawn"), *styles]) == 0
    assert [row["name"] for row in json.loads(target.read_text())["styles"]] == ["slow", "fast"]
    assert (tmp_path / "drawn" / "paths.png").stat().st_size > 10000
    saved = json.loads(target.read_text())
    rows, spaces = saved["paths"], saved["spaces"]
    assert [row["name"] for row in rows][:2] == ["straight line, walk", "straight line, jog"]
    printed = capsys.readouterr().out
    assert "circle, 2 m, run" in printed and "from the time, s" in printed
    assert [(row["speeds"], row["directions"]) for row in spaces] == [(1, 4), (2, 8), (3, 8), (4, 16)]
    for row in spaces:
        assert 50 < row["percent_of_optimal"] <= 100 and 0 < row["velocity_error"] < 2 and row["build_s"] > 0
    assert "4 x 16" in printed


def test_the_sample_character_is_directed_unless_told() -> None:
    parser = argparse.ArgumentParser()
    inputs.add_arguments(parser)
    options = parser.parse_args([])
    inputs.check(options)
    assert inputs.needs_blender(options)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--seed", "-1"], "--seed is -1"),
        (["--unit", "0"], "--unit is 0"),
        (["none.bvh"], "no such file or folder"),
        (["--json", "/none/figures.json"], "no such folder"),
        (["--style", "tired"], "--style tired tells no name or no pattern"),
        (["--style", "=*tired*"], "tells no name or no pattern"),
    ],
)
def test_bad_input_is_refused_before_anything_is_measured(
    arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(arguments) == 1
    assert message in capsys.readouterr().err
