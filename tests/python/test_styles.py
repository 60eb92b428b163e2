# SPDX-License-Identifier: MIT
"""Styles: one character that walks as usual and tired, and changes between them."""

from __future__ import annotations

import fragmotion_core as core
import numpy as np
import pytest
from conftest import BANDAI, NAMES, build_options, small_build

from tools.measuring.directing.measures.styles import Style
from tools.measuring.directing.measures.styles import styles as measured_styles

NORMAL, TIRED = 0, 1
SLOWER = 0.75


@pytest.fixture(scope="module")
def tired_clips(skeleton: core.Skeleton, clips: list[core.Clip]) -> list[core.Clip]:
    """The takes with a bent back, at three quarters of their speed."""
    tired = []
    for clip in clips:
        rotations = np.array(clip.rotations)
        rotations[:, NAMES.index("spine")] = (np.cos(0.25), np.sin(0.25), 0, 0)
        tired.append(core.Clip(skeleton, f"tired {clip.name}", SLOWER * clip.rate, clip.root_positions, rotations))
    return tired


@pytest.fixture(scope="module")
def tired(skeleton: core.Skeleton, tired_clips: list[core.Clip], traces: list[np.ndarray]) -> core.Character:
    options = build_options(classes=30, policies=["anticipate", "iterate", "svm", "greedy"])
    return core.build(skeleton, tired_clips, traces, options)


@pytest.fixture(scope="module")
def styled(character: core.Character, tired: core.Character) -> core.Character:
    return core.with_styles([("normal", character), ("tired", tired)])


def test_a_character_tells_its_styles(styled: core.Character, character: core.Character, tired: core.Character) -> None:
    assert styled.style_names == ["normal", "tired"] and character.style_names == []
    assert styled.in_style(NORMAL).to_bytes() == styled.to_bytes()
    assert styled.in_style(TIRED).space.walk == pytest.approx(SLOWER * styled.space.walk, rel=0.05)
    for name in ("table", "smoothness", "match", "evident", "labels"):
        assert (getattr(styled.in_style(TIRED), name) == getattr(tired, name)).all()
    back = core.Character.from_bytes(styled.to_bytes())
    assert back.style_names == styled.style_names
    assert (back.in_style(TIRED).table == tired.table).all()


def test_one_build_makes_what_builds_of_each_style_make(
    skeleton: core.Skeleton, clips: list[core.Clip], tired_clips: list[core.Clip], traces: list[np.ndarray]
) -> None:
    fractions: list[float] = []

    def report(fraction: float, _stage: str) -> None:
        fractions.append(fraction)

    styles = [("normal", clips), ("tired", tired_clips)]
    both = core.build_styles(skeleton, styles, traces, build_options(classes=10), report)
    assert fractions == sorted(fractions) and fractions[-1] == 1
    for number, (_, takes) in enumerate(styles):
        alone = small_build(skeleton, takes, traces, lambda _fraction, _stage: None)
        assert (both.in_style(number).table == alone.table).all()


def test_a_player_changes_its_style(styled: core.Character) -> None:
    trace = np.tile(np.array([0, styled.space.walk, 0, 0]), (80, 1))
    ran = core.Player(styled).run(trace, 60, styles=[[20, TIRED], [50, NORMAL]])
    changes = np.flatnonzero(np.diff(ran.styles)) / 60
    assert len(changes) == 2
    assert 2 <= changes[0] <= 2.85 and 5 <= changes[1] <= 5.85
    spine = ran.rotations[:, NAMES.index("spine"), 1]
    assert abs(spine[110]) < 0.1 and spine[280] == pytest.approx(np.sin(0.25), abs=0.05)


def test_a_player_that_is_stepped_does_as_one_that_runs(styled: core.Character) -> None:
    trace = core.simulate_trace("walker", 6, 3, styled.space)
    first = core.Player(styled)
    first.reset(style=TIRED)
    ran = first.run(trace, 60, styles=[[15, NORMAL], [40, TIRED]])
    player = core.Player(styled)
    player.reset(style=TIRED)
    for frame in range(1, 361):
        control = (frame - 1) // 6
        for begin, style in ((15, NORMAL), (40, TIRED)):
            if frame == 6 * begin + 1:
                player.change_style(style)
                assert player.waiting_style == style
        root, rotations = player.step(trace[control], 1 / 60)
        assert (root == ran.root_positions[frame]).all() and (rotations == ran.rotations[frame]).all()
        assert player.playing_style == ran.styles[frame]
        assert player.playing == (ran.classes[frame], ran.fragments[frame])


def test_crowds_have_styles(styled: core.Character) -> None:
    crowd, alone = core.Crowd(styled, 3, seed=4), core.Player(styled, seed=5)
    crowd.reset(1, style=TIRED)
    alone.reset(style=TIRED)
    controls = np.tile(np.array([0, 1.0, 0, 0]), (3, 1))
    for frame in range(120):
        if frame == 30:
            crowd.change_style(1, NORMAL)
            alone.change_style(NORMAL)
        roots, _ = crowd.step_many(controls, 1 / 60)
        root, _ = alone.step(controls[0], 1 / 60)
        assert (roots[1] == root).all()
    assert alone.playing_style == NORMAL


def test_a_path_is_followed_in_the_style_that_plays(styled: core.Character) -> None:
    player = core.Player(styled)
    player.reset(style=TIRED)
    walk = core.follow_path(player, core.Path([[0, 0], [0, 6]]))
    assert walk.asked_speed == pytest.approx(styled.in_style(TIRED).space.walk, rel=1e-6)
    assert player.playing_style == TIRED


@pytest.mark.parametrize(
    ("styles", "message"),
    [
        ([[0, 2]], "style 2 does not exist; the character has 2"),
        ([[0, 0.5]], "whole numbers"),
        ([[50, 0]], "before control 50 of a trace of 50"),
        ([0, 0], "styles"),
        ([[np.nan, 0]], "styles"),
    ],
)
def test_changes_that_cannot_be_are_refused(styled: core.Character, styles: object, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        core.Player(styled).run(np.zeros((50, 4)), 30, styles=styles)


def test_styles_that_cannot_be_are_refused(
    styled: core.Character, character: core.Character, skeleton: core.Skeleton, clips: list[core.Clip]
) -> None:
    with pytest.raises(ValueError, match="style 2 does not exist; the character has 2"):
        styled.in_style(2)
    with pytest.raises(ValueError, match=r'style "a": it is there twice'):
        core.with_styles([("a", character), ("a", character)])
    with pytest.raises(ValueError, match=r'style "b": its character has styles itself'):
        core.with_styles([("a", character), ("b", styled)])
    trace = core.simulate_trace("walker", 20, 1)
    short = core.Clip(skeleton, "short", 30.0, clips[0].root_positions[:3], clips[0].rotations[:3])
    with pytest.raises(ValueError, match=r'style "short": the takes are too short'):
        core.build_styles(skeleton, [("all", clips), ("short", [short])], [trace], build_options(classes=10))


def test_the_measure_tells_quality_and_changes(
    skeleton: core.Skeleton, clips: list[core.Clip], tired_clips: list[core.Clip], traces: list[np.ndarray]
) -> None:
    def build(takes: object) -> core.Character:
        return core.build_styles(skeleton, takes, traces, build_options(classes=20, policies=["anticipate"]))

    takes: list[Style] = [("normal", clips), ("tired", tired_clips)]
    assert measured_styles(takes[:1], build, 1) == []
    for row, (name, _) in zip(measured_styles(takes, build, 1), takes):
        assert row["name"] == name
        assert row["percent_of_optimal"] == row["alone"] > 60
        assert 0 < row["change_s"] <= 1.5
        assert 0 < row["joint_step_ratio"] < 2


@pytest.mark.skipif(not BANDAI.is_dir(), reason="no motion capture beside the project")
def test_captured_styles_meet_the_goals() -> None:
    takes = {path.stem: core.read_bvh(path) for path in sorted(BANDAI.glob("dataset-1_*.bvh"))}
    skeleton = next(iter(takes.values())).skeleton
    styles = [
        (style, [core.Clip.from_take(take, skeleton) for name, take in takes.items() if f"_{style}_" in name])
        for style in ("normal", "active")
    ]
    trace = core.simulate_trace("explorer", 60, 1)
    options = build_options(policies=["anticipate"])
    for row in measured_styles(styles, lambda some: core.build_styles(skeleton, some, [trace], options), 1):
        assert row["percent_of_optimal"] >= row["alone"] - 1
        assert row["change_s"] <= 1.5
        assert row["joint_step_ratio"] < 1.1
