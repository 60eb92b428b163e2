# SPDX-License-Identifier: MIT
"""Build from little or odd input, and what it refuses."""

from __future__ import annotations

import fragmotion_core as core
import numpy as np
import pytest
from conftest import NAMES, OFFSETS, Array, build_options, make_skeleton, walking_arrays, walking_clips


def test_build_makes_what_it_can_of_little(skeleton: core.Skeleton, clips: list[core.Clip]) -> None:
    """One class, a trace of one control, takes of standing only."""
    forward = np.tile([0, 1.2, 0, 0], (30, 1))
    for takes, classes in ((clips, 1), (clips, 10), (clips[:1], 1)):
        made = core.build(skeleton, takes, [forward], build_options(classes=classes))
        assert (made.table >= 0).all() and (made.table < classes).all()
        for policy in made.policies:
            assert 0 < made.percent_of_optimal(forward, policy) <= 100 + 1e-9
            assert np.isfinite(core.Player(made, policy=policy).run(forward, 30).root_positions).all()


def test_build_has_no_more_classes_than_distinct_fragments(skeleton: core.Skeleton, clips: list[core.Clip]) -> None:
    options = build_options(classes=4000, mirror=False, synthesize=False)
    one, five = (core.build(skeleton, clips[:1] * times, [np.zeros((2, 4))], options) for times in (1, 5))
    assert len(five.representatives) == len(one.representatives) <= len(five.labels) / 5


def test_build_refuses_clips_of_another_skeleton(clips: list[core.Clip], traces: list[Array]) -> None:
    small = core.Skeleton(["hips"], [-1], [[1, 0, 0, 0]], [[0, 0, 1]], [[0, 0, 0.1]])
    with pytest.raises(ValueError, match="gait 0"):
        core.build(small, clips, traces, build_options(classes=5))


def test_build_refuses_takes_without_a_fragment(skeleton: core.Skeleton, traces: list[Array]) -> None:
    roots, rotations = walking_arrays(seconds=0.07)
    with pytest.raises(ValueError, match="too short"):
        core.build(skeleton, [core.Clip(skeleton, "blink", 30, roots, rotations)], traces, build_options(classes=2))


def test_build_takes_skeletons_of_one_bone_and_without_feet(traces: list[Array]) -> None:
    bone = core.Skeleton(["stick"], [-1], [[1, 0, 0, 0]], [[0, 0, 0]], [[0, 0, 1]])
    roots, rotations = walking_arrays()
    clip = core.Clip(bone, "slide", 30, roots, rotations[:, :1])
    assert len(core.build(bone, [clip], traces, build_options(classes=3)).representatives) == 3
    names = [f"part {i}" for i in range(len(NAMES))]
    footless = make_skeleton(names=names, offsets=[*OFFSETS[:7], [0.1, 0.4, 0], OFFSETS[8]])  # no limb has its like
    assert "left_foot" not in footless.roles
    made = core.build(footless, walking_clips(footless), traces, build_options(classes=5, policies=["greedy"]))
    assert len(made.representatives) == 5
