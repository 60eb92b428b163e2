# SPDX-License-Identifier: MIT
"""The run time's figures of `fragmotion evaluate`, beside the core's players and NumPy."""

from __future__ import annotations

from typing import Any

import fragmotion_core as core
import numpy as np
import pytest
from evaluated import SEED, Run, trace
from fragmotion_command.evaluate.measures import run_time, weight
from fragmotion_command.evaluate.report import (
    acceleration_table,
    changes_table,
    following_table,
    run_time_table,
    speeds_table,
    weight_table,
)

pytest_plugins = ["evaluated"]


@pytest.mark.thorough
def test_ways_to_play_are_measured_beside_the_takes(run: Run, built: core.Character) -> None:
    found = run.result["stitchings"]
    takes = core.MotionMetrics(built).takes
    assert next(iter(found)) == "the takes" and found["the takes"]["foot_skate"] == takes.foot_skate
    assert found["the takes"]["joint_step"] == takes.positions.p999
    traces = [trace(run, "test", test) for test in run.result["test"]]
    plain = {"stitching": "crossfade", "lock_feet": False, "root_adjustment": 0.0, "responsiveness": 1.0}
    yardstick = core.MotionMetrics(built)
    measured = [yardstick.of(core.Player(built, SEED, **plain).run(t, 60)) for t in traces]
    assert found["the takes"]["beyond_limits_share"] == takes.turns.share
    figures = found["plain, as in the paper"]
    assert figures["foot_skate"] == pytest.approx(np.mean([m.foot_skate for m in measured]))
    assert figures["joint_step"] == pytest.approx(max(m.positions.worst for m in measured))
    assert figures["beyond_limits_share"] == pytest.approx(np.mean([m.turns.share for m in measured]))
    assert figures["beyond_limits_degrees"] == pytest.approx(np.degrees(max(m.turns.worst for m in measured)))
    assert found["responsiveness 1"]["response_p50_s"] < 0.5 * found["responsiveness 0"]["response_p50_s"]


@pytest.mark.thorough
def test_run_time_is_the_players(run: Run, built: core.Character) -> None:
    traces = [trace(run, "test", test) for test in run.result["test"]]
    played = [[core.Player(built, SEED + i, policy="iterate").run(t, 60) for i in range(3)] for t in traces]
    best = [core.optimal_performance(built, t, 60) for t in traces]
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
    assert 0 < figures["response_p50_s"] <= figures["response_p95_s"] <= core.NO_RESPONSE
    assert 0 <= figures["no_response_share"] <= 1
    assert (figures["response_p95_s"] < core.NO_RESPONSE) or (figures["no_response_share"] >= 0.05)
    yardstick = core.MotionMetrics(built)
    measured = [yardstick.of(p) for some in played for p in some]
    assert figures["foot_skate_ratio"] == pytest.approx(
        np.mean([m.foot_skate for m in measured]) / yardstick.takes.foot_skate
    )
    assert figures["foot_turn_ratio"] == pytest.approx(
        np.mean([m.foot_turn for m in measured]) / yardstick.takes.foot_turn
    )
    assert figures["joint_step_ratio"] > 0
    assert 0 <= figures["sliding_contact_share"] <= 1
    assert figures["beyond_limits_share"] == pytest.approx(np.mean([m.turns.share for m in measured]))
    assert figures["beyond_limits_degrees"] == pytest.approx(np.degrees(max(m.turns.worst for m in measured)))


@pytest.mark.thorough
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


@pytest.mark.thorough
def test_response_beyond_physics_is_what_a_body_does_not_need(built: core.Character) -> None:
    space, found = built.space, run_time.responses(built, [3])
    velocities = list(built.able(space.points[::6])[:, :2])
    changes = np.array([np.linalg.norm(b - a) for a in velocities for b in velocities if a is not b])
    rest = (core.response_times(built, 3) - changes * space.scale / 5)[changes > 0]
    assert found["response_beyond_physics_p50_s"] == pytest.approx(np.median(rest))
    assert found["response_p50_s"] > found["response_beyond_physics_p50_s"]


@pytest.mark.thorough
def test_accelerations_are_second_differences(built: core.Character) -> None:
    performance = core.Player(built, 1).run(core.simulate_trace("walker", 20, 3, built.space), 60)
    path = built.space.scale * performance.root_positions[:, :2]
    pushes = np.linalg.norm(path[24:] - 2 * path[12:-12] + path[:-24], axis=1) / 0.2**2
    hips = core.MotionMetrics(built).of(performance).hips
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


@pytest.mark.thorough
def test_what_is_followed_is_what_a_body_can_do(built: core.Character) -> None:
    """NumPy's limited command, and the path to which it leads, beside the core's."""
    space, rate = built.space, 60
    trace = core.simulate_trace("walker", 20, 3, space)
    performance = core.Player(built, 1).run(trace, rate)
    path, frames, most = performance.path, len(performance.path), 5 / space.scale
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
        asked = turned(places[span:] - places[:-span], off[:-span])
        away = np.linalg.norm(path[span:, :2] - path[:-span, :2] - asked, axis=1)
        assert drift == pytest.approx(away.mean() / 2, rel=1e-6)
        assert drift_heading == pytest.approx(np.abs(off[span:] - off[:-span]).mean(), rel=1e-6)


@pytest.mark.thorough
def test_weight_is_that_of_the_performances(run: Run, built: core.Character) -> None:
    traces = [trace(run, "test", test) for test in run.result["test"]]
    played = [core.Player(built, SEED + i, policy="iterate").run(t, 60) for t in traces for i in range(3)]
    yardstick = core.MotionMetrics(built)
    measured = [yardstick.of(p) for p in played]
    figures = run.result["controllers"]["iterate"]["run_time"]
    steps = sum(m.footfalls.count for m in measured)
    assert figures["same_foot"] == pytest.approx(sum(m.footfalls.same_foot for m in measured) / steps)
    assert figures["quick_steps"] == pytest.approx(sum(m.footfalls.quick for m in measured) / steps)
    assert figures["dragged_share"] == pytest.approx(np.mean([m.dragged_share for m in measured]))
    assert figures["yaw_acceleration_max"] == pytest.approx(np.degrees(max(m.yaw.worst for m in measured)))
    commanded = np.mean([p.commanded_speed for p in played])
    limited_error = np.mean([p.velocity_error_limited for p in played])
    assert figures["velocity_error_limited"] == pytest.approx(100 * limited_error / commanded)
    assert figures["drift"] == figures["drift_percent"]
    assert figures["drift_heading"] == pytest.approx(np.degrees(np.mean([p.drift_heading for p in played])))


@pytest.mark.thorough
def test_dips_are_beside_the_takes_where_these_jump(run: Run) -> None:
    """The made takes do not."""
    figures, takes = run.result["controllers"]["anticipate"]["run_time"], run.result["takes"]
    assert takes["jump_dip"] is None and takes["flight_time_ratio"] is None
    assert figures["jump_dip_ratio"] is None and figures["landing_dip_ratio"] is None
    assert weight_table(run.result).rows[0][0] == "the takes" and "-" in weight_table(run.result).rows[0]
    assert weight.ratio(0.3, 0.6) == 0.5 and weight.ratio(0.3, 0) is None and weight.ratio(None, 1.0) is None


@pytest.mark.thorough
def test_trials_are_the_players(run: Run, built: core.Character) -> None:
    seeds = [SEED, SEED + 1, SEED + 2]
    figures = run.result["controllers"]["greedy"]["run_time"]
    times = [core.about_face_times(built, seed, policy="greedy") for seed in seeds]
    assert figures["about_face_s"] == pytest.approx(np.mean(times))
    rows = [core.speed_ripples(built, seed, policy="greedy") for seed in seeds]
    assert [row["speed"] for row in figures["speed_ripple"]] == [0.5, 1, 1.5, 2, 2.5, 3]
    for i, row in enumerate(figures["speed_ripple"]):
        assert row["mean"] * row["speed"] == pytest.approx(np.mean([some[i].speed for some in rows]))
        assert row["ripple"] == pytest.approx(np.mean([some[i].ripple for some in rows]))
        assert row["bob"] == pytest.approx(np.mean([some[i].bob for some in rows]))
        assert row["takes_bob"] == rows[0][i].takes_bob
        assert row["steps"] == pytest.approx(np.mean([some[i].steps for some in rows]))
        assert row["takes_steps"] == rows[0][i].takes_steps
        assert row["takes_ripple"] == rows[0][i].takes_ripple and row["takes_speed"] == rows[0][i].takes_speed
    ratios = [row["ripple"] / row["takes_ripple"] for row in figures["speed_ripple"] if row["takes_ripple"] > 0]
    assert figures["speed_ripple_ratio"] == (pytest.approx(np.mean(ratios)) if ratios else None)
    bobs = [row["bob"] / row["takes_bob"] for row in figures["speed_ripple"] if row["takes_bob"] > 0]
    assert figures["bob_ratio"] == (pytest.approx(np.mean(bobs)) if bobs else None)
    rates = [row["steps"] / row["takes_steps"] for row in figures["speed_ripple"] if row["takes_steps"]]
    assert figures["step_rate_ratio"] == (pytest.approx(np.mean(rates)) if rates else None)
    pushes = [core.change_pushes(built, seed, policy="greedy") for seed in seeds]
    assert set(figures["acceleration_by_change"]) == {"start", "stop", "reverse", "turn", "gait"}
    for kind, found in figures["acceleration_by_change"].items():
        assert found["max"] == max(some[kind].worst for some in pushes)
        assert found["p99"] == pytest.approx(np.mean([some[kind].p99 for some in pushes]))
        assert found["dragged"] == pytest.approx(np.mean([some[kind].dragged for some in pushes]))
