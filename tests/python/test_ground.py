# SPDX-License-Identifier: MIT
"""On the ground: what Python tells the player of it, and how exactly real motion stands on it."""

from __future__ import annotations

import fragmotion_core as core
import numpy as np
import pytest
from conftest import Bandai

from tools.measuring.directing.measures.ground import GROUNDS, ground

DEEPEST, ON_STAIRS = 0.02, 0.025  # m: the goal, and with feet that come down late on a step
SMOOTH, STEPPING = 2.5, 3.0  # times the plane's vertical acceleration of the hips: the goal on slopes; on stairs
SEEDS = range(1, 6)
WHIPS = 3.0  # times the fastest turn of a thigh on the plane


@pytest.fixture(scope="module")
def rows(bandai: Bandai) -> dict[str, dict[str, float]]:
    """The medians over some players: the greatest of one is chance."""
    played = [{row["name"]: row for row in ground(bandai.character, seed)} for seed in SEEDS]
    figures = [key for key in next(iter(played[0].values())) if key != "name"]
    return {name: {key: float(np.median([rows[name][key] for rows in played])) for key in figures} for name in GROUNDS}


@pytest.mark.parametrize("name", GROUNDS)
def test_real_feet_stand_on_slopes_and_stairs(rows: dict[str, dict[str, float]], name: str) -> None:
    steps = name.startswith("stairs")
    assert rows[name]["depth_m"] < (ON_STAIRS if steps else DEEPEST)
    assert rows[name]["hips_ratio"] < (STEPPING if steps else SMOOTH)
    assert rows[name]["thigh_ratio"] < WHIPS


@pytest.mark.parametrize("name", [name for name in GROUNDS if name.startswith("slope")])
def test_real_feet_slide_on_slopes_no_more_than_on_the_plane(rows: dict[str, dict[str, float]], name: str) -> None:
    assert rows[name]["skate_ratio"] < 1.1
    assert rows[name]["within_2_cm"] > 0.98


def test_what_the_ground_raises_gets_out_of_a_step_and_a_run(character: core.Character) -> None:
    def broken(x: float, y: float, z: float) -> None:
        raise LookupError("no such place")

    player = core.Player(character)
    player.stand_on(broken)
    for play in (lambda: player.step([0, 0, 0, 0], 0.1), lambda: player.run([[0, 0, 0, 0]], 30), player.reset):
        with pytest.raises(LookupError, match="no such place"):
            play()
    player.stand_on(None)
    player.reset()
    player.step([0, 0, 0, 0], 0.1)


@pytest.mark.parametrize("answer", ["high", 3.0, (1, 2), (1, 2, 3, "4")])
def test_ground_that_is_told_wrong_is_a_type_error(character: core.Character, answer: object) -> None:
    player = core.Player(character)
    player.stand_on(lambda _x, _y, _z: answer)  # type: ignore[arg-type, return-value]
    with pytest.raises(TypeError, match="four numbers"):
        player.step([0, 0, 0, 0], 0.1)


def test_a_run_on_the_ground_is_its_steps_on_the_ground(character: core.Character) -> None:
    def bumps(x: float, y: float, z: float) -> tuple[float, float, float, float] | None:
        return (0.1 * np.sin(3 * y), 0.0, -0.3 * np.cos(3 * y), 1.0) if y < 3 else None

    one, two = core.Player(character, seed=2), core.Player(character, seed=2)
    for player in (one, two):
        player.stand_on(bumps)
        player.reset()
    performance = one.run(np.tile([0, 1.2, 0, 0], (40, 1)), 30)
    for f in range(1, 121):
        root, rotations = two.step([0, 1.2, 0, 0], 1 / 30)
        np.testing.assert_array_equal(root, performance.root_positions[f])
        np.testing.assert_array_equal(rotations, performance.rotations[f])
    assert one.ground_missed == two.ground_missed > 0
    assert one.ground_level == two.ground_level
