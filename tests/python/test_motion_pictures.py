# SPDX-License-Identifier: MIT
"""What the pictures of motion show: which take is an example of a movement, and where feet stand."""

from __future__ import annotations

import fragmotion_core as core
import numpy as np
import pytest
from conftest import build_options, walking_arrays

from tools.motion_pictures.motions import Feet, Motion, of_clip, of_performance
from tools.motion_pictures.movements import MOVEMENTS, Part, nearest_take, trace_of


def test_a_trace_holds_each_part_for_its_time_in_its_direction(character: core.Character) -> None:
    trace = trace_of((Part(0.5, "walk", direction=90), Part(0.3, "stand", turn=1)), character.space)
    np.testing.assert_allclose(trace[:5], [[-character.space.walk, 0, 0, 0]] * 5, atol=1e-12)
    np.testing.assert_allclose(trace[5:], [[0, 0, 1, 0]] * 3, atol=1e-12)


@pytest.mark.parametrize("clip, part", [("gait 1", Part(2, "walk")), ("gait 4", Part(2, "run"))])
def test_the_take_that_does_a_movement_is_its_example(character: core.Character, clip: str, part: Part) -> None:
    found = nearest_take(character, (part,))
    assert found and found.clip == clip


def test_an_example_may_take_its_time(skeleton: core.Skeleton, clips: list[core.Clip]) -> None:
    speeds = np.repeat([0.0, 3.0, 0.0], 60)  # two seconds each
    roots, rotations = walking_arrays(seconds=179 / 30)
    roots[:, 1] = np.cumsum(speeds) / 30
    both = core.Clip(skeleton, "run between stands", 30.0, roots, rotations)
    character = core.build(skeleton, [both, *clips], [core.simulate_trace("explorer", 10)], build_options(classes=9))
    found = nearest_take(character, (Part(0.8, "stand"), Part(1.2, "run"), Part(0.8, "stand")))
    assert found and found.clip == "run between stands"
    assert found.start < 2 and found.end > 4


def test_what_no_take_does_has_no_example(character: core.Character) -> None:
    assert nearest_take(character, (Part(1, "stand"), Part(0.3, "stand", jump=1))) is None


def test_a_ball_stands_where_it_is_low_and_still(skeleton: core.Skeleton, clips: list[core.Clip]) -> None:
    feet = Feet(skeleton, clips[:1])
    standing = feet.balls(of_clip(clips[0], skeleton))
    assert feet.planted(standing, 30.0).all()
    np.testing.assert_allclose(feet.weights(standing), 1, atol=0.1)
    ahead = np.arange(len(standing))[:, None, None] * [0.0, 0.2 / 30, 0.0]
    assert not feet.planted(standing + ahead, 30.0)[:-1].any()
    raised = standing + np.array([0.0, 0.0, 0.05])
    assert not feet.planted(raised, 30.0).any()
    np.testing.assert_array_equal(feet.weights(raised), 0)


def test_every_change_of_fragment_is_a_stitch(character: core.Character) -> None:
    performance = core.Player(character).run(trace_of(MOVEMENTS[0].parts, character.space), 60)
    motion: Motion = of_performance("ours", performance)
    fragments = performance.fragments  # one may follow itself
    assert {f for f in range(1, len(fragments)) if fragments[f] != fragments[f - 1]} <= set(motion.stitches.tolist())
    assert len(motion.stitches) == performance.entered[-1]


def test_the_acceleration_is_seen_from_where_the_character_faced_at_first(
    skeleton: core.Skeleton, clips: list[core.Clip]
) -> None:
    rotations = clips[0].rotations[:1].repeat(121, axis=0)
    seconds = np.arange(121) / 60
    for heading in (0.0, 1.0):
        forward = np.array([-np.sin(heading), np.cos(heading), 0])
        roots = [0, 0, 0.9] + (2.5 * seconds**2)[:, None] * forward
        motion = Motion("faster", 60, roots, rotations, np.full((121, 3), [0, 0, heading]), np.empty(0, int))
        np.testing.assert_allclose(motion.acceleration(60), [0, 5, 0], atol=1e-9)


def test_a_quick_turn_is_the_quickest_that_the_character_has(character: core.Character) -> None:
    trace = trace_of((Part(0.2, "jog", turn=-9),), character.space)
    space = character.space
    np.testing.assert_allclose(trace, [[0, (space.walk + space.run) / 2, -space.quickest_turn, 0]] * 2, atol=1e-12)
