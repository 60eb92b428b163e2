# SPDX-License-Identifier: MIT
"""Reduced keys keep every bone where it was, by forward kinematics and splines that are SciPy's."""

from __future__ import annotations

from typing import NamedTuple

import fragmotion_core as core
import numpy as np
import pytest
from conftest import Array
from scipy.interpolate import CubicHermiteSpline
from scipy.spatial.transform import Rotation

FRAMES = 90
MODES = ["QUATERNION", "AXIS_ANGLE", "XYZ", "ZYX"]
UNIT = 0.01  # m, the armature's
SCALE = np.full(3, UNIT)
ABOVE = np.array([[0.0, -1, 0, 2], [1, 0, 0, 3], [0, 0, 1, 0], [0, 0, 0, 1]])


class Keyed(NamedTuple):
    """An armature with all its channels and the tracks that show them."""

    rig: core.Rig
    locations: Array
    rotations: Array
    object_locations: Array
    object_rotations: Array
    tracks: list[tuple[int, str, Array]]


@pytest.fixture
def keyed(skeleton: core.Skeleton) -> Keyed:
    """Every bone swings, each in a mode of its own; the hips and the object move."""
    bones = len(skeleton.names)
    rest = upright_rest(skeleton)
    rig = core.Rig(skeleton.names, skeleton.parents, rest, np.full(bones, 10.0), np.diag([UNIT, UNIT, UNIT, 1]))
    t = np.arange(FRAMES)[:, None] / 30
    swings = np.stack([0.3 * np.sin((2 + b % 3) * t + b) * np.eye(3)[b % 3] for b in range(bones)], 1)
    rotations = wxyz(Rotation.from_rotvec(swings.reshape(-1, 3))).reshape(FRAMES, bones, 4)
    locations = np.zeros((FRAMES, bones, 3))
    hips = skeleton.names.index("hips")
    locations[:, hips] = 5 * np.hstack((np.sin(2 * t), 0 * t, np.cos(3 * t)))
    object_rotations = wxyz(Rotation.from_euler("z", 0.8 * t))
    object_locations = np.hstack((t, 0.2 * t * t, 0 * t))
    tracks = [(hips, "LOCATION", locations[:, hips]), (-1, "LOCATION", object_locations)]
    tracks += [(b, MODES[b % 4], in_terms_of(MODES[b % 4], rotations[:, b])) for b in range(bones)]
    tracks += [(-1, "XYZ", in_terms_of("XYZ", object_rotations))]
    return Keyed(rig, locations, rotations, object_locations, object_rotations, tracks)


def reduce(keyed: Keyed, distance: float, angle: float) -> tuple[list[tuple[Array, Array | None, Array]], float, float]:
    return core.reduce_keys(
        keyed.rig,
        keyed.tracks,
        keyed.locations,
        keyed.rotations,
        keyed.object_locations,
        keyed.object_rotations,
        ABOVE,
        SCALE,
        distance,
        angle,
    )


@pytest.mark.parametrize(("distance", "angle"), [(0.02, np.radians(3)), (0.002, np.radians(0.3))])
def test_no_bone_leaves_its_bound(keyed: Keyed, distance: float, angle: float) -> None:
    keys, far, turned = reduce(keyed, distance, angle)
    heads, rotations = world(keyed, keyed.tracks)
    drawn = [(owner, mode, curve(*found)) for (owner, mode, _), found in zip(keyed.tracks, keys, strict=True)]
    other_heads, other_rotations = world(keyed, drawn)
    apart = np.linalg.norm(heads - other_heads, axis=-1).max()
    angles = (rotations.inv() * other_rotations).magnitude().max()
    assert apart <= distance and angles <= angle
    assert far >= apart - 1e-9 and turned >= angles - 1e-9, "it tells of less than there is"
    assert far <= distance and turned <= angle
    kept = sum(len(frames) for frames, _, _ in keys)
    assert kept < 0.5 * FRAMES * len(keyed.tracks)


def test_a_wider_bound_needs_fewer_keys(keyed: Keyed) -> None:
    counts = [sum(len(frames) for frames, _, _ in reduce(keyed, 0.01 * by, 0.02 * by)[0]) for by in (0.2, 1, 5)]
    assert counts[0] > counts[1] > counts[2]


def test_what_no_curve_can_follow_keeps_all_keys(keyed: Keyed) -> None:
    locations = np.random.default_rng(1).normal(size=keyed.locations.shape)
    still = keyed._replace(locations=locations, tracks=[(0, "LOCATION", locations[:, 0])])
    ((frames, slopes, drawn),), far, turned = reduce(still, 1e-6, 1e-6)
    np.testing.assert_array_equal(frames, np.arange(FRAMES))
    np.testing.assert_array_equal(drawn, locations[:, 0])
    assert slopes is None and far == turned == 0


def test_a_cancelled_reduction_says_so(keyed: Keyed) -> None:
    told: list[float] = []

    def progress(fraction: float, _stage: str) -> bool:
        told.append(fraction)
        return len(told) < 3

    with pytest.raises(core.Cancelled):
        core.reduce_keys(*keyed[:1], keyed.tracks, *keyed[1:5], ABOVE, SCALE, 0.01, 0.01, progress)
    assert len(told) == 3 and told == sorted(told)


@pytest.mark.parametrize(
    ("track", "message"),
    [
        ((99, "LOCATION", np.zeros((FRAMES, 3))), "99"),
        ((0, "XZX", np.zeros((FRAMES, 3))), "XZX"),
        ((0, "QUATERNION", np.ones((FRAMES, 3))), "values"),
    ],
)
def test_a_track_of_nothing_is_refused(keyed: Keyed, track: tuple[int, str, Array], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        reduce(keyed._replace(tracks=[track]), 0.01, 0.01)


def curve(frames: Array, slopes: Array | None, drawn: Array) -> Array:
    if slopes is None:
        return drawn
    shown: Array = CubicHermiteSpline(frames, drawn[frames], slopes)(np.arange(FRAMES))
    return shown


def world(keyed: Keyed, tracks: list[tuple[int, str, Array]]) -> tuple[Array, Rotation]:
    """Heads [F,B,3] and directions [F B] of the bones in the world, by matrices."""
    skeleton = keyed.rig.skeleton
    bones, rest = len(skeleton.names), upright_rest(skeleton)
    locations, turns = np.zeros((bones + 1, FRAMES, 3)), np.tile(np.eye(3), (bones + 1, FRAMES, 1, 1))
    for owner, mode, values in tracks:
        if mode == "LOCATION":
            locations[owner] = values
        else:
            turns[owner] = rotation_of(mode, values).as_matrix()
    top = np.tile(np.eye(4), (FRAMES, 1, 1))
    top[:, :3, :3], top[:, :3, 3] = turns[-1] * UNIT, locations[-1]
    top = ABOVE @ top
    poses: list[Array] = []
    for b, parent in enumerate(skeleton.parents):
        own = np.tile(np.eye(4), (FRAMES, 1, 1))
        own[:, :3, :3], own[:, :3, 3] = turns[b], locations[b]
        local = np.linalg.inv(rest[parent]) @ rest[b] if parent >= 0 else rest[b]
        poses.append((poses[parent] if parent >= 0 else top) @ local @ own)
    matrices = np.stack(poses, 1)
    return matrices[..., :3, 3], Rotation.from_matrix((matrices[..., :3, :3] / UNIT).reshape(-1, 3, 3))


def upright_rest(skeleton: core.Skeleton) -> Array:
    rest = np.tile([[1.0, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]], (len(skeleton.names), 1, 1))
    rest[:, :3, 3] = skeleton.rest_heads() / UNIT
    return rest


def in_terms_of(mode: str, rotations: Array) -> Array:
    if mode == "QUATERNION":
        return rotations
    if mode == "AXIS_ANGLE":
        return core.quaternion_to_axis_angle(rotations)
    return core.quaternion_to_euler(mode, rotations)


def rotation_of(mode: str, values: Array) -> Rotation:
    if mode == "QUATERNION":
        return Rotation.from_quat(np.roll(values, -1, axis=-1))
    if mode == "AXIS_ANGLE":
        return Rotation.from_rotvec(values[:, :1] * values[:, 1:] / np.linalg.norm(values[:, 1:], axis=1)[:, None])
    places = ["XYZ".index(axis) for axis in mode]
    return Rotation.from_euler(mode.lower(), values[:, places])


def wxyz(rotation: Rotation) -> Array:
    return np.roll(rotation.as_quat(), 1, axis=-1)
