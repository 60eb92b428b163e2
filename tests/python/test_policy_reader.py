# SPDX-License-Identifier: MIT
"""The file format is what docs/game.md says: a reader that shares no code with the core reads the same."""

from __future__ import annotations

from pathlib import Path

import fragmotion_core as core
import numpy as np
import pytest
from conftest import build_options, make_skeleton, walking_clips
from policy_reader import read_policy

DATA = Path(__file__).parents[1] / "data"


def test_a_reader_of_its_own_reads_the_same_poses(character: core.Character) -> None:
    clips = walking_clips(make_skeleton())
    moving = character.with_moves([core.Move("stroll", clips[0]), core.Move("nod", clips[1], upper_body=True)])
    made = core.with_styles([("normal", moving), ("tired", character)])
    policy = read_policy(made.to_bytes())
    assert policy.bones == made.skeleton.names
    assert [move[0] for move in policy.moves] == made.move_names
    for (_, clip, upper_body, _, _, _), move in zip(policy.moves, made.moves):
        read = policy.styles[0].clips[clip]
        assert upper_body == move.upper_body
        assert np.abs(read.places - move.clip.root_positions).max() < 1e-6
        signs = np.sign((read.rotations * move.clip.rotations).sum(-1, keepdims=True))
        assert np.abs(signs * read.rotations - move.clip.rotations).max() < 1e-6
    for number, style in enumerate(policy.styles):
        told = made.in_style(number)
        assert style.name == made.style_names[number]
        assert [clip.name for clip in style.clips][: len(told.clip_names)] == told.clip_names
        assert (style.labels == told.labels).all() and (style.representatives == told.representatives).all()
        assert (style.tables[told.policy] == told.table).all()
        assert [f[0] for f in style.fragments] == told.fragment_clips.tolist()
        assert np.array_equal([f[4] for f in style.fragments], told.evident)
        assert style.speeds == list(told.space.speeds)


def test_mirrored_clips_are_the_mirror_images_of_their_originals(character: core.Character) -> None:
    clips = {clip.name: clip for clip in read_policy(character.to_bytes()).styles[0].clips}
    images = [name for name in clips if f"{name} mirrored" in clips]
    assert images
    for name in images:
        clip, read = clips[name], clips[f"{name} mirrored"]
        original = core.Clip(character.skeleton, name, clip.rate, clip.places, clip.rotations)
        (image,) = core.mirrored(character.skeleton, [original])
        assert np.abs(read.places - image.root_positions).max() < 1e-6
        signs = np.sign((read.rotations * image.rotations).sum(-1, keepdims=True))
        assert np.abs(signs * read.rotations - image.rotations).max() < 1e-6


@pytest.mark.parametrize("version", [3, 4, 5])
def test_it_reads_the_files_of_all_versions(version: int) -> None:
    data = (DATA / f"version-{version}.policy").read_bytes()
    policy, character = read_policy(data), core.Character.from_bytes(data)
    assert policy.bones == character.skeleton.names
    assert (policy.styles[0].labels == character.labels).all()  # tables are repaired as they are loaded
    for clip in policy.styles[0].clips:
        assert np.allclose(np.linalg.norm(clip.rotations, axis=-1), 1, atol=1e-6)


def test_it_reads_the_markers_that_were_set(tmp_path: Path) -> None:
    skeleton = make_skeleton()
    first, *others = walking_clips(skeleton)[:3]
    marked = first.with_markers([(2.0, "left"), (7.5, "über")])
    trace = core.simulate_trace("explorer", 8, 1)
    built = core.build(skeleton, [marked, *others], [trace], build_options(classes=4, restarts=1))
    nod = others[0].with_markers([(0.0, "nod")])
    made = core.with_styles([("normal", built.with_moves([core.Move("nod", nod, upper_body=True)])), ("other", built)])
    for data in (made.to_bytes(), core.Character.from_bytes(made.to_bytes()).to_bytes()):
        policy = read_policy(data)
        for style in policy.styles:
            clips = {clip.name: clip.markers for clip in style.clips}
            assert clips[first.name] == clips[f"{first.name} mirrored"] == marked.markers
            assert not clips[others[0].name]
        assert policy.styles[0].clips[policy.moves[0][1]].markers == [(0.0, "nod")]
    assert core.Character.from_bytes(made.to_bytes()).moves[0].clip.markers == [(0.0, "nod")]


def test_a_player_tells_the_markers_that_it_passes() -> None:
    skeleton = make_skeleton()
    clips = walking_clips(skeleton)[:3]
    built = core.build(skeleton, clips, [core.simulate_trace("explorer", 8, 1)], build_options(classes=4, restarts=1))
    stroll = clips[0].with_markers([(3.0, "whoosh"), (9.0, "thud")])
    player = core.Player(built.with_moves([core.Move("stroll", stroll)]))
    player.start_move(0)
    told = []
    for _ in range(300):
        player.step([0, 1.2, 0, 0], 1 / 60)
        told += player.passed_markers
    assert told == ["whoosh", "thud"]
