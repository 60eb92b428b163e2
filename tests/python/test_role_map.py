# SPDX-License-Identifier: MIT
"""The map from roles to bones, as Python has it."""

from __future__ import annotations

import fragmotion_core as core
import numpy as np
import pytest
from conftest import BANDAI, NAMES, make_skeleton

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
        pytest.skip(f"no motion capture at {BANDAI}")
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
    assert right >= 0.6 * roles, f"{right} of {roles}"


def test_heads_of_another_shape_are_refused() -> None:
    with pytest.raises(ValueError, match="heads"):
        make_skeleton().role_map(np.zeros((2, len(NAMES) - 1, 3)))
    with pytest.raises(ValueError, match="heads: a place is not finite"):
        make_skeleton().role_map(np.full((1, len(NAMES), 3), np.nan))
