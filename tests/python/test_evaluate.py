# SPDX-License-Identifier: MIT
"""`fragmotion evaluate` on a few made takes: what its JSON file says, and that a run can be repeated."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import fragmotion_core as core
import numpy as np
import pytest
from evaluated import CLASSES, Run, command, evaluate, refuse_constant, trace
from fragmotion_command.evaluate.loading import Session, Sessions
from fragmotion_command.evaluate.measures import curves, run_time, weight
from fragmotion_command.evaluate.measures.controllers import summarise, unseen
from fragmotion_command.evaluate.report import LIKENESS, Table, text

pytest_plugins = ["evaluated"]

NAMED = ("greedy", "svm", "iterate", "anticipate", "optimal")


@pytest.mark.thorough
def test_the_json_file_is_laid_out_as_documented(run: Run) -> None:
    result = run.result
    assert tuple(result["controllers"]) == NAMED and result["default"] == "anticipate"
    for name, figures in result["controllers"].items():
        assert set(figures) == {"percent_of_optimal", "synthesis_seconds", "peak_bytes", "online", "run_time"}
        assert set(figures["percent_of_optimal"]) == {"mean", "sd", "min", "by_trace"}
        assert set(figures["percent_of_optimal"]["by_trace"]) == set(core.PLAYERS) == set(result["bound"])
        assert set(figures["run_time"]) == set(run_time.ALL)
        assert figures["synthesis_seconds"] > 0 and figures["online"] == (name != "optimal")
    assert set(result["takes"]) == {"count", *run_time.ACCELERATIONS, *weight.SEEN}
    assert len(result["coverage"]) == len(result["coverage_counts"]) == 102
    assert sum(result["coverage_counts"]) == result["fragments"]
    assert result["classes"] == CLASSES and result["build_seconds"] > 0
    assert sorted(result["train"]) == sorted(result["test"]) == sorted(core.PLAYERS)
    assert set(result["adaptability"]) == set(NAMED[:-1])
    assert set(result["likeness"]) == {"takes", "played"}
    assert set(result["likeness"]["played"]) == set(LIKENESS) == {*result["likeness"]["takes"], "successors"}


@pytest.mark.thorough
def test_sessions_are_described(run: Run) -> None:
    for kind in ("train", "test"):
        for name, described in run.result["sessions"][kind].items():
            controls = [tuple(row) for row in trace(run, kind, name)]
            changes = sum(before != after for before, after in zip(controls, controls[1:]))
            assert described["steps"] == len(controls) == 600
            assert described["visited"] == len(set(controls))
            assert described["changes_a_second"] == pytest.approx(changes / 60)


@pytest.mark.thorough
def test_optimal_is_100_and_has_no_run_time(run: Run) -> None:
    optimal = run.result["controllers"]["optimal"]
    assert set(optimal["percent_of_optimal"]["by_trace"].values()) == {100.0}
    figures = dict(optimal["run_time"])
    assert figures.pop("percent_of_optimal") == 100
    assert set(figures.values()) == {None}


@pytest.mark.thorough
def test_percents_after_any_session_are_the_cores(run: Run, built: core.Character) -> None:
    factors = (built.smoothness, built.match)
    matrix = run.result["adaptability"]["anticipate"]["matrix"]
    for train, row in zip(run.result["train"], matrix):
        table = core.anticipate_table(*factors, [built.space.nearest(trace(run, "train", train))])
        for test, percent in zip(run.result["test"], row):
            control = built.space.nearest(trace(run, "test", test))
            assert percent == pytest.approx(core.percent_of_optimal(*factors, table, control), rel=1e-12)


@pytest.mark.thorough
def test_the_bound_is_value_iteration_that_counted_the_test(run: Run, built: core.Character) -> None:
    factors = (built.smoothness, built.match)
    for test, percent in run.result["bound"].items():
        control = built.space.nearest(trace(run, "test", test))
        table = core.iterate_table(*factors, [control])
        assert percent == pytest.approx(core.percent_of_optimal(*factors, table, control), rel=1e-12)


@pytest.mark.thorough
def test_means_are_over_pairs_of_different_players(run: Run) -> None:
    names = run.result["train"], run.result["test"]
    different = np.array(names[0])[:, None] != np.array(names[1])
    for name, found in run.result["adaptability"].items():
        matrix = np.array(found["matrix"])
        percents = run.result["controllers"][name]["percent_of_optimal"]
        assert percents["mean"] == pytest.approx(matrix[different].mean())
        assert percents["sd"] == pytest.approx(matrix[different].std(ddof=1))
        assert percents["min"] == matrix[different].min()
        for i, test in enumerate(names[1]):
            assert percents["by_trace"][test] == pytest.approx(matrix[different[:, i], i].mean())


@pytest.mark.thorough
def test_a_quick_run_has_the_same_figures(run: Run, takes: Path, tmp_path: Path, capsys: Any) -> None:
    saved = run.folder / "figures" / "traces"
    train = [saved / "train" / f"{name}.csv" for name in run.result["train"]]
    test = [saved / "test" / f"{name}.csv" for name in run.result["test"]]
    quick = evaluate(takes, tmp_path, "--quick", "--train", *train, "--test", *test).result
    assert quick["takes"] == run.result["takes"] and quick["likeness"] == run.result["likeness"]
    assert quick["controllers"]["anticipate"]["run_time"] == run.result["controllers"]["anticipate"]["run_time"]
    shown = capsys.readouterr().out
    assert all(key in shown for key in run_time.ALL if key not in ("speed_ripple", "acceleration_by_change"))
    assert all(name in shown for name in LIKENESS.values())


def without_costs(value: Any) -> Any:
    """Without times and bytes."""
    if isinstance(value, dict):
        costs = {"build_seconds", "synthesis_seconds", "peak_bytes"}
        return {key: without_costs(inner) for key, inner in value.items() if key not in costs}
    return value


@pytest.mark.thorough
def test_a_run_is_repeated_by_its_traces(run: Run, takes: Path, tmp_path: Path) -> None:
    saved = run.folder / "figures" / "traces"
    train = [saved / "train" / f"{name}.csv" for name in run.result["train"]]
    test = [saved / "test" / f"{name}.csv" for name in run.result["test"]]
    again = evaluate(takes, tmp_path, "--train", *train, "--test", *test)
    assert without_costs(again.result) == without_costs(run.result)


@pytest.mark.thorough
def test_pictures_are_drawn_and_small(run: Run) -> None:
    pictures = {path.stem: path.stat().st_size for path in (run.folder / "figures").glob("*.png")}
    assert set(pictures) == {"traces", "adaptability", "run-time", "coverage"}
    assert all(1_000 < size < 300_000 for size in pictures.values())


@pytest.mark.thorough
def test_curves_have_a_row_for_each_point(
    takes: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Numbers of classes beyond the fragments are left out."""
    monkeypatch.setattr(curves, "CLASSES", (4, 8, 10_000))
    monkeypatch.setattr(curves, "MINUTES", (0.1, 0.2))
    for name in ("walker", "runner"):
        core.write_trace(tmp_path / f"{name}.csv", core.simulate_trace(name, 5))
    files = [str(tmp_path / f"{name}.csv") for name in ("walker", "runner")]
    wanted = ["--classes", "6", "--json", str(tmp_path / "all.json"), "--figures", str(tmp_path)]
    assert command(takes, *wanted, "--train", *files, "--test", *files) == 0
    result = json.loads((tmp_path / "all.json").read_text(), parse_constant=refuse_constant)
    assert [row["classes"] for row in result["classes_curve"]] == [4, 8]
    assert [row["minutes"] for row in result["minutes_curve"]] == [0.1, 0.2]
    for row in (*result["classes_curve"], *result["minutes_curve"]):
        assert 0 < row["percent_of_optimal"] <= 100 + 1e-9 and 0 < row["quality_per_step"] <= 1
        assert row["velocity_error"] > 0 and row["build_seconds"] > 0
    assert (tmp_path / "classes.png").exists() and (tmp_path / "minutes.png").exists()
    assert "against the number of classes" in capsys.readouterr().out


@pytest.mark.thorough
def test_takes_that_cannot_be_halved_are_measured_but_for_their_likeness(
    takes: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    quick = evaluate(takes / "gait_1.bvh", tmp_path, "--quick").result
    assert "likeness" not in quick and quick["controllers"]["anticipate"]["run_time"]["velocity_error"] > 0
    assert "likeness to the takes: not measured: that takes two halves of takes" in capsys.readouterr().err


def test_one_session_to_learn_from_is_paired_with_all_tests() -> None:
    sessions = [Session(name, np.zeros((2, 4)), np.zeros(2, np.int32)) for name in ("a", "b")]
    assert unseen(Sessions(sessions[:1], sessions)) == [[True, True]]
    assert unseen(Sessions(sessions, sessions)) == [[False, True], [True, False]]
    assert summarise([[80.0]], [[True]]) == {"mean": 80.0, "sd": 0.0, "min": 80.0, "max": 80.0}


def test_peak_memory_is_what_the_work_needed() -> None:
    # As measured: in a process of its own. NumPy leaves memory behind that Linux then gives out in pages of 2 MB.
    program = """
import json
from fragmotion_command.evaluate.measures import synthesis
print(json.dumps([synthesis.peak_memory(lambda: b"x" * count) for count in (50_000_000, 5_000_000)]))
"""
    paths = {"PYTHONPATH": os.pathsep.join(sys.path)}
    large, small = json.loads(
        subprocess.run(
            [sys.executable, "-c", program], env={**os.environ, **paths}, stdout=subprocess.PIPE, check=True
        ).stdout
    )
    if large is None or small is None:
        pytest.skip("Windows, and a /proc that cannot be written, do not tell a process's peak memory")
    assert large == pytest.approx(50e6, rel=0.1)
    assert small == pytest.approx(5e6, abs=2e6), "but for what else the process does meanwhile"


def test_tables_are_aligned() -> None:
    table = Table("Title", ["name", "long heading"], [["a", "1.0"], ["longer", "22.5"]])
    assert text(table).splitlines() == ["Title", "name    long heading", "a                1.0", "longer          22.5"]
