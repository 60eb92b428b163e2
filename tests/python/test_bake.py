# SPDX-License-Identifier: MIT
"""What a bake does to a motion, beside SciPy's rotations and splines."""

from __future__ import annotations

from typing import NamedTuple

import fragmotion_core as core
import numpy as np
import pytest
from conftest import Array
from scipy.interpolate import CubicHermiteSpline
from scipy.spatial.transform import Rotation

HIPS, BONES, FRAMES = 1, 4, 50


class Motion(NamedTuple):
    root_positions: Array
    rotations: Array
    path: Array


@pytest.fixture
def motion() -> Motion:
    """A body that walks a curve and swings its bones."""
    t = np.arange(FRAMES)[:, None] / 30
    frames = np.hstack((np.sin(t), 1.2 * t, 0.7 * t))
    swings = np.stack([0.4 * np.sin((3 + b) * t + b) for b in range(BONES)], 1) * np.eye(3)[[0, 1, 2, 0]]
    rotations = wxyz(Rotation.from_rotvec(swings.reshape(-1, 3))).reshape(FRAMES, BONES, 4)
    roots = frames * (1, 1, 0) + np.hstack((0.02 * np.sin(9 * t), 0 * t, 0.9 + 0.03 * np.cos(9 * t)))
    return Motion(roots, rotations, frames)


def wxyz(rotation: Rotation) -> Array:
    return np.roll(rotation.as_quat(), 1, axis=-1)


def turned(values: Array) -> Rotation:
    return Rotation.from_quat(np.roll(values, -1, axis=-1).reshape(-1, 4))


def still(motion: Motion) -> Motion:
    """As seen from the character frame."""
    return Motion(*core.carried_motion(*motion, HIPS, np.zeros_like(motion.path)))


def test_a_carried_motion_is_the_same_seen_from_its_frame(motion: Motion) -> None:
    to = np.random.default_rng(1).normal(size=(FRAMES, 3))
    roots, rotations, frames = core.carried_motion(*motion, HIPS, to)
    np.testing.assert_array_equal(frames, to)
    for f in range(FRAMES):
        turn = Rotation.from_euler("z", to[f, 2] - motion.path[f, 2])
        seen = turn.apply(motion.root_positions[f] - motion.path[f] * (1, 1, 0))
        np.testing.assert_allclose(roots[f], seen + to[f] * (1, 1, 0), atol=1e-12)
        wanted = turn * turned(motion.rotations[f, HIPS])
        assert (wanted.inv() * turned(rotations[f, HIPS])).magnitude() < 1e-12
    others = np.delete(np.arange(BONES), HIPS)
    np.testing.assert_array_equal(rotations[:, others], motion.rotations[:, others])
    back = core.carried_motion(roots, rotations, frames, HIPS, motion.path)
    np.testing.assert_allclose(back[0], motion.root_positions, atol=1e-12)


@pytest.mark.parametrize("count", [2, 5, 20, 48])
def test_a_looped_motion_ends_as_it_began(motion: Motion, count: int) -> None:
    ended = Motion(*core.looped_motion(*motion, HIPS, count))
    seen, was = still(ended), still(motion)
    np.testing.assert_allclose(seen.root_positions[-1], seen.root_positions[0], atol=1e-9)
    speeds = np.diff(seen.root_positions, axis=0)
    np.testing.assert_allclose(speeds[-1], speeds[0], atol=1e-9)
    for bone in range(BONES):
        begin, end = turned(seen.rotations[:2, bone]), turned(seen.rotations[-2:, bone])
        assert (begin[0].inv() * end[1]).magnitude() < 1e-6
        lead, last = begin[1] * begin[0].inv(), end[1] * end[0].inv()
        assert (lead.inv() * last).magnitude() < 1e-6, "it goes on as it begins"
    step = [
        Rotation.from_euler("z", -ended.path[f, 2]).apply((ended.path[f + 1] - ended.path[f]) * (1, 1, 0))
        for f in (0, FRAMES - 2)
    ]
    np.testing.assert_allclose(step[1], step[0], atol=1e-9)
    kept = FRAMES - 1 - min(count, FRAMES - 1)
    np.testing.assert_allclose(seen.root_positions[:kept], was.root_positions[:kept], atol=1e-12)
    np.testing.assert_allclose(ended.path[: kept + 1], motion.path[: kept + 1], atol=1e-12)


def test_two_frames_are_no_loop(motion: Motion) -> None:
    two = Motion(*(part[:2] for part in motion))
    for part, was in zip(core.looped_motion(*two, HIPS, 5), two):
        np.testing.assert_array_equal(part, was)


def test_a_motion_shown_at_its_own_rate_stays_as_it_is(motion: Motion) -> None:
    *parts, nearest = core.resampled_motion(np.arange(FRAMES) / 30, *motion, 30.0)
    for part, was in zip(parts, motion):
        np.testing.assert_allclose(part, was, atol=1e-9)
    np.testing.assert_array_equal(nearest, np.arange(FRAMES))


def test_a_motion_shown_at_odd_times_lies_on_straight_lines(motion: Motion) -> None:
    times = np.sort(np.r_[0, np.random.default_rng(2).uniform(0, 2, FRAMES - 1)])
    flipped = motion.rotations * np.random.default_rng(3).choice((-1.0, 1.0), (FRAMES, BONES, 1))
    roots, rotations, frames, nearest = core.resampled_motion(times, motion[0], flipped, motion[2], 24.0)
    at = np.arange(len(roots)) / 24
    for k in range(3):
        np.testing.assert_allclose(roots[:, k], np.interp(at, times, motion.root_positions[:, k]), atol=1e-12)
        np.testing.assert_allclose(frames[:, k], np.interp(at, times, motion.path[:, k]), atol=1e-12)
    np.testing.assert_allclose(np.linalg.norm(rotations, axis=-1), 1, atol=1e-12)
    assert (np.abs(times[nearest] - at) <= np.abs(times[:, None] - at).min(0) + 1e-12).all()
    after = np.searchsorted(times, at).clip(1)
    share = ((at - times[after - 1]) / (times[after] - times[after - 1]))[:, None, None]
    mixed = (1 - share) * motion.rotations[after - 1] + share * motion.rotations[after]
    gaps = turned(mixed).inv() * turned(rotations)
    assert gaps.magnitude().max() < 1e-9, "whatever the signs of the quaternions"


def test_fitted_keys_are_a_cubic_hermite_spline() -> None:
    rng = np.random.default_rng(4)
    values = np.cumsum(np.cumsum(rng.normal(size=(200, 4)), 0), 0) / 100
    kept, slopes, drawn = core.fit_keys(values, 0.02)
    assert 2 < len(kept) < 100
    spline = CubicHermiteSpline(kept, values[kept], slopes)
    np.testing.assert_allclose(drawn, spline(np.arange(200)), atol=1e-9)
    assert np.linalg.norm(drawn - values, axis=1).max() <= 0.02


def test_fitted_keys_are_fewer_than_straight_lines_need() -> None:
    t = np.arange(300) / 30
    values = np.column_stack((np.sin(5 * t), np.cos(7 * t)))
    kept, _, _ = core.fit_keys(values, 0.01)
    lines, first = 1, 0
    for last in range(2, 300):
        share = (np.arange(first, last + 1) - first)[:, None] / (last - first)
        line = (1 - share) * values[first] + share * values[last]
        if np.linalg.norm(values[first : last + 1] - line, axis=1).max() > 0.01:
            lines, first = lines + 1, last - 1
    assert len(kept) < 0.6 * (lines + 1)
