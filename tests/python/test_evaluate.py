# SPDX-License-Identifier: MIT
"""`dev.py evaluate` on a few made takes: what its JSON file says, that a run can be repeated, and bad input."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from importlib.util import find_spec
from pathlib import Path
from typing import Any, NamedTuple

import fragmotion_core as core
import numpy as np
import pytest
from conftest import NAMES, OFFSETS, PARENTS, TIPS, build_options, walking_arrays

from tools.evaluate import curves, inputs, loading, run_time, synthesis, weight
from tools.evaluate.__main__ import main
from tools.evaluate.controllers import summarise, unseen
from tools.evaluate.loading import Session, Sessions
from tools.evaluate.report import (
    Table,
    acceleration_table,
    changes_table,
    following_table,
    run_time_table,
    speeds_table,
    text,
    weight_table,
)
from tools.paths import TOP
from tools.shell import Failure

CLASSES = 12
SEED = 5
NAMED = ("greedy", "svm", "iterate", "anticipate", "optimal")


def y_up(points: Any) -> Any:
    """z-up metres to a BVH file's y-up centimetres."""
    return 100 * np.asarray(points, float)[..., [0, 2, 1]] * (1, 1, -1)


def write_bvh(path: Path, names: list[str], roots: Any, rotations: Any) -> None:
    """A take of the made skeleton, its bones called `names`."""
    lines = ["HIERARCHY"]

    def joint(bone: int, depth: int) -> None:
        children = [child for child, parent in enumerate(PARENTS) if parent == bone]
        offset = " ".join(f"{value:.4f}" for value in y_up(OFFSETS[bone] if bone else [0, 0, 0]))
        channels = "6 Xposition Yposition Zposition" if bone == 0 else "3"
        tip = " ".join(f"{value:.4f}" for value in y_up(TIPS[bone]))
        lines.append(f"{'JOINT' if bone else 'ROOT'} {names[bone]} {{ OFFSET {offset}")
        lines.append(f"CHANNELS {channels} Zrotation Xrotation Yrotation")
        for child in children:
            joint(child, depth + 1)
        if not children:
            lines.append(f"End Site {{ OFFSET {tip} }}")
        lines.append("}")

    joint(0, 0)
    turned = rotations[..., [0, 1, 3, 2]] * (1, 1, 1, -1)
    angles = [np.degrees(core.quaternion_to_euler("YXZ", turned[:, bone])) for bone in range(len(names))]
    columns = np.hstack([y_up(roots), *(angle[:, [2, 0, 1]] for angle in angles)])
    lines += ["MOTION", f"Frames: {len(roots)}", "Frame Time: 0.0333333"]
    lines += [" ".join(f"{value:.5f}" for value in row) for row in columns]
    path.write_text("\n".join(lines) + "\n")


@pytest.fixture(scope="module")
def takes(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder of walks, runs and curves as BVH files."""
    folder = tmp_path_factory.mktemp("takes")
    gaits = [(0, 0, 0), (1.2, 0, 0), (0, 1.2, 0), (-1.2, 0, 0), (3, 0, 0), (1.2, 0, 1.2), (0, 0, 1.2)]
    for i, (speed, side, turn) in enumerate(gaits):
        write_bvh(folder / f"gait_{i}.bvh", NAMES, *walking_arrays(speed, side, turn))
    return folder


@pytest.fixture(scope="module", autouse=True)
def few_processes() -> Iterator[None]:
    """One process for each controller's synthesis: medians are for those who read them."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(synthesis, "_PROCESSES", 1)
        yield


class Run(NamedTuple):
    """What a run of the tool left."""

    folder: Path
    result: dict[str, Any]


def refuse_constant(name: str) -> float:
    raise AssertionError(f"the JSON file holds {name}")


def evaluate(takes: Path, folder: Path, *arguments: str | Path) -> Run:
    """Run the tool without curves."""
    options = ["--classes", CLASSES, "--seed", SEED, "--json", folder / "all.json", "--no-curves", *arguments]
    assert main([str(word) for word in (takes, *options)]) == 0
    return Run(folder, json.loads((folder / "all.json").read_text(), parse_constant=refuse_constant))


@pytest.fixture(scope="module")
def run(takes: Path, tmp_path_factory: pytest.TempPathFactory) -> Run:
    """The tool on the simulated players, with pictures."""
    folder = tmp_path_factory.mktemp("run")
    return evaluate(takes, folder, "--figures", folder / "figures")


def trace(run: Run, kind: str, name: str) -> Any:
    return core.read_trace(run.folder / "figures" / "traces" / kind / f"{name}.csv")


@pytest.fixture(scope="module")
def character(takes: Path, run: Run) -> core.Character:
    """The character that the tool built, built by hand."""
    files = [core.read_bvh(path) for path in sorted(takes.glob("*.bvh"))]
    skeleton = files[0].skeleton
    clips = [core.Clip.from_take(take, skeleton) for take in files]
    options = build_options(classes=CLASSES, seed=SEED, policies=["anticipate", "greedy", "svm", "iterate"])
    return core.build(skeleton, clips, [trace(run, "train", run.result["train"][0])], options)


# --- what is measured ------------------------------------------------------------------------------------------------


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


def test_sessions_are_described(run: Run) -> None:
    for kind in ("train", "test"):
        for name, described in run.result["sessions"][kind].items():
            controls = [tuple(row) for row in trace(run, kind, name)]
            changes = sum(before != after for before, after in zip(controls, controls[1:]))
            assert described["steps"] == len(controls) == 600
            assert described["visited"] == len(set(controls))
            assert described["changes_a_second"] == pytest.approx(changes / 60)


def test_optimal_is_100_and_has_no_run_time(run: Run) -> None:
    optimal = run.result["controllers"]["optimal"]
    assert set(optimal["percent_of_optimal"]["by_trace"].values()) == {100.0}
    figures = dict(optimal["run_time"])
    assert figures.pop("percent_of_optimal") == 100
    assert set(figures.values()) == {None}


def test_percents_after_any_session_are_the_cores(run: Run, character: core.Character) -> None:
    factors = (character.smoothness, character.match)
    matrix = run.result["adaptability"]["anticipate"]["matrix"]
    for train, row in zip(run.result["train"], matrix):
        table = core.anticipate_table(*factors, [character.space.nearest(trace(run, "train", train))])
        for test, percent in zip(run.result["test"], row):
            control = character.space.nearest(trace(run, "test", test))
            assert percent == pytest.approx(core.percent_of_optimal(*factors, table, control), rel=1e-12)


def test_the_bound_is_value_iteration_that_counted_the_test(run: Run, character: core.Character) -> None:
    factors = (character.smoothness, character.match)
    for test, percent in run.result["bound"].items():
        control = character.space.nearest(trace(run, "test", test))
        table = core.iterate_table(*factors, [control])
        assert percent == pytest.approx(core.percent_of_optimal(*factors, table, control), rel=1e-12)


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


def test_ways_to_play_are_measured_beside_the_takes(run: Run, character: core.Character) -> None:
    found = run.result["stitchings"]
    takes = core.MotionMetrics(character).takes
    assert next(iter(found)) == "the takes" and found["the takes"]["foot_skate"] == takes.foot_skate
    assert found["the takes"]["joint_step"] == takes.positions.p999
    traces = [trace(run, "test", test) for test in run.result["test"]]
    plain = {"stitching": "crossfade", "lock_feet": False, "root_adjustment": 0.0, "responsiveness": 1.0}
    yardstick = core.MotionMetrics(character)
    measured = [yardstick.of(core.Player(character, SEED, **plain).run(t, 60)) for t in traces]
    assert found["the takes"]["beyond_limits_share"] == takes.turns.share
    figures = found["plain, as in the paper"]
    assert figures["foot_skate"] == pytest.approx(np.mean([m.foot_skate for m in measured]))
    assert figures["joint_step"] == pytest.approx(max(m.positions.worst for m in measured))
    assert figures["beyond_limits_share"] == pytest.approx(np.mean([m.turns.share for m in measured]))
    assert figures["beyond_limits_degrees"] == pytest.approx(np.degrees(max(m.turns.worst for m in measured)))
    assert found["responsiveness 1"]["response_p95_s"] <= found["responsiveness 0"]["response_p95_s"]


def test_run_time_is_the_players(run: Run, character: core.Character) -> None:
    traces = [trace(run, "test", test) for test in run.result["test"]]
    played = [[core.Player(character, SEED + i, policy="iterate").run(t, 60) for i in range(3)] for t in traces]
    best = [core.optimal_performance(character, t, 60) for t in traces]
    figures = run.result["controllers"]["iterate"]["run_time"]
    percents = [100 * p.quality / top for some, top in zip(played, best) for p in some]
    assert figures["percent_of_optimal"] == pytest.approx(np.mean(percents))
    velocity = np.mean([p.velocity_error for some in played for p in some])
    speed = np.mean([p.commanded_speed for some in played for p in some])
    assert figures["velocity_error"] == pytest.approx(velocity)
    assert figures["velocity_error_percent"] == pytest.approx(100 * velocity / speed)
    drift = np.mean([p.drift for some in played for p in some])
    assert figures["drift_percent"] == pytest.approx(100 * drift / speed)
    assert figures["turn_error"] == pytest.approx(np.degrees(np.mean([p.turn_error for some in played for p in some])))
    assert 0 <= figures["jump_error"] <= 1
    assert 0 < figures["response_p50_s"] <= figures["response_p95_s"] <= 3
    yardstick = core.MotionMetrics(character)
    measured = [yardstick.of(p) for some in played for p in some]
    assert figures["foot_skate_ratio"] == pytest.approx(
        np.mean([m.foot_skate for m in measured]) / yardstick.takes.foot_skate
    )
    assert figures["joint_step_ratio"] > 0
    assert 0 <= figures["sliding_contact_share"] <= 1
    assert figures["beyond_limits_share"] == pytest.approx(np.mean([m.turns.share for m in measured]))
    assert figures["beyond_limits_degrees"] == pytest.approx(np.degrees(max(m.turns.worst for m in measured)))


def test_every_figure_of_the_run_time_is_shown(run: Run) -> None:
    for table, figures in (
        (run_time_table(run.result), run_time.FIGURES),
        (acceleration_table(run.result), run_time.ACCELERATIONS + run_time.BEYOND_PHYSICS),
    ):
        assert len(table.header) == 1 + len(figures)
        assert all(len(row) == len(table.header) for row in table.rows)
    for make in (weight_table, following_table, changes_table, speeds_table):
        table = make(run.result)
        assert table.rows and all(len(row) == len(table.header) for row in table.rows)


def test_response_beyond_physics_is_what_a_body_does_not_need(character: core.Character) -> None:
    space, found = character.space, run_time.responses(character, [3])
    velocities = [space.points[i][:2] for i in range(0, 102, 6)]
    changes = [np.linalg.norm(b - a) for a in velocities for b in velocities if a is not b]
    rest = core.response_times(character, 3) - np.array(changes) * space.scale / 5
    assert found["response_beyond_physics_p50_s"] == pytest.approx(np.median(rest))
    assert found["response_p50_s"] > found["response_beyond_physics_p50_s"]


def test_accelerations_are_second_differences(character: core.Character) -> None:
    performance = core.Player(character, 1).run(core.simulate_trace("walker", 20, 3, character.space), 60)
    path = character.space.scale * performance.root_positions[:, :2]
    pushes = np.linalg.norm(path[24:] - 2 * path[12:-12] + path[:-24], axis=1) / 0.2**2
    hips = core.MotionMetrics(character).of(performance).hips
    assert hips.worst == pytest.approx(pushes.max(), rel=1e-4)
    assert hips.p50 == pytest.approx(np.median(pushes), rel=0.01)
    assert hips.over_6 == pytest.approx((pushes > 6).mean(), abs=1e-3)


def limited(controls: Any, headings: Any, most: float, rate: float = 60) -> Any:
    """Commands [F,2] of a body that faces so, whose velocity in the world changes by `most` m/s^2."""
    going, found = np.zeros(2), []
    for control, heading in zip(controls, headings):
        c, s = np.cos(heading), np.sin(heading)
        asked = np.array([c * control[0] - s * control[1], s * control[0] + c * control[1]])
        change, length = asked - going, np.linalg.norm(asked - going)
        going = going + change * min(1, most / rate / length if length > 0 else 1)
        found.append((c * going[0] + s * going[1], c * going[1] - s * going[0]))
    return np.array(found)


def turned(vectors: Any, angles: Any) -> Any:
    c, s = np.cos(angles), np.sin(angles)
    return np.stack([c * vectors[:, 0] - s * vectors[:, 1], s * vectors[:, 0] + c * vectors[:, 1]], 1)


def test_what_is_followed_is_what_a_body_can_do(character: core.Character) -> None:
    """NumPy's limited command, and the path to which it leads, beside the core's."""
    space, rate = character.space, 60
    trace = core.simulate_trace("walker", 20, 3, space)
    performance = core.Player(character, 1).run(trace, rate)
    path, frames, most = performance.frames, len(performance.frames), 5 / space.scale
    controls = trace[
        np.minimum((np.maximum(0, np.arange(1, frames) - 1) / rate * 10 + 1e-9).astype(int), len(trace) - 1)
    ]
    able = limited(controls, path[1:, 2], most)
    slopes = []
    for f in range(1, frames):
        around = np.arange(max(0, f - 15), min(frames - 1, f + 15) + 1)
        slopes.append(np.polyfit(around, path[around, :2], 1)[0] * rate)
    seen = turned(np.array(slopes), -path[1:, 2])
    assert performance.velocity_error_limited == pytest.approx(np.linalg.norm(seen - able, axis=1).mean(), rel=1e-6)

    for limit, drift, drift_heading in (
        (most, performance.drift_limited, performance.drift_heading_limited),
        (np.inf, performance.drift, performance.drift_heading),
    ):
        angle = controls[:, 2] * space.turn_rate / rate
        headings = np.concatenate([[0], np.cumsum(angle)])
        exact = limited(controls, headings[:-1], limit)
        places = np.concatenate([[[0, 0]], np.cumsum(turned(exact, headings[:-1] + angle / 2) / rate, 0)])
        span, off = 2 * rate, path[:, 2] - headings
        led = turned(places[span:] - places[:-span], off[:-span])
        away = np.linalg.norm(path[span:, :2] - path[:-span, :2] - led, axis=1)
        assert drift == pytest.approx(away.mean() / 2, rel=1e-6)
        assert drift_heading == pytest.approx(np.abs(off[span:] - off[:-span]).mean(), rel=1e-6)


def test_weight_is_that_of_the_performances(run: Run, character: core.Character) -> None:
    traces = [trace(run, "test", test) for test in run.result["test"]]
    played = [core.Player(character, SEED + i, policy="iterate").run(t, 60) for t in traces for i in range(3)]
    yardstick = core.MotionMetrics(character)
    measured = [yardstick.of(p) for p in played]
    figures, takes = run.result["controllers"]["iterate"]["run_time"], run.result["takes"]
    assert figures["unsupported"] == pytest.approx(np.mean([m.unsupported for m in measured]))
    assert 0 <= figures["unsupported"] <= 1 and takes["unsupported"] == yardstick.takes.unsupported
    steps = sum(m.footfalls.count for m in measured)
    assert figures["same_foot"] == pytest.approx(sum(m.footfalls.same_foot for m in measured) / steps)
    assert figures["quick_steps"] == pytest.approx(sum(m.footfalls.quick for m in measured) / steps)
    assert figures["yaw_acceleration_max"] == pytest.approx(np.degrees(max(m.yaw.worst for m in measured)))
    commanded = np.mean([p.commanded_speed for p in played])
    limited_error = np.mean([p.velocity_error_limited for p in played])
    assert figures["velocity_error_limited"] == pytest.approx(100 * limited_error / commanded)
    assert figures["drift"] == figures["drift_percent"]
    assert figures["drift_heading"] == pytest.approx(np.degrees(np.mean([p.drift_heading for p in played])))


def test_dips_are_beside_the_takes_where_these_jump(run: Run) -> None:
    """The made takes do not."""
    figures, takes = run.result["controllers"]["anticipate"]["run_time"], run.result["takes"]
    assert takes["jump_dip"] is None and takes["flight_time_ratio"] is None
    assert figures["jump_dip_ratio"] is None and figures["landing_dip_ratio"] is None
    assert weight_table(run.result).rows[0][0] == "the takes" and "-" in weight_table(run.result).rows[0]
    assert weight.ratio(0.3, 0.6) == 0.5 and weight.ratio(0.3, 0) is None and weight.ratio(None, 1.0) is None


def test_trials_are_the_players(run: Run, character: core.Character) -> None:
    seeds = [SEED, SEED + 1, SEED + 2]
    figures = run.result["controllers"]["greedy"]["run_time"]
    times = [core.about_face_times(character, seed, policy="greedy") for seed in seeds]
    assert figures["about_face_s"] == pytest.approx(np.mean(times))
    rows = [core.speed_ripples(character, seed, policy="greedy") for seed in seeds]
    assert [row["speed"] for row in figures["speed_ripple"]] == [0.5, 1, 1.5, 2, 2.5, 3]
    for i, row in enumerate(figures["speed_ripple"]):
        assert row["mean"] * row["speed"] == pytest.approx(np.mean([some[i].speed for some in rows]))
        assert row["ripple"] == pytest.approx(np.mean([some[i].ripple for some in rows]))
        assert row["takes_ripple"] == rows[0][i].takes_ripple and row["takes_speed"] == rows[0][i].takes_speed
    ratios = [row["ripple"] / row["takes_ripple"] for row in figures["speed_ripple"] if row["takes_ripple"] > 0]
    assert figures["speed_ripple_ratio"] == (pytest.approx(np.mean(ratios)) if ratios else None)
    pushes = [core.change_pushes(character, seed, policy="greedy") for seed in seeds]
    assert set(figures["acceleration_by_change"]) == {"start", "stop", "reverse", "turn", "gait"}
    for kind, found in figures["acceleration_by_change"].items():
        assert found["max"] == max(some[kind].worst for some in pushes)
        assert found["p99"] == pytest.approx(np.mean([some[kind].p99 for some in pushes]))


def test_a_quick_run_has_the_same_figures(run: Run, takes: Path, tmp_path: Path, capsys: Any) -> None:
    saved = run.folder / "figures" / "traces"
    train = [saved / "train" / f"{name}.csv" for name in run.result["train"]]
    test = [saved / "test" / f"{name}.csv" for name in run.result["test"]]
    quick = evaluate(takes, tmp_path, "--quick", "--train", *train, "--test", *test).result
    assert quick["takes"] == run.result["takes"]
    assert quick["controllers"]["anticipate"]["run_time"] == run.result["controllers"]["anticipate"]["run_time"]
    shown = capsys.readouterr().out
    assert all(key in shown for key in run_time.ALL if key not in ("speed_ripple", "acceleration_by_change"))


def without_costs(value: Any) -> Any:
    """Without times and bytes."""
    if isinstance(value, dict):
        costs = {"build_seconds", "synthesis_seconds", "peak_bytes"}
        return {key: without_costs(inner) for key, inner in value.items() if key not in costs}
    return value


def test_a_run_is_repeated_by_its_traces(run: Run, takes: Path, tmp_path: Path) -> None:
    saved = run.folder / "figures" / "traces"
    train = [saved / "train" / f"{name}.csv" for name in run.result["train"]]
    test = [saved / "test" / f"{name}.csv" for name in run.result["test"]]
    again = evaluate(takes, tmp_path, "--train", *train, "--test", *test)
    assert without_costs(again.result) == without_costs(run.result)


def test_pictures_are_drawn_and_small(run: Run) -> None:
    pictures = {path.stem: path.stat().st_size for path in (run.folder / "figures").glob("*.png")}
    assert set(pictures) == {"traces", "adaptability", "run-time", "coverage"}
    assert all(1_000 < size < 300_000 for size in pictures.values())


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
    assert main([str(takes), *wanted, "--train", *files, "--test", *files]) == 0
    result = json.loads((tmp_path / "all.json").read_text(), parse_constant=refuse_constant)
    assert [row["classes"] for row in result["classes_curve"]] == [4, 8]
    assert [row["minutes"] for row in result["minutes_curve"]] == [0.1, 0.2]
    for row in (*result["classes_curve"], *result["minutes_curve"]):
        assert 0 < row["percent_of_optimal"] <= 100 + 1e-9 and 0 < row["quality_per_step"] <= 1
        assert row["velocity_error"] > 0 and row["build_seconds"] > 0
    assert (tmp_path / "classes.png").exists() and (tmp_path / "minutes.png").exists()
    assert "against the number of classes" in capsys.readouterr().out


def test_one_session_to_learn_from_is_paired_with_all_tests() -> None:
    sessions = [Session(name, np.zeros((2, 4)), np.zeros(2, np.int32)) for name in ("a", "b")]
    assert unseen(Sessions(sessions[:1], sessions)) == [[True, True]]
    assert unseen(Sessions(sessions, sessions)) == [[False, True], [True, False]]
    assert summarise([[80.0]], [[True]]) == {"mean": 80.0, "sd": 0.0, "min": 80.0, "max": 80.0}


def test_peak_memory_is_what_the_work_needed() -> None:
    def peak(count: int) -> int | None:
        return synthesis.peak_memory(lambda: b"x" * count)

    large, small = peak(50_000_000), peak(5_000_000)
    if large is None or small is None:
        pytest.skip("this system does not tell a process's peak memory")
    assert large == pytest.approx(50e6, rel=0.1)
    assert small == pytest.approx(5e6, abs=2e6), "but for what else the process does meanwhile"


def test_tables_are_aligned() -> None:
    table = Table("Title", ["name", "long heading"], [["a", "1.0"], ["longer", "22.5"]])
    assert text(table).splitlines() == ["Title", "name    long heading", "a                1.0", "longer          22.5"]


def test_the_sample_rigs_actions_are_takes() -> None:
    """In a process of its own: bpy is no neighbour for other tests."""
    if find_spec("bpy") is None:
        pytest.skip("Blender's module bpy is not installed here")
    code = (
        "import sys; from pathlib import Path; from tools.evaluate.loading import read_recordings as read;"
        "r = read([Path(sys.argv[1])], 0.01); print('read:', len(r.clips), len(r.skeleton.names), r.skeleton.stature)"
    )
    command = [sys.executable, "-c", code, str(TOP / "sample_rigs" / "fragmotion_sample.blend")]
    answer = subprocess.run(command, cwd=TOP, capture_output=True, text=True, check=True)
    said = next(line for line in answer.stdout.splitlines() if line.startswith("read:"))  # Blender speaks, too
    takes, bones, stature = said.split()[1:]
    assert int(takes) >= 20 and int(bones) >= 15 and 1.5 < float(stature) < 2.1


# --- bad input -------------------------------------------------------------------------------------------------------


def empty_folder(folder: Path) -> list[str | Path]:
    (folder / "empty").mkdir()
    return [folder / "empty"]


def other_skeleton(folder: Path) -> list[str | Path]:
    names = [name.replace("spine", "back") for name in NAMES]
    write_bvh(folder / "other.bvh", names, *walking_arrays())
    return [folder / "take.bvh", folder / "other.bvh"]


def broken_trace(folder: Path) -> list[str | Path]:
    (folder / "bad.csv").write_text("velocity_x,velocity_y,turn,jump\n0,1,0,0\n0,fast,0,0\n")
    return [folder / "take.bvh", "--train", folder / "bad.csv"]


def short_trace(folder: Path) -> list[str | Path]:
    (folder / "short.csv").write_text("velocity_x,velocity_y,turn,jump\n0,1,0,0\n")
    return [folder / "take.bvh", "--test", folder / "short.csv"]


def namesakes(folder: Path) -> list[str | Path]:
    (folder / "a").mkdir()
    for path in (folder / "p.csv", folder / "a" / "p.csv"):
        core.write_trace(path, core.simulate_trace("walker", 5))
    return [folder / "take.bvh", "--test", folder / "p.csv", folder / "a" / "p.csv"]


def broken_take(folder: Path) -> list[str | Path]:
    (folder / "broken.bvh").write_text("HIERARCHY\nROOT hips\n")
    return [folder / "broken.bvh"]


BAD: list[tuple[Callable[[Path], list[str | Path]], str]] = [
    (lambda folder: [folder / "nowhere"], "nowhere: there is no such file or folder"),
    (empty_folder, "empty: no takes in this folder"),
    (lambda folder: [TOP / "dev.py"], "dev.py: not motion capture"),
    (broken_take, "broken.bvh:"),
    (other_skeleton, "other.bvh: its skeleton is not that of take.bvh: bone 'back'"),
    (lambda folder: [folder / "take.bvh", "--train", folder / "none.csv"], "none.csv: there is no such trace file"),
    (broken_trace, "bad.csv:3:"),
    (short_trace, "short.csv"),
    (namesakes, "2 traces are called p"),
    (lambda folder: [folder / "take.bvh", "--classes", "0"], "--classes is 0"),
    (lambda folder: [folder / "take.bvh", "--classes", "5000"], "5000"),
    (lambda folder: [folder / "take.bvh", "--responsiveness", "1.5"], "--responsiveness is 1.5"),
    (
        lambda folder: [folder / "take.bvh", "--quick", "--figures", folder / "f"],
        "--figures draws what --quick does not",
    ),
    (lambda folder: [folder / "take.bvh", "--json", folder / "take.bvh" / "x.json"], "take.bvh: not a folder"),
    (lambda folder: [folder / "a.blend", folder / "take.bvh"], "a.blend: a .blend has its own rig"),
]


@pytest.mark.parametrize(("prepare", "cause"), BAD)
def test_bad_input_is_one_line_and_exit_code_1(
    prepare: Callable[[Path], list[str | Path]],
    cause: str,
    takes: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    shutil.copy(takes / "gait_1.bvh", tmp_path / "take.bvh")
    (tmp_path / "a.blend").write_bytes(b"BLENDER")
    assert main([str(word) for word in prepare(tmp_path)]) == 1
    message = capsys.readouterr().err
    assert cause in message and message.count("\n") == 1 and message.startswith("evaluate: ")


def test_an_amc_goes_with_its_asf(tmp_path: Path) -> None:
    for name in ("02.asf", "07.asf", "02_01.amc", "._02_01.amc"):
        (tmp_path / name).touch()
    (found,) = inputs.find_takes([tmp_path])
    assert found.path.name == "02_01.amc" and found.asf is not None and found.asf.name == "02.asf"
    (tmp_path / "09_01.amc").touch()
    with pytest.raises(Failure, match=r"09_01\.amc: its skeleton 09\.asf is not in the folder"):
        inputs.find_takes([tmp_path])


def test_takes_in_a_file_are_those_that_were_written(takes: Path) -> None:
    """The oracle of this file's own writer: the walk goes forward as far as it was made to."""
    clip = loading.read_recordings([takes / "gait_1.bvh"], 0.01).clips[0]
    roots, _ = walking_arrays(1.2)
    np.testing.assert_allclose(clip.root_positions - clip.root_positions[0], roots - roots[0], atol=1e-4)
