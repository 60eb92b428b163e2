# SPDX-License-Identifier: MIT
"""Moves: waves and steps that are put over, or into, a character's locomotion."""

from __future__ import annotations

import fragmotion_core as core
import numpy as np
import pytest
from conftest import CMU, NAMES, Array, build_options, walking_arrays

from tools.measuring.directing.measures.moves import moves as measured_moves

LUNGE, WAVE = 0, 1


def lunge(skeleton: core.Skeleton) -> core.Clip:
    """One second in which a standing body goes half a metre ahead."""
    roots, rotations = walking_arrays(0.0, seconds=1.0)
    t = np.linspace(0, 1, len(roots))
    roots[:, 1] += 0.5 * t * t * (3 - 2 * t)
    return core.Clip(skeleton, "lunge", 30.0, roots, rotations)


def wave(skeleton: core.Skeleton) -> core.Clip:
    """Two seconds in which a standing body lifts its right arm, and lowers it."""
    roots, rotations = walking_arrays(0.0, seconds=2.0)
    angle = 2.5 * np.sin(np.linspace(0, np.pi, len(roots))) ** 2
    rotations[:, NAMES.index("hand.R")] = np.stack([np.cos(angle / 2), 0 * angle, np.sin(angle / 2), 0 * angle], 1)
    return core.Clip(skeleton, "wave", 30.0, roots, rotations)


@pytest.fixture(scope="module")
def moving(character: core.Character) -> core.Character:
    skeleton = character.skeleton
    return character.with_moves(
        [core.Move("lunge", lunge(skeleton)), core.Move("wave", wave(skeleton), True, 0.3, (0.8, 1.2))]
    )


def standing(seconds: float) -> Array:
    return np.zeros((round(10 * seconds), 4))


def test_a_character_tells_its_moves(moving: core.Character, character: core.Character) -> None:
    assert moving.move_names == ["lunge", "wave"]
    assert [(move.upper_body, move.wait) for move in moving.moves] == [(False, 0.5), (True, 0.3)]
    assert moving.moves[WAVE].loop == pytest.approx((0.8, 1.2))
    assert moving.clip_names == character.clip_names
    assert core.Character.from_bytes(moving.to_bytes()).move_names == moving.move_names
    assert moving.with_moves([]).to_bytes() == character.to_bytes()


def test_a_move_is_played_and_moves_the_body(moving: core.Character) -> None:
    player = core.Player(moving)
    performance = player.run(standing(5), 30, moves=[[10, LUNGE, 1]])
    plays = np.flatnonzero(performance.moves[:, 0] == LUNGE)
    assert 30 <= plays[0] <= 30 + 0.5 * 30 + 2
    assert len(plays) == pytest.approx(30, abs=2)
    assert performance.path[-1, 1] - performance.path[0, 1] == pytest.approx(0.5, abs=0.08)
    assert (performance.moves[:, 1] == -1).all()


def test_a_gesture_leaves_the_way_alone(moving: core.Character) -> None:
    trace = core.simulate_trace("walker", 8, 3, moving.space)
    plain, waving = core.Player(moving).run(trace, 30), core.Player(moving).run(trace, 30, moves=[[20, WAVE, 30]])
    assert (plain.root_positions == waving.root_positions).all()
    legs = [NAMES.index(name) for name in NAMES if "thigh" in name or "foot" in name]
    assert (plain.rotations[:, legs] == waving.rotations[:, legs]).all()
    arm = NAMES.index("hand.R")
    assert np.abs((plain.rotations[:, arm] * waving.rotations[:, arm]).sum(-1)).min() < 0.6
    assert 0.1 * 30 < (waving.moves[:, 1] == WAVE).sum() - 2 * 30 < 3 * 30  # it looped


def test_a_player_that_is_stepped_does_as_one_that_runs(moving: core.Character) -> None:
    ran = core.Player(moving).run(standing(4), 60, moves=[[10, LUNGE, 5], [20, WAVE, 10]])
    player = core.Player(moving)
    for frame in range(1, 241):
        control = (frame - 1) // 6
        if (frame - 1) % 6 == 0:
            for begin, move, held in ((10, LUNGE, 5), (20, WAVE, 10)):
                if control == begin:
                    player.start_move(move)
                if control == begin + held:
                    player.release_move(move)
        root, rotations = player.step(np.zeros(4), 1 / 60)
        assert (root == ran.root_positions[frame]).all()
        assert (rotations == ran.rotations[frame]).all()
        assert player.playing_moves == tuple(ran.moves[frame])


def test_a_waiting_move_is_told(moving: core.Character) -> None:
    player = core.Player(moving)
    assert player.waiting_moves == player.playing_moves == (-1, -1)
    player.start_move(WAVE)
    assert player.waiting_moves == (-1, WAVE)


def test_crowds_play_moves(moving: core.Character) -> None:
    crowd, alone = core.Crowd(moving, 3, seed=4), core.Player(moving, seed=5)
    crowd.start_move(1, LUNGE)
    alone.start_move(LUNGE)
    crowd.release_move(1, LUNGE)
    alone.release_move(LUNGE)
    for _ in range(90):
        roots, rotations = crowd.step_many(np.zeros((3, 4)), 1 / 60)
        root, rotation = alone.step(np.zeros(4), 1 / 60)
    assert (roots[1] == root).all()
    assert (rotations[1] == rotation).all()


@pytest.mark.parametrize(
    ("moves", "message"),
    [
        ([[0, 2, 1]], "move 2 does not exist; the character has 2"),
        ([[0, 0.5, 1]], "whole numbers"),
        ([[50, 0, 1]], "before control 50 of a trace of 50"),
        ([[0, 0, -1]], "for -1 controls"),
        ([0, 0, 1], "moves"),
        ([[np.nan, 0, 1]], "moves"),
    ],
)
def test_moves_that_cannot_be_are_refused(moving: core.Character, moves: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        core.Player(moving).run(standing(5), 30, moves=moves)


def test_a_move_of_another_rig_is_refused(character: core.Character, skeleton: core.Skeleton) -> None:
    other = core.Skeleton(NAMES[:3], [-1, 0, 1], skeleton.rest_rotations[:3], skeleton.offsets[:3], skeleton.tips[:3])
    roots, rotations = walking_arrays(0.0, seconds=1.0)
    move = core.Move("nod", core.Clip(other, "nod", 30.0, roots, rotations[:, :3]))
    with pytest.raises(ValueError, match=r"the move .nod. is of another rig, of 3 bones; the character's has 9"):
        character.with_moves([move])


def test_a_move_longer_than_a_minute_is_refused(skeleton: core.Skeleton) -> None:
    clip = core.Clip(skeleton, "long", 30.0, *walking_arrays(0.0, seconds=61.0))
    with pytest.raises(ValueError, match=r'the move "long" lasts 61 s: a move lasts 0\.1 s to 60 s'):
        core.Move("long", clip)


def test_the_measure_tells_waits_and_steps(moving: core.Character) -> None:
    rows = measured_moves(moving)
    assert [row["name"] for row in rows] == ["lunge", "wave"]
    for row, wait in zip(rows, (0.5, 0.3)):
        assert 0 < row["wait_s"] <= wait + 2 / 60
        assert 0 < row["joint_step_ratio"] < 3


@pytest.mark.skipif(not CMU.is_dir(), reason="no motion capture beside the project")
def test_a_captured_jump_joins_a_captured_walk_as_well_as_fragments_join() -> None:
    takes = [core.read_asf_amc(CMU / "02.asf", CMU / f"02_0{number}.amc") for number in range(1, 5)]
    skeleton = takes[0].skeleton
    *walks, jump = [core.Clip.from_take(take, skeleton) for take in takes]
    options = build_options(classes=30, policies=["anticipate"])
    plain = core.build(skeleton, walks, [core.simulate_trace("explorer", 60, 1)], options)
    moving = plain.with_moves([core.Move("jump", jump), core.Move("arms", jump, True)])
    metrics = core.MotionMetrics(plain)
    shown = core.Player(plain).run(core.simulate_trace("explorer", 30, 7, plain.space), 60)
    usual = metrics.of(shown).positions.worst / metrics.takes.positions.p999
    for row in measured_moves(moving):
        assert row["wait_s"] <= 0.5 + 2 / 60
        assert row["joint_step_ratio"] < 1.1 * usual, row
