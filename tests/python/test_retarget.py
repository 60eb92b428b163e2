# SPDX-License-Identifier: MIT
"""Clips brought onto other bodies: what must not matter does not, and feet and knees keep their manners."""

from __future__ import annotations

from typing import NamedTuple

import fragmotion_core as core
import numpy as np
import pytest
from bodies import (
    FAMILIES,
    Builder,
    about,
    angles,
    humanoid,
    inverse,
    map_of,
    posed,
    random_rolls,
    remade,
    rest_rotations,
    times,
    turned,
)
from conftest import BANDAI, CMU, Array, make_skeleton, walking_clips
from sample_motions import write_sample

MILLIMETRE = 1e-3


class Source(NamedTuple):
    """A body and clips of it."""

    body: core.Body
    clips: list[core.Clip]


def source_of(takes: list[core.Take]) -> Source:
    skeleton = takes[0].skeleton
    clips = [core.Clip.from_take(take, skeleton) for take in takes]
    return Source(core.Body(skeleton, clips), clips)


@pytest.fixture(scope="module")
def bandai_body() -> Source:
    """Walks, a run, a dash and a curve; at rest this skeleton's bones all lie in one line."""
    names = ["1_walk_normal_001", "1_run_active_001", "1_dash_active_001", "1_walk-left_normal_001"]
    files = [BANDAI / f"dataset-{name}.bvh" for name in names]
    if not all(path.exists() for path in files):
        pytest.skip("no motion capture beside the project")
    return source_of([core.read_bvh(path) for path in files])


@pytest.fixture(scope="module")
def cmu_body() -> Source:
    """Two walks, a run and a jump."""
    files = sorted(CMU.glob("02_*.amc"))
    if not files:
        pytest.skip("no motion capture beside the project")
    return source_of([core.read_asf_amc(CMU / "02.asf", path) for path in files])


@pytest.fixture(scope="module")
def sample_body(tmp_path_factory: pytest.TempPathFactory) -> Source:
    """The sample's, which is there on every checkout."""
    return source_of([core.read_bvh(path) for path in write_sample(tmp_path_factory.mktemp("sample"))])


@pytest.fixture(scope="module", params=["sample", "bandai", "cmu"])
def source(request: pytest.FixtureRequest) -> Source:
    """Each of the three."""
    found: Source = request.getfixturevalue(f"{request.param}_body")
    return found


@pytest.fixture(scope="module", params=["bandai", "cmu"])
def actor(request: pytest.FixtureRequest) -> Source:
    """Each of the two that were captured, whose feet slide a little."""
    found: Source = request.getfixturevalue(f"{request.param}_body")
    return found


def joint_error(source: Source, target: core.Body, scale: float = 1.0) -> float:
    """How far joints are at most from the source's, in its metres."""
    hips = source.body.skeleton.names.index(source.body.roles["hips"])
    parents = source.body.skeleton.parents
    below = [hips]
    for bone, parent in enumerate(parents):
        if parent in below:
            below.append(bone)
    error = 0.0
    for clip, result in zip(source.clips, core.Retarget(source.body, target).apply_all(source.clips)):
        ours, _ = clip.world_transforms(source.body.skeleton)
        theirs, _ = result.clip.world_transforms(target.skeleton)
        error = max(error, float(np.linalg.norm(ours - theirs / scale, axis=2)[:, below].max()))
    return error


def test_onto_itself_nothing_moves(source: Source) -> None:
    assert joint_error(source, source.body) < 0.1 * MILLIMETRE
    assert joint_error(source, core.Body(source.body.skeleton)) < 0.1 * MILLIMETRE


def test_onto_the_same_body_in_other_bones_nothing_moves(source: Source) -> None:
    skeleton, roles = source.body.skeleton, source.body.roles

    def renamed(name: str) -> str:
        return f"Bone.{skeleton.names.index(name):03}"

    arms_down = {roles["left_upper_arm"]: about([0, 1, 0], -75), roles["right_upper_arm"]: about([0, 1, 0], 75)}
    a_pose = {roles["left_upper_arm"]: about([0, 1, 0], -40), roles["right_upper_arm"]: about([0, 1, 0], 40)}
    hanging = remade(skeleton, posed(skeleton, source.body.reference, arms_down), rolls=random_rolls(skeleton))
    bodies = {
        "rolls": core.Body(remade(skeleton, rolls=random_rolls(skeleton)), roles=roles),
        "names": core.Body(remade(skeleton, rename=renamed), roles=map_of(source.body, renamed)),
        "T": core.Body(remade(skeleton, source.body.reference), roles=roles),
        "A": core.Body(remade(skeleton, posed(skeleton, source.body.reference, a_pose)), roles=roles),
        "arms down, rolls": core.Body(hanging, roles=roles),
    }
    for name, body in bodies.items():
        assert joint_error(source, body) < MILLIMETRE, name
    assert joint_error(source, core.Body(remade(skeleton, size=100), roles=roles), 100) < MILLIMETRE


def joints(body: core.Body, clip: core.Clip, roles: list[str]) -> Array:
    """[F,R,4]: how the bones of roles are turned against the next ones with a role above them."""
    skeleton = body.skeleton
    _, world = clip.world_transforms(skeleton)
    role_of = {skeleton.names.index(bone): role for role, bone in body.roles.items() if role != "root"}
    found = {}
    for bone, role in role_of.items():
        above = skeleton.parents[bone]
        while above >= 0 and above not in role_of:
            above = skeleton.parents[above]
        found[role] = world[:, bone] if above < 0 else times(inverse(world[:, above]), world[:, bone])
    return np.stack([found[role] for role in roles], 1)


def there_and_back(source: Source, other: core.Body) -> float:
    """Mean angle of the joints that both bodies have, after going to the other body and back, degrees."""
    there, back = core.Retarget(source.body, other), core.Retarget(other, source.body)
    again = back.apply_all([result.clip for result in there.apply_all(source.clips)])
    roles = [role for role in source.body.roles if role in other.roles and role != "root"]
    errors = [
        angles(joints(source.body, clip, roles), joints(source.body, result.clip, roles))
        for clip, result in zip(source.clips, again)
    ]
    return float(np.concatenate(errors).mean())


@pytest.mark.parametrize("family", FAMILIES)
def test_there_and_back_again(source: Source, family: str) -> None:
    for arms in (0.0, 45.0, 80.0):
        assert there_and_back(source, core.Body(humanoid(family, arms=arms))) < 2, arms


def test_there_and_back_again_between_two_actors(bandai_body: Source, cmu_body: Source) -> None:
    assert there_and_back(bandai_body, cmu_body.body) < 2
    assert there_and_back(cmu_body, bandai_body.body) < 2


PROPORTIONS = [
    {"size": 0.6},
    {"size": 1.6},
    {"leg": 0.75},
    {"leg": 1.3},
    {"thigh": 0.8},
    {"thigh": 1.2},
    {"wide": 1.8},
    {"wide": 0.5},
    {"size": 0.6, "leg": 1.2, "thigh": 1.15, "wide": 1.5},
]


@pytest.mark.parametrize("proportions", PROPORTIONS, ids=str)
def test_feet_and_knees_keep_their_manners_on_other_proportions(actor: Source, proportions: dict[str, float]) -> None:
    target = core.Body(humanoid("mixamo", **proportions))
    for result in core.Retarget(actor.body, target).apply_all(actor.clips):
        assert result.foot_skate_ratio <= 1.1, result.clip.name
        assert result.contact_error <= 0.01, result.clip.name
        assert result.knee_beyond <= np.radians(1e-3), result.clip.name


def test_toes_stay_over_the_ground(source: Source) -> None:
    """Whatever the source's do: at rest their tips are 2 cm over it."""
    target = core.Body(humanoid("rigify"))
    skeleton = target.skeleton
    for result in core.Retarget(source.body, target).apply_all(source.clips):
        heads, rotations = result.clip.world_transforms(skeleton)
        for role in ("left_toe", "right_toe"):
            toe = skeleton.names.index(target.roles[role])
            tips = heads[:, toe] + turned(rotations[:, toe], skeleton.tips[toe])
            assert tips[:, 2].min() > 0.01, result.clip.name


@pytest.mark.parametrize("arms", [0.0, 45.0, 85.0])
def test_limbs_point_where_the_sources_do_however_arms_rest(source: Source, arms: float) -> None:
    """Upper arms, forearms and the directions of hands, told by places alone."""
    target = core.Body(humanoid("unreal", arms=arms))
    for clip, result in zip(source.clips, core.Retarget(source.body, target).apply_all(source.clips)):
        for upper, lower in (("left_upper_arm", "left_lower_arm"), ("right_lower_arm", "right_hand")):
            directions = []
            for body, moved in ((source.body, clip), (target, result.clip)):
                heads, _ = moved.world_transforms(body.skeleton)
                ends = [body.skeleton.names.index(body.roles[role]) for role in (upper, lower)]
                along = heads[:, ends[1]] - heads[:, ends[0]]
                directions.append(along / np.linalg.norm(along, axis=1, keepdims=True))
            assert (directions[0] * directions[1]).sum(1).min() > np.cos(np.radians(0.1)), upper


def test_all_takes_go_onto_another_skeleton_and_any_number_of_threads_gives_the_same(bandai_body: Source) -> None:
    takes = [core.read_bvh(path) for path in sorted(BANDAI.glob("dataset-2*.bvh"))[:10]]
    clips = [core.Clip.from_take(take, bandai_body.body.skeleton) for take in takes]
    retarget = core.Retarget(bandai_body.body, core.Body(humanoid("rigify")))
    for one, two in zip(retarget.apply_all(clips, threads=1), retarget.apply_all(clips, threads=2)):
        assert np.array_equal(one.clip.rotations, two.clip.rotations)
        assert np.array_equal(one.clip.root_positions, two.clip.root_positions)
        assert one.foot_skate_ratio <= 1.1


def test_a_character_of_two_sources_is_built(bandai_body: Source, cmu_body: Source) -> None:
    target = core.Body(humanoid("mixamo"))
    clips = [
        result.clip
        for source in (bandai_body, cmu_body)
        for result in core.Retarget(source.body, target).apply_all(source.clips)
    ]
    options = core.BuildOptions()
    options.classes, options.policies = 20, ["greedy"]
    character = core.build(target.skeleton, clips, [core.simulate_trace("walker", 20, 1)], options)
    assert {clip.name for clip in clips} <= set(character.clip_names)


def test_what_is_missing_is_named() -> None:
    skeleton = make_skeleton()
    with pytest.raises(ValueError, match="left_shin, right_shin"):
        core.Body(skeleton)
    with pytest.raises(ValueError, match="hips"):
        core.Body(humanoid("mixamo"), roles={"left_thigh": "LeftUpLeg"})
    with pytest.raises(ValueError, match="number of bones"):
        core.Body(humanoid("mixamo"), walking_clips(skeleton))


def test_what_is_told_of_one_bone_leaves_the_others_to_motion(bandai_body: Source) -> None:
    """Of a skeleton whose names say nothing."""
    old = bandai_body.body.skeleton
    names = {name: f"{index}" for index, name in enumerate(old.names)}
    skeleton = remade(old, rename=names.__getitem__)
    clips = [
        core.Clip(skeleton, clip.name, clip.rate, clip.root_positions, clip.rotations) for clip in bandai_body.clips
    ]
    found = core.Body(skeleton, clips).roles
    resting = {role: bone for role, (bone, _) in skeleton.role_map().items()}
    assert len(found) > len(resting), "motion has told nothing"
    assert core.Body(skeleton, clips, told={"hips": found["hips"]}).roles == found
    told = core.Body(skeleton, clips, told={"left_hand": found["left_lower_arm"]}).roles
    kept = {role: bone for role, bone in found.items() if role != "left_lower_arm"}
    assert told == {**kept, "left_hand": found["left_lower_arm"]}


def test_a_rest_pose_that_tells_nothing_wants_clips(bandai_body: Source) -> None:
    unknown = core.Body(bandai_body.body.skeleton)
    assert not unknown.stands
    with pytest.raises(ValueError, match="give clips"):
        core.Retarget(unknown, core.Body(humanoid("mixamo")))


def test_walks_and_runs_tell_the_same_of_how_a_body_stands(bandai_body: Source) -> None:
    """Though a runner leans, bends the elbows and stands on the balls of the feet."""
    skeleton = bandai_body.body.skeleton
    walker, runner, dasher = (core.Body(skeleton, bandai_body.clips[i : i + 1]) for i in range(3))
    for other, most in ((runner, 13), (dasher, 13)):
        for role in (
            "hips",
            "spine_1",
            "head",
            "left_upper_arm",
            "right_thigh",
            "left_shin",
            "left_foot",
            "right_foot",
        ):
            bone = skeleton.names.index(walker.roles[role])
            assert angles(walker.reference[bone], other.reference[bone]) < most, role


def test_a_body_without_arms_is_driven(source: Source) -> None:
    skeleton = humanoid("mixamo")
    roles = {role: bone for role, bone in core.Body(skeleton).roles.items() if "leg" in bone.lower() or role == "hips"}
    roles |= {role: bone for role, bone in core.Body(skeleton).roles.items() if role.endswith(("foot", "toe"))}
    target = core.Body(skeleton, roles=roles)
    assert target.roles == roles
    for result in core.Retarget(source.body, target).apply_all(source.clips):
        assert result.foot_skate_ratio <= 1.1


def test_feet_without_toes_stand_whatever_end_an_importer_gave_them(source: Source) -> None:
    skeleton = humanoid("mixamo")
    roles = {role: bone for role, bone in core.Body(skeleton).roles.items() if "toe" not in role}
    world, tips = rest_rotations(skeleton), np.array(skeleton.tips)
    for side in ("left", "right"):
        foot = skeleton.names.index(roles[f"{side}_foot"])
        tips[foot] = turned(inverse(world[foot]), np.array([0, 0, 0.4]))
    up = core.Skeleton(skeleton.names, skeleton.parents, skeleton.rest_rotations, skeleton.offsets, tips)
    for result in core.Retarget(source.body, core.Body(up, roles=roles)).apply_all(source.clips):
        assert result.contact_error <= 0.01, result.clip.name
        assert result.foot_skate_ratio <= 1.1, result.clip.name


def with_tails_aside(skeleton: core.Skeleton, roles: dict[str, str]) -> core.Skeleton:
    """With hands whose bones end at a right angle to them, as importers make them that know no bones' ends."""
    world, tips = rest_rotations(skeleton), np.array(skeleton.tips)
    for side in ("left", "right"):
        hand = skeleton.names.index(roles[f"{side}_hand"])
        tips[hand] = turned(inverse(world[hand]), np.array([0, 0.02, -0.1]))
    return core.Skeleton(skeleton.names, skeleton.parents, skeleton.rest_rotations, skeleton.offsets, tips)


@pytest.mark.parametrize("fingers", [True, False])
def test_hands_point_where_the_actors_do_whatever_end_an_importer_gave_them(source: Source, fingers: bool) -> None:
    """By their fingers, and where they have none straight on from the lower arm, from which these hands rest 2 degrees
    away."""
    bare = humanoid("mixamo", fingers=fingers)
    aside = with_tails_aside(bare, core.Body(bare).roles)
    for clip in source.clips:
        true, other = (core.Retarget(source.body, core.Body(each)).apply(clip) for each in (bare, aside))
        assert angles(true.clip.rotations, other.clip.rotations).max() < (1e-3 if fingers else 3), clip.name
        for side in ("left", "right"):
            assert other.limb_angles[f"{side}_hand"] < np.radians(20), clip.name


def skin_of_hands(skeleton: core.Skeleton, roles: dict[str, str], ways: dict[str, Array]) -> core.Skin:
    """Of a part of a sphere about each hand, half as wide as its way is long, from the wrist on."""
    heads, skin = skeleton.rest_heads(), core.Skin(skeleton)
    ball = np.random.default_rng(1).normal(size=(200, 3))
    ball /= 2 * np.linalg.norm(ball, axis=1, keepdims=True)
    for side, way in ways.items():
        hand = roles[f"{side}_hand"]
        points = heads[skeleton.names.index(hand)] + way / 2 + np.linalg.norm(way) * ball
        rows = np.column_stack([np.arange(200), np.zeros(200), np.ones(200)])
        skin.add(np.eye(4), points, [hand], rows)
    return skin


def test_a_hand_without_fingers_points_where_its_skin_does() -> None:
    """Against its bone's end, an importer's, and also where it is bent at rest."""
    bare = humanoid("mixamo", fingers=False)
    roles = core.Body(bare).roles
    aside = with_tails_aside(bare, roles)
    ways = {"left": np.array([-0.1, 0.1, 0]), "right": np.array([0.15, 0, 0])}
    skin = skin_of_hands(aside, roles, ways)
    body = core.Body(aside, skin=skin)
    assert [core.role_doubts(aside, skin=each) != [] for each in (None, skin)] == [True, False]
    for side, way in ways.items():
        hand = aside.names.index(roles[f"{side}_hand"])
        tip = turned(rest_rotations(aside)[hand], body.skeleton.tips[hand])
        assert np.linalg.norm(tip) == pytest.approx(np.linalg.norm(way), rel=0.05)
        assert np.dot(tip, way) > 0.99 * np.linalg.norm(tip) * np.linalg.norm(way)
        pointed = turned(body.reference[hand], body.skeleton.tips[hand])
        np.testing.assert_allclose(pointed / np.linalg.norm(pointed), np.sign(way * [1, 0, 0]), atol=1e-6)


def test_a_hand_with_fingers_points_where_they_do_whatever_its_skin() -> None:
    whole = humanoid("mixamo")
    roles = core.Body(whole).roles
    skin = skin_of_hands(whole, roles, {"left": np.array([0, 0, 0.2]), "right": np.array([0, 0, 0.2])})
    np.testing.assert_array_equal(core.Body(whole, skin=skin).reference, core.Body(whole).reference)


def test_a_skin_of_another_skeleton_is_refused() -> None:
    skin = core.Skin(humanoid("mixamo"))
    with pytest.raises(ValueError, match="of another skeleton"):
        core.Body(humanoid("unreal"), skin=skin)
    for row, words in (([2, 0, 1], "no such vertex"), ([0, 1.5, 1], "no such group"), ([0, 0, 2], "from 0 to 1")):
        with pytest.raises(ValueError, match=words):
            skin.add(np.eye(4), np.zeros((2, 3)), ["Hips", "Spine"], [row])


def test_a_wrist_that_is_bent_where_the_actors_is_not_is_told(bandai_body: Source) -> None:
    """Of a body whose hands rest at a right angle to the arms, and so cannot be compared."""
    skeleton = humanoid("mixamo")
    roles = core.Body(skeleton).roles
    world = posed(skeleton, rest_rotations(skeleton), {roles["left_hand"]: about([0, 1, 0], 90)})
    result = core.Retarget(bandai_body.body, core.Body(remade(skeleton, world))).apply(bandai_body.clips[0])
    assert result.limb_angles["left_hand"] > np.radians(60)
    for role, angle in result.limb_angles.items():
        assert role == "left_hand" or angle < np.radians(20), role


def test_a_usual_body_leaves_no_doubt() -> None:
    for family in FAMILIES:
        for fingers in (True, False):
            assert core.role_doubts(humanoid(family, fingers=fingers)) == []


def test_what_a_person_should_look_at_is_named() -> None:
    bare = humanoid("mixamo", fingers=False)
    doubts = core.role_doubts(with_tails_aside(bare, core.Body(bare).roles))
    assert [(role, bone) for role, bone, _ in doubts] == [("left_hand", "LeftHand"), ("right_hand", "RightHand")]
    assert "wrist" in doubts[0][2]


def test_hips_between_the_feet_and_legs_that_end_in_the_air_are_doubtful() -> None:
    builder = Builder()
    builder.add_chain(["Root", "Pole"], "", [[0, 0, 0], [0, 0, -3], [0, 0, -3.1]])
    builder.add_chain(["Spine", "Head"], "Root", [[0, 0, 1], [0, 0, 1.6], [0, 0, 1.8]])
    for side, x in (("Left", 0.1), ("Right", -0.1)):
        places = [[x, 0, 1.0], [x, -0.02, 0.5], [x, 0, 0.1], [x, -0.1, 0.02]]
        builder.add_chain([f"{side}UpLeg", f"{side}Leg", f"{side}Foot"], "Root", places)
    told = {role: text for role, _, text in core.role_doubts(builder.finished())}
    assert "between the feet" in told["hips"]
    assert "does not end on the ground" in told["left_foot"] and "right_foot" in told
