# SPDX-License-Identifier: MIT
"""Paths: what a player does along them, and what is refused."""

from __future__ import annotations

import math

import fragmotion_core as core
import numpy as np
import pytest
from conftest import Array

from tools.measuring.directing.measures.courses import circle

FRAMES = 60  # a second


@pytest.fixture(scope="module")
def path() -> core.Path:
    return core.Path(circle(2.0), closed=True)


def distances(path: core.Path, places: Array) -> Array:
    """Of places [N,2] from the path, by brute force."""
    points = path.places(np.linspace(0, path.length, 2000))
    lines, off = np.diff(points, axis=0), places[:, None] - points[:-1]
    shares = np.clip((off * lines).sum(2) / (lines**2).sum(1), 0, 1)
    found: Array = np.linalg.norm(off - shares[..., None] * lines, axis=2).min(1)
    return found


def test_a_path_measures_its_way() -> None:
    path = core.Path([[0, 0, 5], [3, 0, -1], [3, 4, 2]])
    assert path.length == 7 and not path.is_closed
    assert path.places([0, 5, 9]).tolist() == [[0, 0], [3, 2], [3, 6]]
    assert path.start == pytest.approx((0, 0, -math.pi / 2))


def test_a_followed_path_is_played_again_to_the_bit(character: core.Character, path: core.Path) -> None:
    walk = core.follow_path(core.Player(character, seed=3), path, rate=FRAMES)
    player = core.Player(character, seed=3)
    player.reset(*path.start)
    played = player.run(walk.trace, FRAMES)
    off = distances(path, played.path[1 : round(walk.seconds * FRAMES) + 1, :2])
    assert off.mean() == pytest.approx(walk.mean_distance, abs=1e-4)
    assert off.max() == pytest.approx(walk.greatest_distance, abs=1e-3)
    arrival = math.dist(played.path[-1, :2], path.places([path.length])[0])
    assert arrival == pytest.approx(walk.arrival_distance, rel=1e-12)


def test_steering_by_hand_is_what_follow_path_does(character: core.Character, path: core.Path) -> None:
    walk = core.follow_path(core.Player(character), path, end="loop", seconds=20, rate=FRAMES)
    player, follower = core.Player(character), core.PathFollower(character.space, path, end="loop")
    player.reset(*path.start)
    trace = []
    for _ in range(200):
        trace.append(follower.steer(player.frame, 0.1))
        for _ in range(FRAMES // 10):
            player.step(trace[-1], 1 / FRAMES)
    assert np.array_equal(trace, walk.trace)
    assert follower.way > path.length and not follower.stands


@pytest.mark.parametrize(("end", "seconds"), [("stand", 8.0), ("loop", 12.5), ("go_on", 12.5)])
def test_a_trace_is_one_that_can_be_saved(character: core.Character, path: core.Path, end: str, seconds: float) -> None:
    walk = core.follow_path(core.Player(character), path, end=end, seconds=seconds)
    assert 0 < len(walk.trace) <= round(10 * seconds)
    assert (np.abs(walk.trace[:, 2]) <= character.space.quickest_turn).all()
    assert not walk.trace[:, 3].any()


def test_a_character_walks_where_it_is_asked_and_arrives_in_time(character: core.Character, path: core.Path) -> None:
    walk = core.follow_path(core.Player(character), path, arrive=12)
    assert walk.arrived and walk.planned_seconds == 12
    assert walk.mean_distance < 0.15 and walk.arrival_distance < 0.2
    assert walk.seconds == pytest.approx(12, abs=0.25)


def test_more_than_a_character_can_is_told(character: core.Character, path: core.Path) -> None:
    walk = core.follow_path(core.Player(character), path, arrive=1)
    assert walk.asked_speed == pytest.approx(path.length) and walk.asked_speed > character.space.run
    assert walk.planned_seconds > 3
    assert core.follow_path(core.Player(character), path, speed=50).asked_speed == 50


def test_a_path_has_speeds(character: core.Character) -> None:
    line = np.linspace((0, 0), (0, 12), 40)
    speeds = np.where(line[:, 1] < 6, 1.0, 2.5)
    path = core.Path(line, speeds=speeds)
    walk = core.follow_path(core.Player(character), path)
    player = core.Player(character)
    player.reset(*path.start)
    places = player.run(walk.trace, FRAMES).path[:, 1]
    slow = np.diff(places[(places > 2) & (places < 5)]).mean() * FRAMES
    fast = np.diff(places[(places > 8) & (places < 10)]).mean() * FRAMES
    assert slow == pytest.approx(1.0, rel=0.15) and fast > 1.6 * slow


@pytest.mark.parametrize(
    ("points", "message"),
    [
        ([[0, 0]], "two points"),
        ([[0, 0, 0], [0, 0, 3]], "no length on the ground"),
        ([[0, 0], [math.nan, 1]], "points of a path"),
        ([0, 1, 2], r"\[N,2\] or \[N,3\]"),
    ],
)
def test_what_is_no_path_is_refused(points: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        core.Path(points)  # type: ignore[arg-type]


def test_options_that_do_not_exist_are_refused(character: core.Character, path: core.Path) -> None:
    with pytest.raises(ValueError, match='no end "sit"; there are stand, loop, go_on'):
        core.PathFollower(character.space, path, end="sit")
    with pytest.raises(ValueError, match='no facing "up"'):
        core.follow_path(core.Player(character), path, facing="up")
    with pytest.raises(ValueError, match="speed along the path"):
        core.PathFollower(character.space, path, speed=-1)
    with pytest.raises(ValueError, match="where the character is"):
        core.PathFollower(character.space, path).steer((math.nan, 0, 0), 0.1)


def test_a_cusp_is_walked_to_and_back(character: core.Character) -> None:
    path = core.Path([[0, 0], [0, 5], [0.001, 5], [0.001, 0]])
    walk = core.follow_path(core.Player(character), path)
    assert walk.arrived and walk.mean_distance < 0.15
    player = core.Player(character)
    player.reset(*path.start)
    assert player.run(walk.trace, FRAMES).path[:, 1].max() > 4.6


def test_a_stick_is_steered_by_the_view_or_by_the_character() -> None:
    space = core.ControlSpace(1.2, 3.3)
    by_character, well = core.Steering(space, False, False), core.Steering(space, True, True)
    badly = core.Steering(space, False, False)
    assert by_character.control(0.5, 0, 0, True, 2.0, None) == pytest.approx((1.2, 0, 0, 1))
    assert well.control(0, 1, 0, False, 0.0, 0.5)[:2] == pytest.approx((0, 3.3)), "it goes ahead as it turns"
    assert well.control(0, 1, 0, False, 0.0, 2.5)[:2] == (0, 0), "on the spot"
    right, forward, turn, _ = badly.control(0, 1, 0, False, 0.0, math.pi / 2)
    assert (right, forward) == pytest.approx((-3.3, 0)) and turn == space.quickest_turn
    assert [core.stick_speed(space, push) for push in (0, 0.5, 1)] == pytest.approx([0, 1.2, 3.3])
    for wrong in (math.nan, math.inf, 1e9):
        with pytest.raises(ValueError, match="what the stick says"):
            by_character.control(wrong, 0, 0, False, 0.0, None)
    with pytest.raises(ValueError, match="a heading"):
        by_character.control(0, 1, 0, False, math.nan, None)
    with pytest.raises(ValueError, match="pushed"):
        core.stick_speed(space, 1.1)
