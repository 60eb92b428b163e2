# SPDX-License-Identifier: GPL-3.0-or-later
"""The planes in which arms and legs bend, as bones: a solver of IK bends a limb in the plane that its pole tells, and a
pole that such a bone carries tells the plane of a limb that others bend.

The bone looks along the limb and is turned about it so that its z axis points to the middle joint. Where the limb is
nearly straight, this would jump about for a hair's breadth: it points to a place a little beside the joint, on the side
to which the limb bends, that goes along with the limb's first part.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import bpy
from mathutils import Vector

from .armatures import RestBone
from .joints import Joint

_STRAIGHT = 1e-3  # of the limb's length: a joint that is nearer to the line than this bends to no side

Limb = tuple[str, str, str]
"""The roles of a limb's parts: the first, the second, the end."""


class Plane(NamedTuple):
    """Of a limb, and to which side it bends at rest: a unit vector in the armature's space."""

    limb: Limb
    side: Vector


def find_plane(joints: Mapping[str, Joint], limb: Limb, poles: Sequence[Vector]) -> Plane | None:
    """The plane in which a limb rests, of a straight one that of its first pole; None where nothing tells it."""
    first, middle, end = (joints[role].head for role in limb)
    for place in (middle, *poles):
        aside = _across(place - first, end - first)
        if aside.length > _STRAIGHT * (end - first).length:
            return Plane(limb, aside.normalized())
    return None


def plane_name(plane: Plane) -> str:
    """The bone of a plane."""
    return f"{plane.limb[0]} plane"


def plane_of(anchors: bpy.types.Object, name: str) -> str | None:
    """The bone of the plane that carries an anchor, None for one that the motion skeleton carries."""
    target = anchors.pose.bones[name].constraints[0].targets[0]
    return target.subtarget if target.target == anchors else None


def plane_bones(plane: Plane, joints: Mapping[str, Joint]) -> Iterator[RestBone]:
    """The bone of a plane, and the place to which it points."""
    first, middle, end = (joints[role].head for role in plane.limb)
    beside = _STRAIGHT * (end - first).length * plane.side
    yield RestBone(plane_name(plane), "", first, end, plane.side)
    yield RestBone(_aim_name(plane), "", middle + beside, middle + 2 * beside, end - first)


def lay_plane(anchors: bpy.types.Object, plane: Plane, motion: bpy.types.Object, bone_of: Mapping[str, str]) -> None:
    """Let a plane's bones, which are among the anchors, go along with the motion skeleton's of the limb's roles."""
    first, _, end = (bone_of[role] for role in plane.limb)
    carry(anchors, _aim_name(plane), motion, first)
    bone = anchors.pose.bones[plane_name(plane)]
    at, along, about = (bone.constraints.new(kind) for kind in ("COPY_LOCATION", "DAMPED_TRACK", "LOCKED_TRACK"))
    at.target, at.subtarget = motion, first
    along.target, along.subtarget, along.track_axis = motion, end, "TRACK_Y"
    about.target, about.subtarget = anchors, _aim_name(plane)
    about.lock_axis, about.track_axis = "LOCK_Y", "TRACK_Z"


def carry(anchors: bpy.types.Object, name: str, carrier: bpy.types.Object, bone: str) -> None:
    """Let a bone of an armature carry an anchor from now on."""
    held = anchors.pose.bones[name]
    constraint = held.constraints[0] if held.constraints else held.constraints.new("ARMATURE")
    target = constraint.targets[0] if constraint.targets else constraint.targets.new()
    target.target, target.subtarget = carrier, bone


def _aim_name(plane: Plane) -> str:
    return f"{plane.limb[0]} aim"


def _across(way: Vector, along: Vector) -> Vector:
    """What of a way is across another."""
    return way - way.project(along)
