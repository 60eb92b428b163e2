# SPDX-License-Identifier: MIT
"""How like the takes a motion looks: each figure where its answer is known, and takes that are compared with takes."""

from __future__ import annotations

import fragmotion_core as core
import numpy as np
import pytest
from conftest import Array, make_skeleton, walking_arrays, walking_clips
from fragmotion_command.evaluate.likeness import motion, poses, telling, windows
from fragmotion_command.evaluate.likeness.poses import RATE, Body, Poses, body_of, heading, poses_of
from fragmotion_command.evaluate.likeness.reenacting import Likeness, stays
from fragmotion_command.evaluate.loading import Recordings


@pytest.fixture(scope="module")
def body(skeleton: core.Skeleton) -> Body:
    return body_of(skeleton)


@pytest.fixture(scope="module")
def likeness(skeleton: core.Skeleton, clips: list[core.Clip]) -> Likeness:
    return Likeness(Recordings(skeleton, clips))


def standing(body: Body, frames: int) -> Array:
    """[F,B,3]: the body at rest."""
    places: Array = np.repeat(body.skeleton.rest_heads()[None, body.bones], frames, 0)
    return places


def samples(count: int, dimensions: int = 4) -> Array:
    return np.random.default_rng(1).normal(size=(count, dimensions))


# --- windows ---------------------------------------------------------------------------------------------------------


def test_frechet_of_equal_sets_is_0_and_of_shifted_ones_the_shifts_square() -> None:
    some = samples(500)
    assert windows.frechet(some, some) == pytest.approx(0, abs=1e-9)
    assert windows.frechet(some, some + np.array([3, 0, 4, 0])) == pytest.approx(25)


def test_frechet_of_scaled_gaussians_is_what_their_spreads_differ() -> None:
    some = samples(500)
    spread = np.trace(np.cov(some.T))
    about_mean = 3 * (some - some.mean(0)) + some.mean(0)
    assert windows.frechet(some, about_mean) == pytest.approx((3 - 1) ** 2 * spread)


def test_frechet_of_fewer_samples_than_dimensions_is_a_number() -> None:
    assert windows.frechet(samples(3), samples(3) + 1) == pytest.approx(4)


def test_the_nearest_is_the_nearest() -> None:
    some = samples(700)
    assert windows.nearest(some, some) == 0
    assert windows.nearest(np.array([[0.0, 0], [10, 0]]), np.array([[0.0, 1], [10, 2], [99, 0]])) == 1.5


def test_a_window_does_not_tell_where_its_motion_is_nor_where_it_goes(body: Body) -> None:
    def seen(heading: float, place: Array) -> Array:
        half = np.array([np.cos(heading / 2), 0, 0, np.sin(heading / 2)])
        roots, rotations = walking_arrays(1.2, 0, 0.4)
        cosine, sine = np.cos(heading), np.sin(heading)
        roots = roots @ np.array([[cosine, sine, 0], [-sine, cosine, 0], [0, 0, 1]]) + place
        w, z = rotations[:, 0, 0].copy(), rotations[:, 0, 3].copy()
        rotations[:, 0, 0], rotations[:, 0, 3] = half[0] * w - half[3] * z, half[0] * z + half[3] * w
        clip = core.Clip(body.skeleton, "turned", 30, roots, rotations)
        return windows.windows(body, poses_of(body, clip).heads, [(0, 180)])

    np.testing.assert_allclose(seen(2.1, np.array([5.0, -3, 0])), seen(0, np.zeros(3)), atol=1e-9)


def test_principal_axes_are_those_along_which_most_differs() -> None:
    values = samples(400, 40) * np.linspace(5, 0.1, 40)
    axes = windows.principal_axes(values, values.mean(0))
    np.testing.assert_allclose(axes.T @ axes, np.eye(windows.COMPONENTS), atol=1e-9)
    spread = (values - values.mean(0)) @ axes
    assert (np.diff(spread.std(0)) < 1e-9).all()


def test_a_classifier_tells_what_differs_and_guesses_where_nothing_does() -> None:
    def motions(seed: int, scale: float, shift: float) -> list[Array]:
        random = np.random.default_rng(seed)
        return [scale * random.normal(size=(60, 5)) + shift for _ in range(8)]

    assert telling.told_apart(motions(1, 1, 0), motions(2, 1, 0)) == pytest.approx(0.5, abs=0.05)
    assert telling.told_apart(motions(1, 1, 0), motions(2, 1, 5)) > 0.999
    assert telling.told_apart(motions(1, 1, 0), motions(2, 3, 0)) > 0.95, "of equal means"
    assert np.isnan(telling.told_apart(motions(1, 1, 0)[:1], motions(2, 1, 0)[:1])), "none is left to learn from"


def test_the_area_under_the_curve_counts_pairs() -> None:
    assert telling.area_under_curve(np.array([0.1, 0.4, 0.4, 0.9]), np.array([0.0, 1, 0, 1])) == (1 + 0.5 + 1 + 1) / 4


# --- motion ----------------------------------------------------------------------------------------------------------


def test_poses_are_60_a_second_whatever_the_takes_have(body: Body) -> None:
    made = [
        poses_of(body, core.Clip(body.skeleton, "", rate, *walking_arrays(turn=0.8, rate=rate))) for rate in (30, 120)
    ]
    assert [len(each.raw) for each in made] == [180, 180]
    np.testing.assert_allclose(made[0].raw, made[1].raw, atol=0.01)  # m: velocities at its ends are not the same
    np.testing.assert_allclose(made[0].turns[:, body.hips], 0.8, rtol=0.01)
    assert np.ptp(heading(body, made[0].heads)) == pytest.approx(0.8 * 179 / 60, rel=0.02)


def test_a_bone_that_turns_faster_than_ever_in_the_takes_is_a_whip(body: Body) -> None:
    """Two seconds in which one bone turns by 40 degrees in a tenth of a second, twice."""
    still = np.tile([1.0, 0, 0, 0], (120, len(body.bones), 1))
    angle = np.radians(40) * (np.clip((np.arange(120) - 30) / 6, 0, 1) + np.clip((np.arange(120) - 80) / 6, 0, 1))
    still[:, body.head] = np.stack([np.cos(angle / 2), 0 * angle, 0 * angle, np.sin(angle / 2)], 1)
    turns = poses.turn_rates(still)
    assert turns[:, body.head].max() == pytest.approx(np.radians(400))
    shown = Poses(standing(body, 120), standing(body, 120), turns)
    minutes = len(turns) / RATE / 60
    known = np.full(len(body.bones), np.radians(400 / 1.24))
    assert motion.whips([shown], known) == 0
    assert motion.whips([shown], known / 1.02) == pytest.approx(2 / minutes)
    assert motion.fastest_turns([shown])[body.head] == pytest.approx(np.radians(400))


def steps_of(body: Body, lengths: tuple[int, int], floor: float) -> Array:
    """[F,B,3]: at 1 m/s, each foot in turn on the floor for as many frames as told, and up in the air in the other's
    time."""
    down = np.zeros((720, 2), bool)
    frame = 0
    while frame < len(down):
        for foot, length in enumerate(lengths):
            down[frame : frame + length, foot] = True
            frame += length
    places = standing(body, len(down))
    places[:, :, 1] += (np.arange(len(down)) / RATE)[:, None]
    for foot, ball in enumerate(body.balls):
        begun = np.maximum.accumulate(np.where(np.diff(down[:, foot], prepend=False), np.arange(len(down)), 0))
        places[:, ball, 1] = np.where(down[:, foot], begun / RATE, np.arange(len(down)) / RATE)
        places[:, ball, 2] = floor + np.where(down[:, foot], 0, 0.2)
    return places


def test_feet_that_step_unevenly_are_seen_to(body: Body) -> None:
    floor = 0.03
    for lengths, uneven in (((30, 30), 1.0), ((40, 20), 2.0)):
        places = steps_of(body, lengths, floor)
        shown = Poses(places, places, np.zeros((718, len(body.bones))))
        seen = motion.seen_in(body, [shown], [[(0, 720)]], floor)
        assert seen["left_right"] == pytest.approx(uneven, rel=0.05)
        assert seen["stances"] == pytest.approx(2, rel=0.05) and seen["steps"] == pytest.approx(2, rel=0.1)
        assert seen["ball_under"] == pytest.approx(0, abs=1e-6) and seen["ball_travel"] == pytest.approx(0, abs=1e-6)
        assert seen["ripple"] == pytest.approx(0, abs=1e-6) and seen["sway"] == pytest.approx(0, abs=1e-6)
    assert motion.floor_of(body, [shown]) == pytest.approx(floor)


def test_a_ball_that_sinks_and_a_head_that_nods_are_measured(body: Body) -> None:
    time = np.arange(600) / RATE
    places = standing(body, 600)
    floor = float(places[0, body.balls, 2].mean())
    places[:, body.balls, 2] -= 0.01 * (1 - np.cos(2 * np.pi * time))[:, None]
    places[:, body.head, 2] += 0.02 * np.sin(2 * np.pi * time)
    shown = Poses(places, places, np.zeros((598, len(body.bones))))
    seen = motion.seen_in(body, [shown], [[(60, 540)]], floor)
    assert seen["ball_under"] == pytest.approx(-20, abs=0.1) and seen["ball_travel"] == pytest.approx(20, abs=0.1)
    assert seen["head_jerk"] == pytest.approx(0.02 * (2 * np.pi) ** 3 / np.sqrt(2), rel=0.01)
    assert seen["hands_jerk"] == pytest.approx(0, abs=1e-6) and seen["steps"] == 0


# --- takes beside takes ----------------------------------------------------------------------------------------------


def test_half_of_the_takes_are_seen_and_the_others_asked_for(likeness: Likeness, clips: list[core.Clip]) -> None:
    assert len(likeness.seen.clips) == len(clips) // 2
    space = core.ControlSpace()
    traces = likeness.traces(space)
    assert sum(map(len, traces)) == 2 * 4 * 30, "four takes of 3 s and their mirror images"
    unseen = {clip.name for clip in clips} - {clip.name for clip in likeness.seen.clips}
    speeds = {"gait 0": 0, "gait 4": 3, "gait 7": 0}
    expected = sorted(2 * [speeds.get(name, 1.2) for name in unseen])
    found = sorted(float(np.median(np.linalg.norm(trace[:30, :2], axis=1))) for trace in traces)
    np.testing.assert_allclose(found, expected, atol=0.05)


def test_unseen_takes_are_as_like_the_unseen_takes_as_can_be(likeness: Likeness, skeleton: core.Skeleton) -> None:
    """Takes in place of what a player shows, as many frames as it would."""
    unseen = [each.raw for each in likeness._unseen.poses]
    names = {clip.name for clip in likeness.seen.clips}
    takes = core.on_one_floor(skeleton, walking_clips(skeleton))
    others = [clip for clip in takes if clip.name not in names]
    clips = [*others, *core.mirrored(skeleton, others)]
    assert len(unseen) == len(clips) == len(likeness.traces(core.ControlSpace()))
    found = likeness.of(clips)
    assert found["frechet"] == pytest.approx(0, abs=1e-6) and found["nearest"] == pytest.approx(1)
    assert found["head_jerk"] == pytest.approx(1) and found["whips"] == 0
    assert all(found[name] == likeness.takes[name] for name in ("left_right", "ball_under", "ball_travel"))
    other = likeness.of([core.Clip(skeleton, "", 30, *walking_arrays(1.2, 0, 3.0)) for _ in clips])
    assert (other["frechet"] or 0) > 0.01 and (other["nearest"] or 0) > 1


def test_takes_that_were_captured_lower_stand_on_the_others_floor(skeleton: core.Skeleton) -> None:
    takes = walking_clips(skeleton)
    down = np.array([0, 0, 0.03])
    lower = core.Clip(skeleton, "lower", takes[1].rate, takes[1].root_positions - down, takes[1].rotations)
    level, found = (core.on_one_floor(skeleton, [*takes, extra])[-1] for extra in (takes[1], lower))
    np.testing.assert_allclose(found.root_positions, level.root_positions, atol=1e-3)


def test_a_stitch_stays_where_the_fragment_goes_on_in_its_take(character: core.Character) -> None:
    played = core.Player(character, 1).run(np.tile([0, 1.2, 0, 0], (100, 1)), RATE)
    new = np.flatnonzero(np.diff(played.entered)) + 1
    clip, origin = character.fragment_clips, character.fragment_origins
    stay = [
        clip[a] == clip[b]
        and origin[a] == origin[b]
        and abs(character.fragment_ranges[b, 0] - character.fragment_ranges[a, 1]) < 0.06
        for a, b in zip(played.fragments[new - 1], played.fragments[new])
    ]
    assert stays(character, [played, played]) == pytest.approx(np.mean(stay))


def test_what_cannot_be_compared_is_refused(skeleton: core.Skeleton, clips: list[core.Clip]) -> None:
    with pytest.raises(ValueError, match="two halves of takes that are longer than 2"):
        Likeness(Recordings(skeleton, clips[:1]))
    headless = make_skeleton(names=["hips", "spine", "top", *(f"bone {i}" for i in range(6))])
    with pytest.raises(ValueError, match="the takes' skeleton has no "):
        body_of(headless)
