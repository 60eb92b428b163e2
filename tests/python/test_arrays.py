# SPDX-License-Identifier: MIT
"""The binding's arrays: their shapes and types, views that are read-only, and what is kept of what is given."""

from __future__ import annotations

from typing import Any

import fragmotion_core as core
import numpy as np
import pytest
from conftest import NAMES, Array, build_options, make_skeleton, walking_arrays


def test_character_has_the_documented_shapes_and_types(character: core.Character) -> None:
    fragments, classes = len(character.fragment_clips), 30
    expected = {
        "fragment_clips": ((fragments,), np.int32),
        "fragment_ranges": ((fragments, 2), np.float64),
        "fragment_durations": ((fragments,), np.float64),
        "evident": ((fragments, 4), np.float64),
        "labels": ((fragments,), np.int32),
        "representatives": ((classes,), np.int32),
        "smoothness": ((classes, classes), np.float64),
        "match": ((classes, 102), np.float64),
        "table": ((classes, 102), np.int32),
        "bridges": ((classes, classes), np.int32),
        "coverage_counts": ((102,), np.int32),
        "coverage_distances": ((102,), np.float64),
    }
    for name, (shape, dtype) in expected.items():
        array = getattr(character, name)
        assert array.shape == shape, name
        assert array.dtype == dtype, name
    assert len(character.fragment_origins) == fragments
    assert set(character.fragment_origins) <= {"captured", "mirrored", "interpolated", "transformed"}
    assert character.report["fragments"] == fragments
    assert character.policies == ["anticipate", "iterate", "svm", "greedy"]


def test_character_says_what_holds_together(character: core.Character) -> None:
    np.testing.assert_array_equal(character.labels[character.representatives], np.arange(30))
    assert (character.table >= 0).all() and (character.table < 30).all()
    assert (character.bridges >= -1).all() and (character.bridges < 30).all()
    assert character.coverage_counts.sum() == len(character.labels)
    ranges = character.fragment_ranges
    np.testing.assert_allclose(ranges[:, 1] - ranges[:, 0], character.fragment_durations, atol=1e-12)
    assert character.fragment_clips.max() < len(character.clip_names)
    nearest = [character.space.distance(character.evident[0], point) for point in character.space.points]
    assert character.space.nearest(character.evident[:1])[0] == int(np.argmin(nearest))


@pytest.mark.parametrize("name", ["labels", "representatives", "smoothness", "match", "table", "bridges"])
def test_views_are_read_only_and_outlive_their_owner(
    skeleton: core.Skeleton, clips: list[core.Clip], traces: list[Array], name: str
) -> None:
    made = core.build(skeleton, clips[:3], traces, build_options(classes=4, policies=["greedy"], synthesize=False))
    array = getattr(made, name)
    copy = array.copy()
    with pytest.raises(ValueError, match="read-only"):
        array[0] = 0
    del made
    core.build(skeleton, clips[:2], traces, build_options(classes=4, policies=["greedy"], synthesize=False))
    np.testing.assert_array_equal(array, copy)


def test_clips_and_performances_are_read_only_views(clips: list[core.Clip], character: core.Character) -> None:
    performance = core.Player(character).run(np.zeros((5, 4)), 30)
    for array in (clips[0].root_positions, clips[0].rotations, performance.root_positions, performance.rotations):
        assert not array.flags.owndata
        with pytest.raises(ValueError, match="read-only"):
            array[0] = 0


def test_clips_keep_what_they_are_given(skeleton: core.Skeleton) -> None:
    roots, rotations = walking_arrays(turn=0.5)
    clip = core.Clip(skeleton, "walk", 29.97, roots, rotations)
    assert (clip.name, clip.rate) == ("walk", 29.97)
    np.testing.assert_array_equal(clip.root_positions, roots)
    np.testing.assert_allclose(np.abs((clip.rotations * rotations).sum(-1)), 1, atol=1e-12)
    positions, world = clip.world_transforms(skeleton)
    assert positions.shape == (len(roots), len(NAMES), 3) and world.shape == (len(roots), len(NAMES), 4)
    np.testing.assert_allclose(positions[:, 0], roots, atol=1e-12)


@pytest.mark.parametrize("turn", [0.0, 1.2, -0.7])
def test_clips_tell_where_the_character_stands_and_faces(skeleton: core.Skeleton, turn: float) -> None:
    roots, rotations = walking_arrays(side=0.5, turn=turn)
    frames = core.Clip(skeleton, "walk", 30.0, roots, rotations).character_frames(skeleton)
    np.testing.assert_allclose(frames[:, :2], roots[:, :2], atol=1e-12)
    np.testing.assert_allclose(np.unwrap(frames[:, 2]), turn * np.arange(len(roots)) / 30, atol=1e-9)
    with pytest.raises(ValueError, match="number of bones"):
        core.Clip(skeleton, "walk", 30.0, roots, rotations).character_frames(
            make_skeleton(
                **{
                    name: getattr(skeleton, name)[:5]
                    for name in ("names", "parents", "offsets", "tips", "rest_rotations")
                }
            )
        )


@pytest.mark.parametrize("kind", [np.float32, np.int64, "F", list])
def test_arrays_of_other_kinds_are_converted(character: core.Character, kind: Any) -> None:
    trace = np.array([[0, 1, 0, 0], [0, 1, 1, 0], [1, 0, 0, 0]])
    given = (
        trace.tolist()
        if kind is list
        else np.asfortranarray(trace.astype(float))
        if kind == "F"
        else trace.astype(kind)
    )
    np.testing.assert_array_equal(character.optimal(given)[0], character.optimal(trace.astype(float))[0])


def test_skeleton_tells_what_it_was_made_of(skeleton: core.Skeleton) -> None:
    assert skeleton.names == NAMES
    assert skeleton.roles["left_foot"] == "foot.L"
    np.testing.assert_allclose(skeleton.rest_heads()[6], [0.1, 0, 0.08])
    np.testing.assert_allclose(skeleton.rest_tails()[6], [0.1, -0.2, 0], atol=1e-12)
    other = make_skeleton(roles={"head": "spine"})
    assert other.roles["head"] == "spine"
