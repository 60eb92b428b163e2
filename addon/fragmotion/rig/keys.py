# SPDX-License-Identifier: GPL-3.0-or-later
"""A motion as keys of an armature's channels: one on every frame, or as few as keep every bone within a bound."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..compat.core import core
from .rigs import bone_path, is_tied

if TYPE_CHECKING:
    from collections.abc import Collection, Sequence

    import bpy
    from fragmotion_core import Doubles, Ints, Rig

    from ..jobs import Report

_OBJECT = -1
_LOCATION = "LOCATION"


class Bone(NamedTuple):
    """How a bone, or with its name empty the object, is keyed: its rotation mode, and whether its location is."""

    name: str
    mode: str
    moves: bool


class Poses(NamedTuple):
    """Locations [F,B,3] and rotations [F,B,4] of all bones in the armature's order, and the object's own [F,3], [F,4]
    where it moves."""

    locations: Doubles
    rotations: Doubles
    places: Doubles | None = None
    turns: Doubles | None = None


class Place(NamedTuple):
    """What stands above the object's own location and rotation [4,4], and its scale [3]."""

    above: Doubles
    scale: Doubles


class Track(NamedTuple):
    """A keyed property: data path and group, whose it is (a bone's number or -1), the rotation mode or LOCATION, its
    values [F,N] on all frames as its keys show them, the frames [K] that have keys, and where these are not all of
    them the curve's slopes [K,N] there, a frame."""

    path: str
    group: str
    owner: int
    mode: str
    values: Doubles
    kept: Ints
    slopes: Doubles | None = None


class Deviation(NamedTuple):
    """How far a bone is at most from its place, in metres, and from its direction, in radians."""

    distance: float
    angle: float


def make_layout(obj: bpy.types.Object, moving: Collection[str]) -> list[Bone]:
    """How the armature's bones are keyed, in its order, the `moving` ones with their location; then the object."""
    modes = {bone.name: bone.rotation_mode for bone in obj.pose.bones}
    bones = [Bone(bone.name, modes[bone.name], bone.name in moving and not is_tied(bone)) for bone in obj.data.bones]
    return [*bones, Bone("", obj.rotation_mode, True)]


def make_tracks(layout: Sequence[Bone], poses: Poses) -> list[Track]:
    """Tracks with a key on every frame, each bone in its own rotation mode."""
    tracks = []
    for index, bone in enumerate(layout[:-1]):
        tracks += _tracks_of(bone, index, poses.locations[:, index], poses.rotations[:, index])
    if poses.places is not None and poses.turns is not None:
        tracks += _tracks_of(layout[-1], _OBJECT, poses.places, poses.turns)
    return tracks


def reduce_tracks(
    tracks: Sequence[Track], rig: Rig, poses: Poses, place: Place, bound: Deviation, report: Report
) -> tuple[list[Track], Deviation]:
    """Tracks with so few keys that on no frame a bone is further than the bound from where it was, seen in the world.

    Tells how far a bone is then at most. core.Cancelled where `report` says so.
    """
    given = [(track.owner, track.mode, track.values) for track in tracks]
    keys, distance, angle = core.reduce_keys(rig, given, *poses, *place, *bound, report)
    reduced = [
        track._replace(kept=kept, slopes=slopes, values=drawn)
        for track, (kept, slopes, drawn) in zip(tracks, keys, strict=True)
    ]
    return reduced, Deviation(distance, angle)


def count_keys(tracks: Sequence[Track]) -> int:
    """Keys of all the tracks' F-curves."""
    return sum(len(track.kept) * track.values.shape[1] for track in tracks)


def from_quaternions(mode: str, rotations: Doubles) -> tuple[str, Doubles]:
    """The channel of a rotation mode, and the rotations [F,4] in its terms."""
    if mode == "QUATERNION":
        return "rotation_quaternion", rotations
    if mode == "AXIS_ANGLE":
        return "rotation_axis_angle", core.quaternion_to_axis_angle(rotations)
    return "rotation_euler", core.quaternion_to_euler(mode, rotations)


def to_quaternions(mode: str, values: Doubles) -> Doubles:
    """A rotation channel's values in the mode's terms to quaternions [F,4]."""
    if mode == "QUATERNION":
        return values
    rotations: Doubles = (
        core.axis_angle_to_quaternion(values) if mode == "AXIS_ANGLE" else core.euler_to_quaternion(mode, values)
    )
    return rotations


def _tracks_of(bone: Bone, owner: int, locations: Doubles, rotations: Doubles) -> list[Track]:
    name, values = from_quaternions(bone.mode, rotations)
    every = np.arange(len(values), dtype=np.int32)
    tracks = [Track(_path(bone, name), bone.name, owner, bone.mode, values, every)]
    if bone.moves:
        tracks.insert(0, Track(_path(bone, "location"), bone.name, owner, _LOCATION, locations, every))
    return tracks


def _path(bone: Bone, channel: str) -> str:
    return bone_path(bone.name, channel) if bone.name else channel
