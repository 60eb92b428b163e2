# SPDX-License-Identifier: MIT
"""The peer: that its parts are what they should be, by brute force and numerical integration, and that it plays."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import fragmotion_core as core
import numpy as np
import pytest
from conftest import Array, make_skeleton
from fragmotion_command.evaluate import rotations as q
from sample_motions import write_sample
from scipy.integrate import solve_ivp

from tools.measuring.peers.kinematics.bodies import RATE, Body, Motion, body_of, motion_of, world
from tools.measuring.peers.kinematics.legs import knee_hinges, set_balls
from tools.measuring.peers.kinematics.springs import chased, faded, stiffness
from tools.measuring.peers.motion_matching import gaps, library
from tools.measuring.peers.motion_matching.constants import TUNED, Constants, load, save
from tools.measuring.peers.motion_matching.feet import FootLock
from tools.measuring.peers.motion_matching.matcher import Matcher, Material, material_of
from tools.measuring.peers.motion_matching.search import Search
from tools.measuring.peers.motion_matching.showing import PoseTrack, RootTrack
from tools.shell import Failure

WALK = 1.2  # m/s, the sample's


@pytest.fixture(scope="module")
def clips(tmp_path_factory: pytest.TempPathFactory) -> list[core.Clip]:
    return [core.Clip.from_take(core.read_bvh(path)) for path in write_sample(tmp_path_factory.mktemp("sample"))]


@pytest.fixture(scope="module")
def body(tmp_path_factory: pytest.TempPathFactory) -> Body:
    return body_of(core.read_bvh(write_sample(tmp_path_factory.mktemp("rig"))[0]).skeleton)


@pytest.fixture(scope="module")
def motions(body: Body, clips: list[core.Clip]) -> list[Motion]:
    return [motion_of(body, clip) for clip in clips]


@pytest.fixture(scope="module")
def material(body: Body, motions: list[Motion]) -> Material:
    return material_of(body, motions)


@pytest.fixture(scope="module")
def matcher(material: Material) -> Matcher:
    return Matcher(material)


def held(velocity: tuple[float, float], turn: float = 0.0, seconds: float = 6.0) -> Array:
    return np.tile([*velocity, turn], (1, round(seconds * RATE) + 1, 1))


# --- bodies ----------------------------------------------------------------------------------------------------------


def test_a_motion_is_its_clip(body: Body, clips: list[core.Clip], motions: list[Motion]) -> None:
    clip, motion = clips[0], motions[0]
    heads = world(body, motion.root, motion.rotations)[0]
    expected = clip.world_transforms(body.skeleton)[0][:, body.bones]
    np.testing.assert_allclose(heads[::2], expected, atol=1e-6)  # 60 frames a second, of 30
    np.testing.assert_allclose(body.clip(motion).rotations[::2], clip.rotations, atol=1e-6)


def test_mirror_images_are_reflected_and_back(body: Body, clips: list[core.Clip]) -> None:
    images = core.mirrored(body.skeleton, clips)
    names = body.skeleton.names
    other = [
        names.index(name.translate(str.maketrans("LR", "RL")) if name[-2:] in (".L", ".R") else name) for name in names
    ]
    heads, mirrored = (clip.world_transforms(body.skeleton)[0] for clip in (clips[2], images[2]))
    np.testing.assert_allclose(mirrored, heads[:, other] * [-1, 1, 1], atol=1e-6)
    again = core.mirrored(body.skeleton, images)[2].world_transforms(body.skeleton)[0]
    np.testing.assert_allclose(again, heads, atol=1e-6)
    assert core.mirrored(body.skeleton, []) == []


def test_a_skeleton_without_knees_is_refused() -> None:
    with pytest.raises(Failure, match="left toe"):
        body_of(make_skeleton())


# --- springs ---------------------------------------------------------------------------------------------------------


def test_an_offset_fades_as_a_critically_damped_spring() -> None:
    y = stiffness(0.1)
    solved = solve_ivp(lambda _, s: [s[1], -2 * y * s[1] - y * y * s[0]], (0, 0.3), [0.5, -2.0], rtol=1e-10, atol=1e-12)
    offset, velocity = faded(np.array(0.5), np.array(-2.0), 0.1, 0.3)
    assert [float(offset), float(velocity)] == pytest.approx(solved.y[:, -1], abs=1e-7)
    assert float(faded(np.array(1.0), np.array(0.0), 0.1, 0.1)[0]) == pytest.approx(0.6, abs=0.05)


def test_a_velocity_chases_its_goal_as_a_critically_damped_spring() -> None:
    y, goal = stiffness(0.27), 2.0
    solved = solve_ivp(
        lambda _, s: [s[1], s[2], -2 * y * s[2] - y * y * (s[1] - goal)], (0, 0.5), [1.0, -0.5, 3.0], rtol=1e-10
    )
    found = chased(np.array(1.0), np.array(-0.5), np.array(3.0), np.array(goal), 0.27, 0.5)
    assert [float(value) for value in found] == pytest.approx(solved.y[:, -1], abs=1e-6)


# --- features and search ---------------------------------------------------------------------------------------------


def test_features_are_what_the_root_sees(body: Body, motions: list[Motion], material: Material) -> None:
    motion, frames = motions[0], material.library.frames
    heads, f = world(body, motion.root, motion.rotations)[0], 70
    cosine, sine = np.cos(frames.heading[f]), np.sin(frames.heading[f])

    def seen(x: float, y: float) -> list[float]:
        return [cosine * x + sine * y, cosine * y - sine * x]

    expected = []
    for foot in body.feet:
        expected += [*seen(*(heads[f, foot, :2] - frames.place[f])), heads[f, foot, 2]]
    for bone in (*body.feet, 0):
        velocity = (heads[f + 1, bone] - heads[f - 1, bone]) * RATE / 2
        expected += [*seen(*velocity[:2]), velocity[2]]
    for ahead in (20, 40, 60):
        expected += seen(*(frames.place[f + ahead] - frames.place[f]))
    for ahead in (20, 40, 60):
        turn = frames.heading[f + ahead] - frames.heading[f]
        expected += [-np.sin(turn), np.cos(turn)]
    np.testing.assert_allclose(frames.stopping[f], expected, atol=1e-12)
    np.testing.assert_allclose(frames.going_on[f], expected, atol=1e-12)


def test_a_path_that_goes_on_keeps_its_last_speed_and_turn() -> None:
    turn, count = 0.02, 40
    heading = turn * np.arange(count + 60)
    steps = q.turned(np.tile([0.0, 0.01], (count + 59, 1)), heading[:-1] + turn / 2)
    place = np.concatenate((np.zeros((1, 2)), np.cumsum(steps, 0)))
    short = library.Root(place[:count], heading[:count])
    whole = library._path_features(library.Root(place, heading), goes_on=False)
    np.testing.assert_allclose(library._path_features(short, goes_on=True)[-1], whole[count - 1], atol=8e-3)
    assert np.allclose(library._path_features(short, goes_on=False)[-1], [0] * 6 + [0, 1] * 3)


@pytest.mark.parametrize("transition_cost", [0.0, 3.0])
def test_the_search_finds_the_nearest_frame(matcher: Matcher, transition_cost: float) -> None:
    database, random, ignored = matcher.database, np.random.default_rng(3), 20
    features = database.features.astype(float)
    search, stayed = Search(database, ignored, transition_cost), 0
    for i in range(300):
        playing, ends = int(random.integers(len(features))), bool(i % 3 == 0)
        query = features[playing] + random.normal(0, 0.1 + i % 4, 27)
        costs = ((features - query) ** 2).sum(1)
        total = costs + transition_cost
        near = np.abs(np.arange(len(total)) - playing) < ignored
        total[~database.allowed | near] = np.inf
        if not ends:
            total[playing] = costs[playing]
        found = search.best(query, playing, ends)
        stayed += found == playing
        assert total[found] == pytest.approx(total.min(), rel=1e-9)  # not the frame itself: cycles of a gait are alike
    assert 0 < stayed < 300


def test_the_last_frames_of_a_take_are_not_gone_to(matcher: Matcher) -> None:
    steps = matcher.material.library
    for frame in np.flatnonzero(matcher.database.allowed):
        assert frame + matcher.constants.ends <= steps.last[frame]


# --- what is shown ---------------------------------------------------------------------------------------------------


def test_a_transition_leaves_pose_and_velocity_as_they_are(material: Material) -> None:
    frames, constants = material.library.frames, Constants()
    before, after, who = np.array([100]), np.array([400]), np.array([0])
    root, pose = RootTrack(frames, before, constants), PoseTrack(frames, 1, constants)
    hips, rotations = pose.shown(before, root)
    velocity, turning = root.velocity.copy(), root.turning.copy()
    root.go_to(who, after)
    pose.go_to(who, before, after)
    root.show(after)
    new_hips, new_rotations = pose.shown(after, root)
    np.testing.assert_allclose(new_hips, hips, atol=1e-12)
    np.testing.assert_allclose(np.abs(np.sum(new_rotations * rotations, -1)), 1, atol=1e-12)
    np.testing.assert_allclose(root.velocity, velocity, atol=1e-12)
    np.testing.assert_allclose(root.turning, turning, atol=1e-12)


def test_a_played_transition_is_no_jump(body: Body, matcher: Matcher) -> None:
    """Poses go no further from frame to frame where there is a transition than they do elsewhere, by much."""
    controls = np.concatenate(
        [held((0, speed), turn, 2.0) for speed, turn in ((0, 0), (3.3, 0), (1.2, 1.2), (0, 0))], 1
    )
    shown = matcher.play(controls, [matcher.still()])
    heads = world(body, shown.root[0], shown.rotations[0])[0]
    upper = [bone for bone in range(len(body.parents)) if bone not in body.leg_bones[1:]]  # legs are locked, too
    steps = np.linalg.norm(np.diff(heads[:, upper], axis=0), axis=2).max(1)
    entered = np.flatnonzero(np.diff(shown.entered[0]))
    assert len(entered) > 5
    assert steps[entered].max() < 1.3 * np.delete(steps, entered).max()


@pytest.mark.parametrize("goal", [(0.0, WALK), (0.0, 3.3)])
def test_a_held_stick_goes_forward(matcher: Matcher, goal: tuple[float, float]) -> None:
    shown = matcher.play(held(goal), [matcher.still()])
    way = (shown.root[0, -1] - shown.root[0, 180]) / (shown.root.shape[1] - 181) * RATE
    assert way[1] == pytest.approx(goal[1], rel=0.15) and abs(way[0]) < 0.2


def test_characters_that_play_together_play_as_alone(matcher: Matcher) -> None:
    starts = [matcher.still(), matcher.still(0.5)]
    controls = np.concatenate((held((0, WALK), 0.5, 3.0), held((0, 3.3), 0.0, 3.0)))
    together = matcher.play(controls, starts)
    for i, start in enumerate(starts):
        alone = matcher.play(controls[i : i + 1], [start])
        np.testing.assert_allclose(together.root[i], alone.root[0], atol=1e-9)
        np.testing.assert_array_equal(together.frames[i], alone.frames[0])


# --- legs ------------------------------------------------------------------------------------------------------------


def test_legs_reach_and_keep_their_lengths(body: Body, motions: list[Motion]) -> None:
    motion = motions[0]
    heads, oriented = world(body, motion.root, motion.rotations)
    hinges = knee_hinges(body, motions)
    targets = heads[:, body.toes] + np.random.default_rng(2).normal(0, 0.02, (len(heads), 2, 3)) + [0, 0, 0.1]
    moved, turned = world(body, motion.root, set_balls(body, hinges, motion.root, motion.rotations, targets))
    np.testing.assert_allclose(moved[:, body.toes], targets, atol=1e-6)
    np.testing.assert_allclose(np.abs(np.sum(turned[:, body.feet] * oriented[:, body.feet], -1)), 1, atol=1e-9)
    for side, (thigh, shin, foot, _) in enumerate(body.legs):
        bend = np.cross(moved[:, shin] - moved[:, thigh], moved[:, foot] - moved[:, shin])
        assert (np.sum(bend * q.rotate(turned[:, thigh], hinges[side]), -1) > 0).all()


def test_a_locked_foot_stays_and_is_let_go(body: Body, motions: list[Motion], material: Material) -> None:
    root, rotations = motions[0].root[:1], motions[0].rotations[:1]
    lock = FootLock(body, material.hinges, material.floors, 1, dataclasses.replace(Constants(), unlock=0.1))
    touches, balls = np.ones((1, 2), bool), []
    for f in range(60):
        moved = root + np.array([0, 0.003 * f, 0])  # is dragged at 0.18 m/s, and lets go after half a second
        shown = lock.applied(moved, rotations, touches & (f > 0))
        balls.append(world(body, moved, shown)[0][0, body.toes[0], :2])
    ways = np.linalg.norm(np.diff(balls, axis=0), axis=1)
    assert ways[15:25].max() < 0.0015 < 0.003 < ways[35:50].max()
    assert balls[-1][1] - balls[0][1] == pytest.approx(0.003 * 59, abs=0.02)


# --- gaps ------------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def filled(body: Body, clips: list[core.Clip], motions: list[Motion]) -> tuple[core.ControlSpace, list[Motion]]:
    options = core.BuildOptions()
    options.synthesize, options.classes, options.restarts, options.policies = False, 1, 1, ["greedy"]
    character = core.build(body.skeleton, clips, [core.simulate_trace("walker", 5)], options)
    distances = character.coverage_distances
    made = gaps.fill(body, motions, character.space, distances, knee_hinges(body, motions))
    assert len(made) == 1 + sum(distances[i] > 0.3 for i in range(2, 102, 2) if np.any(character.space.points[i, :3]))
    return character.space, made


def test_a_filled_gap_does_what_is_asked(body: Body, filled: tuple[core.ControlSpace, list[Motion]]) -> None:
    space, made = filled
    assert made[0].name == "stands" and np.ptp(made[0].root, axis=0).max() == 0
    assert len(made) > 10
    for motion in made[1:]:
        x, y, turn, _ = space.points[int(motion.name.split()[0])]
        root = library.root_of(body, motion, world(body, motion.root, motion.rotations)[0])
        velocity = q.turned(np.gradient(root.place, axis=0), -root.heading).mean(0) * RATE
        assert velocity == pytest.approx([x, y], abs=0.12 + 0.08 * np.hypot(x, y)), motion.name
        rate = (root.heading[-1] - root.heading[0]) / (len(root.heading) - 1) * RATE
        assert rate == pytest.approx(turn * space.turn_rate, abs=0.12), motion.name


def test_a_filled_matcher_goes_aside(
    body: Body, motions: list[Motion], filled: tuple[core.ControlSpace, list[Motion]]
) -> None:
    matcher = Matcher(material_of(body, motions, filled[1]), load())
    shown = matcher.play(held((WALK, 0.0)), [matcher.still()])
    way = (shown.root[0, -1] - shown.root[0, 180]) / (shown.root.shape[1] - 181) * RATE
    assert way[:2] == pytest.approx([WALK, 0], abs=0.25)


# --- constants -------------------------------------------------------------------------------------------------------


def test_constants_are_saved_and_read(tmp_path: Path) -> None:
    constants = dataclasses.replace(Constants(), blend=0.15, goes_on=True, ends=60)
    save(tmp_path / "constants.json", constants, tries=3, cost=0.9)
    assert load(tmp_path / "constants.json") == constants
    assert load(TUNED) != Constants()


@pytest.mark.parametrize("text", ["{", "{}", '{"constants": {"blnd": 0.1}}', "[]"])
def test_broken_constants_are_refused(tmp_path: Path, text: str) -> None:
    (tmp_path / "constants.json").write_text(text)
    with pytest.raises(Failure, match=r"constants\.json"):
        load(tmp_path / "constants.json")
