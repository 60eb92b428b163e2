# SPDX-License-Identifier: MIT
"""Motions joined, where they fit best, and moved to a place."""

from __future__ import annotations

import fragmotion_core as core
import numpy as np
import pytest
from conftest import NAMES, Array

RATE = 60
JOINED = round(0.8 * RATE)


def play(character: core.Character, player: str, seed: int, seconds: float = 8) -> core.Motion:
    runner = core.Player(character, seed)
    runner.reset(5 * seed, 1, 2.0 * seed)
    performance = runner.run(core.simulate_trace(player, seconds, seed, character.space), RATE)
    return core.Motion(RATE, performance.root_positions, performance.rotations, performance.path)


def seen(motion: core.Motion) -> Array:
    """Roots [F,3] seen from the character frame, and the hips' facing [F] from it, and all other bones' rotations."""
    roots, frames = motion.root_positions.copy(), motion.path
    cos, sin = np.cos(frames[:, 2]), np.sin(frames[:, 2])
    x, y = (roots[:, :2] - frames[:, :2]).T
    roots[:, 0], roots[:, 1] = cos * x + sin * y, cos * y - sin * x
    w, z = np.cos(frames[:, 2] / 2), -np.sin(frames[:, 2] / 2)
    hips = motion.rotations[:, 0]
    turned = np.column_stack(
        (
            w * hips[:, 0] - z * hips[:, 3],
            w * hips[:, 1] - z * hips[:, 2],
            w * hips[:, 2] + z * hips[:, 1],
            w * hips[:, 3] + z * hips[:, 0],
        )
    )
    return np.column_stack((roots, turned * np.sign(turned[:, :1]), motion.rotations[:, 1:].reshape(len(roots), -1)))


def test_a_join_keeps_the_first_to_the_bit_and_becomes_the_second(
    skeleton: core.Skeleton, character: core.Character
) -> None:
    first, second = play(character, "walker", 1), play(character, "runner", 2)
    both = core.join(skeleton, first, 299, second, 100)
    assert len(both.path) == 300 + len(second.path) - 101
    for name in ("root_positions", "rotations", "path"):
        np.testing.assert_array_equal(getattr(both, name)[:300], getattr(first, name)[:300])
    np.testing.assert_allclose(seen(both)[300 + JOINED :], seen(second)[101 + JOINED :], atol=1e-6)
    np.testing.assert_allclose(both.path[:, :2], both.root_positions[:, :2], atol=1e-6)


def test_a_join_is_as_smooth_as_its_parts(skeleton: core.Skeleton, character: core.Character) -> None:
    first, second = play(character, "walker", 1), play(character, "walker", 2)
    both = core.join(skeleton, first, 299, second, 100)
    steps = np.linalg.norm(np.diff(both.root_positions, 2, axis=0), axis=1)
    usual = max(np.linalg.norm(np.diff(m.root_positions, 2, axis=0), axis=1).max() for m in (first, second))
    assert steps[298 : 300 + JOINED].max() < 1.5 * usual
    turns = np.abs(np.diff(both.rotations, axis=0)).max((1, 2))
    usual = max(np.abs(np.diff(m.rotations, axis=0)).max() for m in (first, second))
    assert turns[298 : 300 + JOINED].max() < 1.5 * usual + 0.05


def test_joining_a_motion_to_itself_where_it_was_cut_changes_nothing(
    skeleton: core.Skeleton, character: core.Character
) -> None:
    motion = play(character, "explorer", 3)
    for at in (0, 1, 200, len(motion.path) - 1):
        both = core.join(skeleton, motion, at, motion, at)
        np.testing.assert_allclose(both.root_positions, motion.root_positions, atol=1e-6)
        np.testing.assert_allclose(both.path, motion.path, atol=1e-6)
        np.testing.assert_allclose(both.rotations, motion.rotations, atol=1e-6)


def test_a_seam_is_where_poses_are_nearest(skeleton: core.Skeleton, character: core.Character) -> None:
    motion = play(character, "walker", 1)
    ends, beginnings = [90, 120, 200], [60, 121, 300, 360]
    end, beginning, distance = core.find_seam(skeleton, motion, [90, 200, 123], motion, [60, 123, 300])
    assert (end, beginning) == (123, 123) and distance < 0.01

    def apart(one: int, other: int) -> float:
        return core.find_seam(skeleton, motion, [one], motion, [other])[2]

    found = core.find_seam(skeleton, motion, ends, motion, beginnings)
    assert found[2] == min(apart(one, other) for one in ends for other in beginnings) == apart(*found[:2])


def test_a_motion_is_spread_to_where_it_is_to_be(skeleton: core.Skeleton, character: core.Character) -> None:
    motion = play(character, "walker", 1)
    target = motion.path[400] + (0.02, -0.01, 0.03)
    moved = core.spread(skeleton, motion, 200, 400, target)
    np.testing.assert_array_equal(moved.root_positions[:201], motion.root_positions[:201])
    np.testing.assert_array_equal(moved.rotations[:201], motion.rotations[:201])
    np.testing.assert_allclose(moved.path[400], target, atol=1e-12)
    np.testing.assert_allclose(seen(moved), seen(motion), atol=1e-9)
    steps = np.linalg.norm(np.diff(moved.path - motion.path, axis=0)[200:400, :2], axis=1)
    assert steps.max() * RATE < 2 * np.hypot(0.02, 0.01) / (200 / RATE)
    cos, sin = np.cos(0.03), np.sin(0.03)
    way, way_then = (m.path[401:, :2] - m.path[400, :2] for m in (motion, moved))
    np.testing.assert_allclose(way_then, way @ np.array([[cos, sin], [-sin, cos]]), atol=1e-9)
    np.testing.assert_allclose(moved.path[400:, 2] - motion.path[400:, 2], 0.03, atol=1e-9)


def test_what_cannot_be_joined_is_refused(skeleton: core.Skeleton, character: core.Character) -> None:
    motion = play(character, "walker", 1, 2)
    arrays = (motion.root_positions, motion.rotations, motion.path)
    slow = core.Motion(30, *arrays)
    few = core.Motion(RATE, arrays[0], arrays[1][:, 1:], arrays[2])
    none = core.Motion(RATE, *(array[:0] for array in arrays))
    wild = core.Motion(RATE, arrays[0] * np.nan, *arrays[1:])
    long = core.Motion(RATE, arrays[0], 2 * arrays[1], arrays[2])
    for other, cause in (
        (slow, "same frame rate"),
        (few, "every bone"),
        (none, "has no frame"),
        (wild, "not a number"),
        (long, "no rotation"),
    ):
        with pytest.raises(ValueError, match=cause):
            core.join(skeleton, motion, 3, other, 0)
    for ends, beginnings in (([], [0]), ([0], []), ([121], [0]), ([0], [-1])):
        with pytest.raises(ValueError, match="no frame"):
            core.find_seam(skeleton, motion, ends, motion, beginnings)
    for end, beginning in ((121, 0), (0, 121), (-1, 0)):
        with pytest.raises(ValueError, match="no frame"):
            core.join(skeleton, motion, end, motion, beginning)
    for begin, end in ((5, 5), (-1, 5), (5, 121)):
        with pytest.raises(ValueError, match="in order"):
            core.spread(skeleton, motion, begin, end, np.zeros(3))
    with pytest.raises(ValueError, match="to be at"):
        core.spread(skeleton, motion, 0, 5, [np.inf, 0, 0])
    with pytest.raises(ValueError, match="path"):
        core.Motion(RATE, arrays[0], arrays[1], arrays[2][1:])
    assert skeleton.names == NAMES
