# SPDX-License-Identifier: MIT
"""Crowds through the binding: flat arrays in and out."""

from __future__ import annotations

from typing import Any

import fragmotion_core as core
import numpy as np
import pytest
from conftest import Array

COUNT, STEPS = 11, 90


@pytest.fixture(scope="module")
def controls() -> Array:
    """Of every step, [STEPS,COUNT,4]."""
    return np.random.default_rng(3).uniform([-2, -2, -1, 0], [2, 2, 1, 1], (STEPS, COUNT, 4))


@pytest.mark.parametrize("threads", [0, 1, 2])
def test_a_crowd_shows_what_its_players_show_alone(character: core.Character, controls: Array, threads: int) -> None:
    crowd = core.Crowd(character, COUNT, seed=4, stitch=0.15, threads=threads)
    players = [core.Player(character, seed=4 + i, stitch=0.15) for i in range(COUNT)]
    crowd.reset(2, 1, -1, 0.5)
    players[2].reset(1, -1, 0.5)
    crowd.force(3, 1)
    players[3].force(1)
    for step in controls:
        roots, rotations = crowd.step_many(step, 1 / 60)
        alone = [player.step(control, 1 / 60) for player, control in zip(players, step)]
    np.testing.assert_array_equal(roots, [root for root, _ in alone])
    np.testing.assert_array_equal(rotations, [pose for _, pose in alone])
    np.testing.assert_array_equal(crowd.character_frames, [player.frame for player in players])
    np.testing.assert_array_equal(crowd.playing, [player.playing for player in players])
    assert len(crowd) == COUNT


def test_a_crowd_writes_to_the_arrays_that_it_is_given(character: core.Character, controls: Array) -> None:
    one, two = core.Crowd(character, COUNT), core.Crowd(character, COUNT)
    expected = one.step_many(controls[0], 0.1)
    roots, rotations = np.zeros_like(expected[0]), np.zeros_like(expected[1])
    given = two.step_many(controls[0], 0.1, roots, rotations)
    assert given[0] is roots and given[1] is rotations
    np.testing.assert_array_equal(roots, expected[0])
    np.testing.assert_array_equal(rotations, expected[1])


def test_a_crowd_refuses_what_it_cannot_do_and_moves_nobody(character: core.Character, controls: Array) -> None:
    crowd = core.Crowd(character, COUNT)
    crowd.step_many(controls[0], 0.1)
    before = crowd.character_frames
    broken = controls[1].copy()
    broken[-1, 2] = np.nan
    roots = np.zeros((COUNT, 3))
    read_only = roots.copy()
    read_only.flags.writeable = False
    cases: list[tuple[str, tuple[Any, ...]]] = [
        ("not a number", (broken, 0.1)),
        ("step", (controls[1], -0.1)),
        ("controls must have the shape", (controls[1][1:], 0.1)),
        ("controls must have the shape", (controls[1].ravel(), 0.1)),
        ("roots must have the shape", (controls[1], 0.1, roots[1:])),
        ("roots must be", (controls[1], 0.1, roots.astype(np.float32))),
        ("roots must be", (controls[1], 0.1, read_only)),
        ("roots must be", (controls[1], 0.1, np.zeros((3, COUNT)).T)),
        ("rotations must have the shape", (controls[1], 0.1, roots, np.zeros((COUNT, 1, 4)))),
    ]
    for message, arguments in cases:
        with pytest.raises(ValueError, match=message):
            crowd.step_many(*arguments)
    with pytest.raises(ValueError, match="player 11 does not exist"):
        crowd.force(COUNT, 0)
    with pytest.raises(ValueError, match="player -1 does not exist"):
        crowd.reset(-1)
    with pytest.raises(ValueError, match="crowd"):
        core.Crowd(character, -1)
    np.testing.assert_array_equal(crowd.character_frames, before)


def test_a_crowd_may_be_empty(character: core.Character) -> None:
    roots, rotations = core.Crowd(character, 0).step_many(np.zeros((0, 4)), 0.1)
    assert roots.shape == (0, 3) and rotations.shape[0] == 0
