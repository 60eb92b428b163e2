# SPDX-License-Identifier: MIT
"""A pin's trace leads where it says, changes no control that it must not, and is the same on any number of threads."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import fragmotion_core as core
import numpy as np
import pytest
from conftest import Array

RATE = 60


@pytest.fixture(scope="module")
def trace(character: core.Character) -> Array:
    return core.simulate_trace("walker", 12, 1, character.space)


def frames_of(character: core.Character, trace: Array, start: Array, **options: Any) -> Array:
    player = core.Player(character, **options)
    player.reset(*start)
    return player.run(trace, RATE).path


def apart(frame: Array, other: Array) -> tuple[float, float]:
    """Metres and radians between character frames."""
    return float(np.hypot(*(frame - other)[:2])), abs(math.remainder(frame[2] - other[2], 2 * math.pi))


@pytest.mark.parametrize(
    ("seconds", "begin", "off"),
    [(6.0, 2.0, (0.2, 0.1, 0.1)), (9.5, 6.0, (-0.1, 0.2, -0.1)), (5.0, 0.0, (0.3, -0.3, 0.2)), (12.0, 8.0, (0, 0, 0))],
)
def test_a_pin_is_reached_by_controls_that_change_only_before_it(
    character: core.Character, trace: Array, seconds: float, begin: float, off: tuple[float, ...]
) -> None:
    start = np.array([3.0, -2.0, 0.7])
    target = frames_of(character, trace, start, seed=4)[round(seconds * RATE)] + off
    pin = core.find_pin(character, start, trace, seconds, target, seed=4, begin=begin)
    assert pin.fits and pin.distance <= 0.02 and pin.angle <= math.radians(2)
    assert (pin.asked, pin.asked_angle) == pytest.approx((math.hypot(*off[:2]), abs(off[2])), abs=1e-9)
    first, last = round(begin * 10), math.ceil(seconds * 10)
    np.testing.assert_array_equal(pin.trace[:first], trace[:first])
    np.testing.assert_array_equal(pin.trace[last:], trace[last:])
    np.testing.assert_array_equal(pin.trace[:, 3], trace[:, 3])
    assert begin == 0 or pin.seed == 4
    played = frames_of(character, pin.trace, start, seed=pin.seed)[round(seconds * RATE)]
    np.testing.assert_array_equal(played, pin.reached)
    assert apart(played, target) == pytest.approx((pin.distance, pin.angle), abs=1e-12)
    if not any(off):
        np.testing.assert_array_equal(pin.trace, trace)
        assert pin.tries == 1


def test_changes_are_small(character: core.Character, trace: Array) -> None:
    target = frames_of(character, trace, np.zeros(3))[480] + (1.0, 1.0, 0.5)
    pin = core.find_pin(character, np.zeros(3), trace, 8.0, target, begin=3.0, tries=600)
    speed, speed_then = (np.hypot(*t[:, :2].T) for t in (trace, pin.trace))
    assert (np.abs(speed_then - speed) <= 0.4 * speed + 1e-9).all()
    turned = np.angle((pin.trace[:, 0] + 1j * pin.trace[:, 1]) * (trace[:, 0] - 1j * trace[:, 1]))
    assert np.abs(turned[speed > 0]).max() <= math.radians(20) + 1e-9
    assert np.abs(pin.trace[:, 2] - trace[:, 2]).max() <= 0.6 + 1e-9
    still = (speed == 0) & (trace[:, 2] == 0)
    np.testing.assert_array_equal(pin.trace[still], trace[still])


@pytest.mark.thorough
def test_a_pin_is_the_same_on_any_number_of_threads(character: core.Character, trace: Array) -> None:
    target = frames_of(character, trace, np.zeros(3))[480] + (0.3, 0.1, 0.1)
    for begin in (0.0, 4.0):
        pins = [
            core.find_pin(character, np.zeros(3), trace, 8.0, target, begin=begin, threads=threads)
            for threads in (1, 2, 5, 1)
        ]
        for one, other in pairwise(pins):
            np.testing.assert_array_equal(one.trace, other.trace)
            assert (one.seed, one.tries, one.distance, one.angle) == (
                other.seed,
                other.tries,
                other.distance,
                other.angle,
            )


def test_a_pin_that_cannot_be_reached_says_by_how_much(character: core.Character, trace: Array) -> None:
    before = frames_of(character, trace, np.zeros(3))[480]
    target = np.add(before, (30.0, 0, 1.0))
    pin = core.find_pin(character, np.zeros(3), trace, 8.0, target, begin=5.0, tries=300)
    assert not pin.fits and 300 <= pin.tries < 400
    assert 20 < pin.distance < 31
    played = frames_of(character, pin.trace, np.zeros(3))[480]
    assert apart(played, target) == pytest.approx((pin.distance, pin.angle), abs=1e-12)


def test_more_tries_are_never_worse(character: core.Character, trace: Array) -> None:
    target = frames_of(character, trace, np.zeros(3))[480] + (1.5, 1.0, 1.0)

    def cost(tries: int) -> float:
        pin = core.find_pin(character, np.zeros(3), trace, 8.0, target, begin=6.0, tries=tries)
        return math.hypot(pin.distance / 0.02, pin.angle / math.radians(2))

    costs = [cost(tries) for tries in (1, 65, 300, 1500)]
    assert costs == sorted(costs, reverse=True) and costs[-1] < costs[0]


def test_a_search_tells_how_far_it_is_and_is_cancelled(character: core.Character, trace: Array) -> None:
    target, told = np.array([40.0, 0, 0]), []

    def tell(fraction: float, stage: str) -> bool:
        told.append(fraction)
        assert stage
        return len(told) < 5

    with pytest.raises(core.Cancelled):
        core.find_pin(character, np.zeros(3), trace, 8.0, target, begin=6.0, progress=tell)
    assert told == sorted(set(told)) and told[0] >= 0 and told[-1] < 1


@pytest.mark.parametrize(
    ("changed", "cause"),
    [
        ({"seconds": 12.1}, "the pin's time must be 0.1 to 12, not 12.1"),
        ({"begin": 7.95}, "controls change must be 0 to 7.9, not 7.95"),
        ({"begin": -0.1}, "controls change"),
        ({"target": [math.nan, 0, 0]}, "a place or a heading"),
        ({"target": [0, 0]}, "target"),
        ({"tries": 0}, "tries must be 1 to"),
        ({"distance": -1}, "distance that is near enough"),
        ({"angle": 4}, "angle that is near enough"),
        ({"trace": np.zeros((0, 4))}, "no controls"),
        ({"policy": "none"}, "none"),
    ],
)
def test_wrong_pins_are_refused(character: core.Character, trace: Array, changed: dict[str, Any], cause: str) -> None:
    good = {"start": np.zeros(3), "trace": trace, "seconds": 8.0, "target": np.zeros(3), "tries": 1}
    with pytest.raises(ValueError, match=cause):
        core.find_pin(character, **{**good, **changed})
