# SPDX-License-Identifier: MIT
"""The map from roles to bones, as Python has it."""

from __future__ import annotations

from typing import NamedTuple

import fragmotion_core as core
import numpy as np
import pytest
from bodies import FAMILIES, about, humanoid, posed, remade, rest_rotations, turned
from conftest import BANDAI, NAMES, Array, make_skeleton

ARM = ("Shoulder", "Arm", "ForeArm", "Hand")
NAMELESS = [f"Bone.{number:03}" for number in range(60)]


def renamed(skeleton: core.Skeleton) -> core.Skeleton:
    """The same skeleton with names that say nothing."""
    return core.Skeleton(
        NAMELESS[: len(skeleton.names)], skeleton.parents, skeleton.rest_rotations, skeleton.offsets, skeleton.tips
    )


def test_roles_have_bones_and_confidences() -> None:
    roles = make_skeleton().role_map()
    assert {role: bone for role, (bone, _) in roles.items()} == {
        "hips": "hips",
        "spine_1": "spine",
        "head": "head",
        "left_hand": "hand.L",
        "right_hand": "hand.R",
        "left_thigh": "thigh.L",
        "right_thigh": "thigh.R",
        "left_foot": "foot.L",
        "right_foot": "foot.R",
    }
    assert all(0.5 <= confidence <= 1 for _, confidence in roles.values())


def test_motion_and_shape_tell_most_of_what_names_do_and_nothing_wrong() -> None:
    """The heads of these files are no longer than their necks, and a runner's feet hardly tell the sides."""
    files = sorted(BANDAI.glob("*_001.bvh"))
    if not files:
        pytest.skip("no motion capture beside the project")
    right, roles = 0, 0
    for path in files:
        take = core.read_bvh(path)
        names = take.skeleton.names
        truth = {role: names.index(bone) for role, (bone, _) in take.skeleton.role_map().items()}
        heads, _ = take.world_transforms()
        told = {role: NAMELESS.index(bone) for role, (bone, _) in renamed(take.skeleton).role_map(heads).items()}
        assert {role: truth[role] for role in told} == told, path.name
        right += len(told)
        roles += len(truth)
    assert right >= 0.9 * roles, f"{right} of {roles}"


def test_heads_of_another_shape_are_refused() -> None:
    with pytest.raises(ValueError, match="heads"):
        make_skeleton().role_map(np.zeros((2, len(NAMES) - 1, 3)))
    with pytest.raises(ValueError, match="heads: a place is not finite"):
        make_skeleton().role_map(np.full((1, len(NAMES), 3), np.nan))


class Bones(NamedTuple):
    """A body's bones, where each begins at rest (pose 0) and in a motion [P,3], and their roles."""

    parents: dict[str, str]
    heads: dict[str, Array]
    ends: dict[str, Array]
    roles: dict[str, str]


def strides(skeleton: core.Skeleton, roles: dict[str, str]) -> Array:
    """World heads [P,B,3]: at rest, and in two strides of a walk that faces -y."""
    world, poses = rest_rotations(skeleton), [np.array(skeleton.rest_heads())]
    for phase in np.linspace(0, 4 * np.pi, 12):
        turns = {
            roles["spine_1"]: about([0, 0, 1], 8 * np.sin(phase)),
            roles["head"]: about([1, 0, 0], 5 * np.sin(phase)),
        }
        for side, sign in (("left", 1), ("right", -1)):
            swing = sign * np.sin(phase)
            turns[roles[f"{side}_thigh"]] = about([1, 0, 0], -25 * swing)
            turns[roles[f"{side}_shin"]] = about([1, 0, 0], 25 - 20 * sign * np.cos(phase))
            turns[roles[f"{side}_upper_arm"]] = about([1, 0, 1], 20 * swing)
            turns[roles[f"{side}_lower_arm"]] = about([0, 0, 1], -sign * (20 + 10 * np.sin(phase)))
        rotations = posed(skeleton, world, turns)
        heads = np.array(skeleton.offsets)
        for bone, parent in enumerate(skeleton.parents):
            if parent >= 0:
                heads[bone] = heads[parent] + turned(rotations[parent], skeleton.offsets[bone])
        poses.append(heads)
    return np.array(poses)


def bones_of(skeleton: core.Skeleton) -> Bones:
    roles = {
        role: bone
        for role, (bone, _) in skeleton.role_map().items()
        if not role[-1].isdigit() or role[:5] in {"spine", "neck_"}
    }
    heads = dict(zip(skeleton.names, strides(skeleton, roles).swapaxes(0, 1)))
    parents = {name: skeleton.names[p] if p >= 0 else "" for name, p in zip(skeleton.names, skeleton.parents)}
    ends = {name: end - heads[name][0] for name, end in zip(skeleton.names, skeleton.rest_tails())}
    return Bones(parents, heads, ends, roles)


def insert(bones: Bones, bone: str, part: str, along: float) -> None:
    """A part of a limb's bone, on which the next one hangs."""
    following = {"upper_arm": "lower_arm", "lower_arm": "hand", "thigh": "shin", "shin": "foot"}
    role = next(role for role, name in bones.roles.items() if name == bone)
    side, _, limb = role.partition("_")
    below = bones.roles[f"{side}_{following[limb]}"]
    bones.parents[part], bones.parents[below] = bone, part
    bones.heads[part] = (1 - along) * bones.heads[bone] + along * bones.heads[below]
    bones.ends[part] = (1 - along) * bones.ends[bone]


def split_spine(bones: Bones, number: int) -> None:
    """Another bone amid one of the spine's, which counts among them."""
    spine = [bones.roles.pop(f"spine_{i + 1}") for i in range(sum(role.startswith("spine") for role in bones.roles))]
    below, above, part = spine[number], spine[number + 1], f"spine part {len(bones.parents)}"
    bones.parents[part], bones.parents[above] = below, part
    bones.heads[part] = (bones.heads[below] + bones.heads[above]) / 2
    bones.ends[part] = bones.ends[below] = bones.ends[below] / 2
    spine.insert(number + 1, part)
    bones.roles.update({f"spine_{i + 1}": bone for i, bone in enumerate(spine)})


def varied(bones: Bones, random: np.random.Generator) -> None:
    """Bones above it, and parts in its spine and limbs, or none."""
    for _ in range(random.integers(3)):
        split_spine(bones, int(random.integers(sum(role.startswith("spine") for role in bones.roles) - 1)))
    root = next(name for name, parent in bones.parents.items() if not parent)
    for number in range(random.integers(3)):
        above = f"above {number}"
        bones.parents[root], bones.parents[above] = above, ""
        bones.heads[above], bones.ends[above] = 0 * bones.heads[root], np.array([0, 0.1, 0])
        bones.roles["root"] = root = above
    for limb in ("upper_arm", "lower_arm", "thigh", "shin"):
        along = random.uniform(0.4, 0.6)
        for side in ("left", "right") if random.random() < 0.5 else ():
            bone = bones.roles[f"{side}_{limb}"]
            insert(bones, bone, f"{bone} part", along)


def ordered(bones: Bones, random: np.random.Generator) -> list[str]:
    """The bones in any order in which parents come first."""
    order: list[str] = []
    while len(order) < len(bones.parents):
        ready = [b for b, p in bones.parents.items() if b not in order and (not p or p in order)]
        order.append(ready[random.integers(len(ready))])
    return order


def skeleton_of(bones: Bones, names: dict[str, str]) -> core.Skeleton:
    """In the order of `names`, which says what each bone is called."""
    order = list(names)
    parents = [order.index(bones.parents[bone]) if bones.parents[bone] else -1 for bone in order]
    heads = [bones.heads[bone][0] for bone in order]
    offsets = np.array([head - (heads[parent] if parent >= 0 else 0) for head, parent in zip(heads, parents)])
    tips, still = np.array([bones.ends[bone] for bone in order]), np.tile([1.0, 0, 0, 0], (len(order), 1))
    return core.Skeleton(list(names.values()), parents, still, offsets, tips)


@pytest.mark.thorough
def test_fifty_bodies_renamed_and_hung_anew_are_told_right_or_not_at_all() -> None:
    right, roles = 0, 0
    for seed in range(50):
        random = np.random.default_rng(seed)
        family = sorted(FAMILIES)[seed % len(FAMILIES)]
        bones = bones_of(
            humanoid(family, random.uniform(0.6, 1.6), random.uniform(0.8, 1.2), arms=random.uniform(0, 80))
        )
        varied(bones, random)
        names = dict(zip(ordered(bones, random), (f"b{number}" for number in random.permutation(1000))))
        heads = np.array([bones.heads[bone][1:] for bone in names]).swapaxes(0, 1)
        truth = {role: names[bone] for role, bone in bones.roles.items()}
        told = {role: bone for role, (bone, _) in skeleton_of(bones, names).role_map(heads).items()}
        assert {role: truth.get(role) for role in told} == told, f"seed {seed}, {family}"
        right += len(told)
        roles += len(truth)
    assert right >= 0.9 * roles, f"{right} of {roles}"


def test_a_thumb_of_a_foot_is_a_toe() -> None:
    skeleton = remade(humanoid("mixamo"), rename=lambda name: name.replace("ToeBase", "FootThumb1"))
    assert skeleton.role_map()["left_toe"][0] == "LeftFootThumb1"


def test_a_leaf_bone_is_no_joint_of_a_finger() -> None:
    skeleton = remade(humanoid("mixamo"), rename=lambda name: name.replace("Index3", "Index3Leaf"))
    roles = skeleton.role_map()
    assert "left_index_2" in roles
    assert "left_index_3" not in roles


def test_the_better_named_of_two_shoulders_is_the_collar_bone() -> None:
    bones = bones_of(humanoid("unreal"))
    for side in ("l", "r"):
        bones.parents[f"upperarm_{side}"], bones.parents[f"shoulder_{side}"] = f"shoulder_{side}", f"clavicle_{side}"
        bones.heads[f"shoulder_{side}"] = (bones.heads[f"clavicle_{side}"] + bones.heads[f"upperarm_{side}"]) / 2
        bones.ends[f"shoulder_{side}"] = bones.ends[f"clavicle_{side}"] / 2
    names = {bone: bone for bone in ordered(bones, np.random.default_rng(1))}
    assert skeleton_of(bones, names).role_map()["left_shoulder"][0] == "clavicle_l"


@pytest.mark.parametrize(("back", "told"), [(0.0, True), (0.15, False)])
def test_the_shin_of_a_leg_that_has_a_joint_more_is_not_told(back: float, told: bool) -> None:
    bones = bones_of(humanoid("mixamo"))
    for side in ("Left", "Right"):
        insert(bones, f"{side}Leg", f"{side}Hock", 0.5)
        bones.heads[f"{side}Hock"] = bones.heads[f"{side}Hock"] + [0, back, 0]
    names = {bone: bone for bone in ordered(bones, np.random.default_rng(1))}
    roles = skeleton_of(bones, names).role_map()
    assert ("left_shin" in roles) == told
    assert roles["left_thigh"][0] == "LeftUpLeg"
    assert roles["left_foot"][0] == "LeftFoot"


def test_no_shin_is_told_of_a_leg_with_a_joint_more_before_what_is_named_so() -> None:
    """Thigh, knee ahead, hock behind and foot, as of birds and of Quaternius' robots."""
    bones = bones_of(humanoid("mixamo"))
    for side in ("Left", "Right"):
        insert(bones, f"{side}UpLeg", f"{side}Knee", 0.5)
        bones.heads[f"{side}Knee"] = bones.heads[f"{side}Knee"] + [0, -0.2, 0]
    calls = {"Knee": "MidLeg", "Leg": "LowerLeg", "Foot": "FootBack"}
    names = {}
    for bone in ordered(bones, np.random.default_rng(1)):
        side = next((side for side in ("Left", "Right") if bone.startswith(side)), "")
        names[bone] = side + calls.get(bone[len(side) :], bone[len(side) :])
    roles = skeleton_of(bones, names).role_map()
    assert "left_shin" not in roles and "right_shin" not in roles
    assert (roles["left_thigh"][0], roles["left_foot"][0]) == ("LeftUpLeg", "LeftFootBack")


@pytest.mark.parametrize(("left", "right", "told"), [("Left", "Right", True), ("Right", "Left", False)])
def test_the_shape_tells_no_arm_whose_names_say_the_other_side(left: str, right: str, told: bool) -> None:
    arms = {f"{side}{part}": f"{name}Fin{part[0]}" for side, name in (("Left", left), ("Right", right)) for part in ARM}
    skeleton = remade(humanoid("mixamo"), rename=lambda name: arms.get(name, name))
    assert ("left_lower_arm" in skeleton.role_map()) == told


def named(bones: Bones) -> dict[str, str]:
    """What the roles are taken for where the bones have their names."""
    names = {bone: bone for bone in ordered(bones, np.random.default_rng(1))}
    return {role: bone for role, (bone, _) in skeleton_of(bones, names).role_map().items()}


def unnamed(bones: Bones) -> dict[str, str]:
    """What the roles are taken for where the names say nothing, and the body moves."""
    names = dict(zip(ordered(bones, np.random.default_rng(1)), NAMELESS))
    back, heads = {new: old for old, new in names.items()}, np.array([bones.heads[bone][1:] for bone in names])
    told = skeleton_of(bones, names).role_map(heads.swapaxes(0, 1))
    return {role: back[bone] for role, (bone, _) in told.items()}


def body_roles(roles: dict[str, str]) -> dict[str, str]:
    """Those that are no fingers'."""
    return {role: bone for role, bone in roles.items() if not role[-1].isdigit() or role[:5] in {"spine", "neck_"}}


@pytest.mark.parametrize("family", sorted(FAMILIES))
def test_names_that_say_left_of_what_is_right_are_seen_through(family: str) -> None:
    left, right = FAMILIES[family]["sides"]
    skeleton = humanoid(family)
    pairs = {}
    for key in ("arm", "leg", "fingers"):
        for name in FAMILIES[family][key]:
            for number in "123":
                sided = [name.replace("@", side).replace("#", number) for side in (left, right)]
                pairs.update(zip(sided, reversed(sided)))
    mirrored = remade(skeleton, rename=lambda name: pairs.get(name, name))
    truth = {role: pairs.get(bone, bone) for role, (bone, _) in skeleton.role_map().items()}
    assert {role: bone for role, (bone, _) in mirrored.role_map().items()} == truth


def test_feet_that_controls_carry_leave_the_rest_of_the_body_told() -> None:
    bones = bones_of(humanoid("mixamo"))
    for side in ("Left", "Right"):
        bones.parents[f"{side}Foot"] = "Hips"
    truth = {role: bone for role, bone in bones.roles.items() if "foot" not in role and "toe" not in role}
    assert body_roles(named(bones)) == truth


def test_the_bone_that_carries_spine_and_legs_is_the_hips_whatever_is_called_pelvis() -> None:
    bones = bones_of(humanoid("mixamo"))
    bones.parents["Hips"], bones.parents["Body"] = "Body", ""
    bones.heads["Body"], bones.ends["Body"] = bones.heads["Hips"], bones.ends["Hips"]
    for side in ("Left", "Right"):
        bones.parents[f"{side}UpLeg"] = "Body"
    bones.heads["RightLeg"] = bones.heads["RightLeg"] + [0, 0, 0.1]  # the shape tells nothing
    roles = named(bones)
    assert (roles["hips"], roles["spine_1"], roles["spine_2"]) == ("Body", "Hips", "Spine")


def test_arms_on_the_hips_tell_no_spine_from_a_neck() -> None:
    bones = bones_of(humanoid("mixamo"))
    for side in ("Left", "Right"):
        bones.parents[f"{side}Shoulder"] = "Hips"
    named_otherwise = {"Spine": "lower", "Spine1": "middle", "Spine2": "upper"}
    names = {bone: named_otherwise.get(bone, bone) for bone in ordered(bones, np.random.default_rng(1))}
    told = body_roles({role: bone for role, (bone, _) in skeleton_of(bones, names).role_map().items()})
    assert told["neck_1"] == "Neck" and told["left_lower_arm"] == "LeftForeArm"
    assert not {"lower", "middle", "upper"} & set(told.values())


def test_numbers_alone_tell_no_joint_of_a_limb_but_its_shape_does() -> None:
    skeleton = humanoid("mixamo")
    renamed = {}
    for side in ("Left", "Right"):
        renamed.update({f"{side}{part}": f"arm_joint_{side[0]}_{i}" for i, part in enumerate(ARM)})
        leg = ("UpLeg", "Leg", "Foot", "ToeBase")
        renamed.update({f"{side}{part}": f"leg_joint_{side[0]}_{i}" for i, part in enumerate(leg)})
    roles = {role: bone for role, (bone, _) in skeleton.role_map().items()}
    told = remade(skeleton, rename=lambda name: renamed.get(name, name)).role_map()
    assert {role: told[role][0] for role in body_roles(roles)} == {
        role: renamed.get(bone, bone) for role, bone in body_roles(roles).items()
    }


def test_layers_of_a_rig_are_told_apart_with_numbers_of_nodes_behind_all_names() -> None:
    bones = bones_of(humanoid("rigify"))
    names = {bone: f"DEF-{bone}" for bone in ordered(bones, np.random.default_rng(1))}
    truth = dict(bones.roles)
    for bone, above in (("torso", ""), ("ORG-spine", "torso")):
        bones.parents[bone], bones.heads[bone], bones.ends[bone] = above, bones.heads["spine"], bones.ends["spine"]
    bones.parents.update({"spine": "torso", "thigh.L": "ORG-spine", "thigh.R": "ORG-spine"})
    names = {
        bone: f"{name}_{number:02}"
        for number, (bone, name) in enumerate(
            {"torso": "torso", "spine": "DEF-spine", "ORG-spine": "ORG-spine", **names}.items()
        )
    }
    told = {role: bone for role, (bone, _) in skeleton_of(bones, names).role_map().items()}
    assert body_roles(told) == {"root": names["torso"], **{role: names[bone] for role, bone in truth.items()}}


def test_collar_bones_as_long_as_arms_are_known_by_where_they_begin() -> None:
    bones = bones_of(humanoid("mixamo"))
    for side, sign in (("Left", 1), ("Right", -1)):
        bones.heads[f"{side}Shoulder"] = bones.heads["Neck"] - [0, 0, 0.03]
        for bone in bones.heads:
            if bone.startswith(side) and bone[len(side) :] not in {"Shoulder", "UpLeg", "Leg", "Foot", "ToeBase"}:
                bones.heads[bone] = bones.heads[bone] + [0.1 * sign, 0, 0]
    truth = {role: bone for role, bone in bones.roles.items() if "arm" in role or "shoulder" in role}
    told = unnamed(bones)
    assert {role: told.get(role) for role in truth} == truth


def test_feet_as_long_as_thighs_are_known_by_where_they_lead() -> None:
    bones = bones_of(humanoid("mixamo"))
    for side in ("Left", "Right"):
        bones.heads[f"{side}ToeBase"] = bones.heads[f"{side}ToeBase"] + [0, -0.3, 0]
    assert unnamed(bones)["left_foot"] == "LeftFoot"


def test_controls_that_a_file_kept_beside_the_body_are_no_limbs() -> None:
    bones = bones_of(humanoid("unreal"))
    for side in ("l", "r"):
        ball, above = bones.heads[f"ball_{side}"], "root"
        for part, offset in (("toe roll", -0.3), ("heel roll", 0.3), ("foot roll", -0.2), ("target", 0.2)):
            bones.parents[f"{part} {side}"], above = above, f"{part} {side}"
            bones.heads[above], bones.ends[above] = ball + np.array([0, offset, 0]), np.array([0, 0, 0.1])
    told = unnamed(bones)
    assert {role: bones.roles.get(role) for role in told} == told
    assert told["hips"] == "pelvis"
