# SPDX-License-Identifier: MIT
"""Clips on the spot are led by their feet, also where one clip holds several motions."""

from __future__ import annotations

import fragmotion_core as core
import numpy as np
from conftest import NAMES, Array, walking_arrays
from fragmotion_command.takes import led_by_feet

Motion = tuple[Array, Array]


def on_the_spot(speed: float) -> Motion:
    roots, rotations = walking_arrays(speed, seconds=2)
    roots[:, :2] = 0
    return roots, rotations


def seat(frames: int = 9) -> Motion:
    """Sitting, both thighs ahead."""
    roots, rotations = walking_arrays(0, seconds=(frames - 1) / 30)
    roots[:, 2] = 0.1
    for thigh in ("thigh.L", "thigh.R"):
        rotations[:, NAMES.index(thigh)] = [np.sqrt(0.5), np.sqrt(0.5), 0, 0]
    return roots, rotations


def one_after_the_other(skeleton: core.Skeleton, *motions: Motion) -> core.Clip:
    roots, rotations = (np.concatenate(arrays) for arrays in zip(*motions))
    return core.Clip(skeleton, "all", 30.0, roots, rotations)


def test_parts_of_a_clip_that_tears_go_each_on_its_own_way(skeleton: core.Skeleton) -> None:
    motions = on_the_spot(0), seat(), on_the_spot(1.2)
    medley = one_after_the_other(skeleton, *motions)
    assert medley.discontinuities(skeleton) == [61, 70]
    led = led_by_feet(medley, skeleton)
    assert [each.first for each in led] == [0, 61, 70]
    assert [each.speed > 0 for each in led] == [False, False, True]
    alone = core.Clip(skeleton, "walk", 30.0, *motions[2]).led_by_feet(skeleton)
    assert alone is not None and led[2].speed == alone[1]
    assert np.array_equal(led[2].clip.root_positions, alone[0].root_positions)


def test_a_clip_that_goes_nowhere_stays_whole(skeleton: core.Skeleton) -> None:
    medley = one_after_the_other(skeleton, on_the_spot(0), seat(), on_the_spot(0))
    assert medley.discontinuities(skeleton)
    (led,) = led_by_feet(medley, skeleton)
    assert led.clip is medley and led.speed == 0
