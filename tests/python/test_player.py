# SPDX-License-Identifier: MIT
"""What a player plays: every frame, the same by steps as at once."""

from __future__ import annotations

import fragmotion_core as core
import numpy as np
import pytest
from conftest import NAMES, OFFSETS, PARENTS, TIPS, Array, small_build, walking_arrays


@pytest.mark.parametrize("rate", [24, 25, 29.97, 30, 60, 120])
def test_player_gives_every_frame_of_any_rate(character: core.Character, rate: float) -> None:
    performance = core.Player(character).run(core.simulate_trace("explorer", 7, 1), rate)
    frames = round(7 * rate) + 1
    bones = len(NAMES)
    assert performance.rate == rate
    shapes = {"root_positions": (frames, 3), "rotations": (frames, bones, 4), "path": (frames, 3)}
    shapes |= {"classes": (frames,), "fragments": (frames,), "entered": (frames,)}
    for name, shape in shapes.items():
        assert getattr(performance, name).shape == shape
    np.testing.assert_allclose(np.linalg.norm(performance.rotations, axis=-1), 1, atol=1e-6)
    np.testing.assert_allclose(performance.path[:, :2], performance.root_positions[:, :2], atol=1e-9)
    assert 0 < performance.quality <= 1
    assert performance.velocity_error >= 0 and performance.commanded_speed > 0 and performance.drift > 0
    assert performance.classes.dtype == np.int32
    np.testing.assert_array_equal(character.labels[performance.fragments], performance.classes)


def test_player_steps_as_it_runs(character: core.Character) -> None:
    one, two = core.Player(character, seed=2), core.Player(character, seed=2)
    for player in (one, two):
        player.reset(2, -1, 0.5)
        np.testing.assert_allclose(player.frame, (2, -1, 0.5), atol=1e-9)
    performance = one.run(np.tile([0, 1.2, 0, 0], (20, 1)), 30)
    for f in range(1, 61):
        root, rotations = two.step([0, 1.2, 0, 0], 1 / 30)
        np.testing.assert_allclose(root, performance.root_positions[f], atol=1e-9)
        np.testing.assert_allclose(rotations, performance.rotations[f], atol=1e-9)
    assert two.playing == (performance.classes[-1], performance.fragments[-1])


def test_options_are_given_together_or_one_by_one(character: core.Character) -> None:
    plain = core.PlayerOptions()
    assert (plain.seed, plain.stitch, plain.policy, plain.stitching) == (1, 0.2, "", "inertialize")
    assert (plain.lock_feet, plain.root_adjustment, plain.responsiveness) == (True, 1.0, 0.5)
    options = core.PlayerOptions(seed=5, stitching="crossfade")
    options.responsiveness = 0.8
    trace = core.simulate_trace("explorer", 4, 1)
    together = core.Player(character, options).run(trace, 30)
    apart = core.Player(character, seed=5, stitching="crossfade", responsiveness=0.8).run(trace, 30)
    assert together.rotations.tobytes() == apart.rotations.tobytes()
    assert together.rotations.tobytes() != core.Player(character).run(trace, 30).rotations.tobytes()
    np.testing.assert_array_equal(
        core.response_times(character, options),
        core.response_times(character, seed=5, stitching="crossfade", responsiveness=0.8),
    )
    assert len(core.Crowd(character, 2, options, threads=1)) == 2
    with pytest.raises(ValueError, match="there is no stitching"):
        options.stitching = "none"
    options.stitch = 2
    with pytest.raises(ValueError, match="stitching time"):
        core.Player(character, options)


def test_player_tells_eq_2_of_what_plays(character: core.Character) -> None:
    player = core.Player(character, seed=3)
    playing = player.playing[0]
    asked = [0.0, 1.2, 0.0, 0.0]
    point = int(character.space.nearest([asked])[0])
    for _ in range(240):
        entered, left = player.entered, player.seconds_left
        player.step(asked, 1 / 60)
        if player.entered == entered:
            assert left - 1.2 / 60 - 1e-9 <= player.seconds_left < left, "at most 1.2 times as fast as captured"
        else:
            wanted = character.smoothness[playing, player.playing[0]] * character.match[player.playing[0], point]
            assert player.quality(asked) == pytest.approx(wanted, rel=1e-12)
        playing = player.playing[0]
        assert 0 <= player.seconds_left <= character.fragment_durations[player.playing[1]]
    assert player.entered > 4


def test_player_tells_which_feet_stand(character: core.Character) -> None:
    player, skeleton = core.Player(character, seed=3), character.skeleton
    feet = [NAMES.index("foot.L"), NAMES.index("foot.R")]
    player.step([0, 0, 0, 0], 1)
    assert player.standing_feet.shape == (2, 3), "a body that stands, stands on both"
    counts = set()
    for _ in range(240):
        root, rotations = player.step([0, 1.2, 0, 0], 1 / 60)
        standing = player.standing_feet
        counts.add(len(standing))
        clip = core.Clip(skeleton, "now", 60.0, np.tile(root, (2, 1)), np.tile(rotations, (2, 1, 1)))
        heads, _ = clip.world_transforms(skeleton)
        for sole in standing:
            gap = np.linalg.norm(heads[0, feet] - sole, axis=1).min()
            assert gap < np.linalg.norm(skeleton.tips[feet[0]]), "between the heel and the tip of a foot"
    assert {0, 1} <= counts


def test_player_keeps_its_character_alive(skeleton: core.Skeleton, clips: list[core.Clip], traces: list[Array]) -> None:
    player = core.Player(small_build(skeleton, clips, traces, lambda *_: True))
    for _ in range(50):
        root, _ = player.step([0, 1.2, 0, 0], 0.05)
    assert np.isfinite(root).all()


def test_player_plays_each_of_the_policies(character: core.Character, traces: list[Array]) -> None:
    for policy in character.policies:
        assert 0 < character.percent_of_optimal(traces[0], policy) <= 100 + 1e-9
        assert core.Player(character, policy=policy).run(traces[0][:50], 30).quality > 0
    assert character.percent_of_optimal(traces[0]) == character.percent_of_optimal(traces[0], character.policies[0])


def test_a_player_looks_as_one_that_runs_with_looks(character: core.Character) -> None:
    trace = core.simulate_trace("walker", 4, 3, character.space)
    looks = [[5, 2, 1.0, 4.0, 1.2], [20, 1, 0, 0, 0], [32, 0, 0, 0, 0]]
    ran = core.Player(character).run(trace, 60, looks=looks)
    plain = core.Player(character).run(trace, 60)
    player = core.Player(character)
    for frame in range(1, 241):
        for begin, *look in looks:
            if frame == 6 * begin + 1:
                player.look(*look)
        root, rotations = player.step(trace[(frame - 1) // 6], 1 / 60)
        assert (root == ran.root_positions[frame]).all() and (rotations == ran.rotations[frame]).all()
    assert (ran.root_positions == plain.root_positions).all()
    differs = (ran.rotations != plain.rotations).any((1, 2))
    assert not differs[:31].any() and differs[40:120].all()
    turned = (ran.rotations != plain.rotations).any((0, 2))
    above = {NAMES[bone] for bone in np.flatnonzero(turned)}
    assert "head" in above and not above & {"hips", "thigh.L", "foot.R", "hand.L"}


@pytest.mark.parametrize(
    ("looks", "why"),
    [
        ([[0, 3, 0, 0, 0]], "a look must be 0"),
        ([[99, 1, 0, 0, 0]], "a look is asked for before control 99"),
        ([[0.5, 1, 0, 0, 0]], "whole numbers"),
        ([[0, 1, 0, 0]], "looks"),
    ],
)
def test_looks_that_there_are_not_are_refused(character: core.Character, looks: list[list[float]], why: str) -> None:
    with pytest.raises(ValueError, match=why):
        core.Player(character).run(np.zeros((10, 4)), 30, looks=looks)


@pytest.fixture(scope="module")
def armed(traces: list[Array]) -> core.Character:
    """A character of the same body, but that its hands hang from arms with an elbow."""
    names, parents, offsets, tips, columns = [], [], [], [], []
    for bone, name in enumerate(NAMES):
        hand, end = name.startswith("hand"), name[-2:]
        parent = -1 if PARENTS[bone] < 0 else names.index(NAMES[PARENTS[bone]])
        for part, offset, tip in (("upper_arm", OFFSETS[bone], [0, 0, -0.3]), ("forearm", [0, 0, -0.3], [0, 0, -0.25])):
            if hand:
                names.append(part + end)
                parents.append(parent)
                offsets.append(offset)
                tips.append(tip)
                columns.append(bone if part == "upper_arm" else -1)
                parent = len(names) - 1
        names.append(name)
        parents.append(parent)
        offsets.append([0, 0, -0.25] if hand else OFFSETS[bone])
        tips.append([0, 0, -0.1] if hand else TIPS[bone])
        columns.append(-1 if hand else bone)
    skeleton = core.Skeleton(names, parents, np.tile([1.0, 0, 0, 0], (len(names), 1)), offsets, tips)
    clips = []
    for number, speed in enumerate((0.0, 1.2, 3.0)):
        roots, rotations = walking_arrays(speed)
        still = np.concatenate((rotations, np.tile([1.0, 0, 0, 0], (len(roots), 1, 1))), 1)
        clips.append(core.Clip(skeleton, f"gait {number}", 30.0, roots, still[:, columns]))
    return small_build(skeleton, clips, traces, lambda fraction, stage: True)


def test_a_player_reaches_as_one_that_runs_with_reaches(armed: core.Character) -> None:
    character, names = armed, armed.skeleton.names
    trace = core.simulate_trace("walker", 4, 3, character.space)
    reaches = [[5, 1, 0.8, 1, 0.3, 0.4, 1.2], [9, 1, 1.0, 1, 0.3, 0.4, 1.1], [25, 1, 0.0, 1, 0.3, 0.4, 1.1]]
    ran = core.Player(character).run(trace, 60, reaches=reaches)
    plain = core.Player(character).run(trace, 60)
    player = core.Player(character)
    for frame in range(1, 241):
        for begin, hand, weight, carried, *place in reaches:
            if frame == 6 * begin + 1:
                player.reach(int(hand), weight, bool(carried), *place)
        root, rotations = player.step(trace[(frame - 1) // 6], 1 / 60)
        assert (root == ran.root_positions[frame]).all() and (rotations == ran.rotations[frame]).all()
    assert (ran.root_positions == plain.root_positions).all()
    differs = (ran.rotations != plain.rotations).any((1, 2))
    assert not differs[:31].any() and differs[40:150].all() and not differs[200:].any()
    turned = {names[bone] for bone in np.flatnonzero((ran.rotations != plain.rotations).any((0, 2)))}
    assert turned >= {"upper_arm.R", "forearm.R"} and not turned & {"hips", "thigh.L", "foot.R", "upper_arm.L"}


@pytest.mark.parametrize(
    ("reaches", "why"),
    [
        ([[0, 2, 1, 0, 0, 0, 0]], "hand 2"),
        ([[0, 1, 1.5, 0, 0, 0, 0]], "the weight of a hand"),
        ([[99, 1, 1, 0, 0, 0, 0]], "a hand is asked for before control 99"),
        ([[0, 0.5, 1, 0, 0, 0, 0]], "whole numbers"),
        ([[0, 1, 1, 0]], "reaches"),
    ],
)
def test_reaches_that_there_are_not_are_refused(
    character: core.Character, reaches: list[list[float]], why: str
) -> None:
    with pytest.raises(ValueError, match=why):
        core.Player(character).run(np.zeros((10, 4)), 30, reaches=reaches)
