# SPDX-License-Identifier: MIT
"""`dev.py beside` on a few sample takes: that both methods are judged alike, that each measure is what it says, and bad
input."""

from __future__ import annotations

import argparse
import json
import math
from pathlib import Path
from typing import Any

import fragmotion_core as core
import numpy as np
import pytest
from conftest import Array, walking_clips
from fragmotion_command.evaluate.loading import Recordings
from sample_motions import write_sample

from tools.measuring.beside import comparing, inputs, measures, tuning
from tools.measuring.beside.__main__ import main
from tools.measuring.beside.motion import footfalls, response
from tools.measuring.beside.motion.likeness import Likeness
from tools.measuring.beside.motion.reenacting import add_likeness
from tools.measuring.beside.setting import Setting, frame_controls, make_setting, sessions
from tools.measuring.beside.systems import Fragments, Matching, Shown, matching
from tools.measuring.beside.table import ROWS, beside_table
from tools.measuring.blend import read_recordings
from tools.measuring.directing.inputs import SAMPLE
from tools.measuring.peers.kinematics.bodies import RATE, Motion, facing
from tools.measuring.peers.motion_matching.constants import Constants, load
from tools.measuring.peers.motion_matching.library import floors_of
from tools.shell import Failure

pytestmark = pytest.mark.thorough

PLAYERS = ("walker", "circler")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("takes")
    write_sample(folder)
    return folder


@pytest.fixture(scope="module")
def made(folder: Path) -> Setting:
    return make_setting(read_recordings([folder], 0.01), 1, seconds=20, classes=30)


@pytest.fixture(scope="module")
def likeness(made: Setting) -> Likeness:
    return Likeness(made.body, *made.takes)


@pytest.fixture(scope="module")
def traces(made: Setting) -> dict[str, Array]:
    return sessions(made.space, 5, PLAYERS, 8)


@pytest.fixture(scope="module")
def peer(made: Setting) -> Matching:
    return matching(made, load(), filled=True)


def performance(made: Setting, roots: Array, trace: Array) -> core.Performance:
    """Of a body that keeps the first take's first pose."""
    rotations = np.repeat(made.takes.captured[0].rotations[:1], len(roots), 0)
    clip = made.body.clip(Motion("made", roots, rotations))
    return core.judge_clip(made.character, trace, clip, [0] * len(roots))


def gliding(made: Setting, trace: Array, velocity: tuple[float, float]) -> core.Performance:
    count = len(frame_controls(trace))
    heading = made.body.clip(made.takes.captured[0]).character_frames(made.body.skeleton)[0, 2]
    cosine, sine = math.cos(heading), math.sin(heading)
    way = np.array([cosine * velocity[0] - sine * velocity[1], sine * velocity[0] + cosine * velocity[1], 0])
    return performance(made, made.takes.captured[0].root[0] + np.arange(count)[:, None] / RATE * way, trace)


# --- what both are judged by -----------------------------------------------------------------------------------------


def test_what_a_player_showed_is_judged_as_the_player(made: Setting, traces: dict[str, Array]) -> None:
    """But for where it faces, which here is told by its poses."""
    trace = traces["walker"]
    shown = Fragments(made).play([trace], [2])[0].judged
    own = core.Player(made.character, 3).run(trace, RATE)
    np.testing.assert_array_equal(shown.root_positions, own.root_positions)
    assert shown.velocity_error == pytest.approx(own.velocity_error, abs=0.03)  # m/s, at a walk
    assert shown.commanded_speed == pytest.approx(own.commanded_speed)
    assert shown.drift == pytest.approx(own.drift, abs=0.02)
    assert made.metrics.of(shown).foot_skate == pytest.approx(made.metrics.of(own).foot_skate, rel=1e-4)


def test_both_show_as_many_frames_as_the_trace_asks_for(made: Setting, peer: Matching) -> None:
    short, long = np.tile([0, 1.2, 0, 0], (13, 1)), np.tile([0, 1.2, 1, 0], (20, 1))
    for shown in (Fragments(made).play([short, long], [0, 1]), peer.play([short, long], [0, 1])):
        assert [len(each.motion.root) for each in shown] == [79, 121]
        assert [len(each.take) for each in shown] == [len(each.at) for each in shown] == [79, 121]


def test_a_body_faces_where_the_core_sees_it_face(made: Setting, traces: dict[str, Array]) -> None:
    shown = Fragments(made).play([traces["circler"]], [0])[0]
    np.testing.assert_allclose(facing(made.body, shown.motion.rotations), shown.judged.path[:, 2], atol=1e-6)


def test_answers_are_timed_as_the_core_times_them(made: Setting) -> None:
    ours = core.response_times(made.character, 1, responsiveness=1.0)
    found = response.response_times(made, Fragments(made, 1.0), 0)
    assert len(found) == len(ours) == 272
    assert np.median(found) == pytest.approx(np.median(ours), abs=0.1)
    assert np.percentile(found, 80) == pytest.approx(np.percentile(ours, 80), rel=0.3)


def test_an_answer_is_timed_from_the_step() -> None:
    frames = np.zeros((100, 3))
    frames[:, 1] = np.cumsum(np.where(np.arange(100) > 40, 1.0, 0.0)) / RATE
    before, after = np.zeros(2), np.array([0.0, 1.0])
    assert response._time(frames, before, after, 20) == pytest.approx(25 / 60)  # 5 of 5 ways of the window at 1 m/s
    assert response._time(frames, before, 2 * after, 20) == core.NO_RESPONSE


# --- measures --------------------------------------------------------------------------------------------------------


def test_the_held_error_leaves_out_what_follows_a_change(made: Setting) -> None:
    trace = np.tile([0, 1.0, 0, 0], (60, 1))
    trace[30:, 1] = 2.0
    shown = Shown(Motion("", np.zeros((0, 3)), np.zeros((0, 1, 4))), gliding(made, trace, (0, 1.0)), trace, trace)
    # A second after the start and the change there are 2 s of no error and 2 s of 1 m/s.
    assert measures.held_error([(shown, trace)]) == pytest.approx(100 * 2 / (2 + 4), abs=1.5)


def test_the_heading_drifts_by_what_is_turned_too_little(made: Setting) -> None:
    trace = np.tile([0, 1.0, 1, 0], (60, 1))
    shown = Shown(Motion("", np.zeros((0, 3)), np.zeros((0, 1, 4))), gliding(made, trace, (0, 1.0)), trace, trace)
    expected = 2 * math.degrees(made.space.turn_rate)
    assert measures._drift_heading(shown, trace, made.space) == pytest.approx(expected, rel=0.01)


def test_the_hips_curve_is_that_of_a_parabola(made: Setting) -> None:
    t = np.arange(120) / RATE
    root = np.column_stack((1.5 * t * t, 0 * t, 0 * t))
    rotations = np.repeat(made.takes.captured[0].rotations[:1], 120, 0)
    found = measures.bodies(made.body, [Motion("", root, rotations)])
    assert found["hips_curve_p99"] == pytest.approx(3.0 * made.body.scale, rel=1e-6)


def test_the_takes_are_like_themselves_and_a_broken_one_is_not(made: Setting, likeness: Likeness) -> None:
    take = made.takes.captured[0]
    assert likeness.of(take)[0][::2].max() < 1e-3 and likeness.of(made.takes.mirrored[0])[0][::2].max() < 1e-3
    broken = take._replace(rotations=take.rotations[:, :1].repeat(len(made.body.parents), 1))
    assert likeness.of(broken)[0].mean() > 5 * likeness.takes > 0


def test_variety_counts_tenths_of_seconds_as_often_as_they_play() -> None:
    def shown(take: list[int], at: list[float]) -> Shown:
        nothing: Any = None
        return Shown(nothing, nothing, np.array(take), np.array(at))

    assert measures.variety([shown([0] * 60, [f / 60 for f in range(60)])]) == pytest.approx(1.0)
    assert measures.variety([shown([0, 1, 1], [0, 0, 0]), shown([0], [0.05])]) == pytest.approx(0.2)
    assert measures.variety([shown([0] * 9 + [1], [0.0] * 10)]) == pytest.approx(0.1 * 0.9**-0.9 * 0.1**-0.1)


def test_feet_that_alternate_are_no_fault(made: Setting) -> None:
    body, takes = made.body, made.takes.captured
    floors = floors_of(body, takes, [*body.toes, *body.feet])
    walk = next(take for take in takes if take.name.startswith("walk_forward"))
    steps, same, quick = footfalls.count(body, walk, floors)
    assert steps >= 4 and same == quick == 0
    limping = walk._replace(rotations=walk.rotations.copy())
    limping.rotations[:, body.legs[0]] = walk.rotations[:1, body.legs[0]]
    limping.rotations[:, body.legs[0][0]] = [math.cos(0.7), math.sin(0.7), 0, 0]  # one leg is held up
    steps, same, _ = footfalls.count(body, limping, floors)
    assert steps == same >= 1


# --- the whole -------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def result(made: Setting, folder: Path) -> dict[str, Any]:
    with pytest.MonkeyPatch.context() as patch:
        for name, rows in (("_LEAST", 2), ("_MOST", 3), ("_AFTER", 4)):
            patch.setattr(response, name, rows)
        patch.setattr(measures, "SEEDS", range(1))
        found = comparing.compare(made, load(), 1, seconds=6)
        add_likeness(found, read_recordings([folder], 0.01), load(), 1, seconds=20, classes=30)
        return json.loads(json.dumps(found, allow_nan=False))  # type: ignore[no-any-return]


def test_every_row_of_every_system_is_filled(result: dict[str, Any]) -> None:
    table = beside_table(result)
    names = [row.name for row in ROWS if "limited" not in row.name]
    assert [row[0] for row in table.rows if "limited" not in row[0]] == names
    assert table.header[1:] == [*result["systems"], "the takes"] and len(result["systems"]) == 4
    for row in table.rows:
        own = row[1:3] if row[0] != "of these, the search" else row[3:5]
        assert all(cell != "-" for cell in [*own, *row[3:5]]), row
    assert all(figures["velocity_error_percent"] > 0 for figures in result["systems"].values())
    assert all(figures["frechet"] > 0 for figures in [result["takes"], *result["systems"].values()])
    assert result["takes"]["unlikeness"] == 1 and result["takes"]["foot_skate_ratio"] == pytest.approx(1)


def test_tuning_keeps_the_best(made: Setting, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tuning, "_SECONDS", 4.0)
    monkeypatch.setattr(tuning, "_PLAYERS", ("walker",))
    tuning.tune(made, 0.1, tmp_path / "tuned.json", 1)
    saved = json.loads((tmp_path / "tuned.json").read_text())
    assert saved["tries"] > 1 and 0 < saved["cost"] < math.inf
    load(tmp_path / "tuned.json")


def test_changes_stay_within_their_limits() -> None:
    random, constants = np.random.default_rng(1), Constants()
    for _ in range(300):
        constants = tuning.changed(constants, random)
        assert constants.search >= 0.03 and constants.unlock <= 0.3
        assert 0.1 / 9 - 1e-9 <= constants.blend <= 0.5 + 1e-9
    assert constants != Constants()


def test_a_player_of_the_comparison_never_jumps(traces: dict[str, Array]) -> None:
    assert all(not trace[:, 3].any() for trace in traces.values())
    assert core.simulate_trace("jumper", 20, 5)[:, 3].any()


@pytest.mark.parametrize(
    ("words", "cause"),
    [
        (["nowhere"], "nowhere: there is no such file or folder"),
        (["TAKES", "--tune", "0"], "--tune is 0 minutes"),
        (["TAKES", "--constants", "none.json"], "none.json: there is no such file of constants"),
        (["TAKES", "--json", "none/out.json"], "none: there is no such folder"),
        (["TAKES", "--seed", "-1"], "--seed is -1"),
    ],
)
def test_bad_input_is_one_line_and_exit_code_1(
    words: list[str], cause: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([str(folder) if word == "TAKES" else word for word in words]) == 1
    message = capsys.readouterr().err
    assert cause in message and message.count("\n") == 1 and message.startswith("beside: ")


def test_takes_may_be_those_of_a_blend() -> None:
    parser = argparse.ArgumentParser()
    inputs.add_arguments(parser)
    inputs.check(parser.parse_args([str(SAMPLE)]))


def test_a_body_without_toes_is_refused(skeleton: core.Skeleton) -> None:
    with pytest.raises(Failure, match="left toe"):
        make_setting(Recordings(skeleton, walking_clips(skeleton)), 1)
