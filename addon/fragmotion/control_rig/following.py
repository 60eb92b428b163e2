# SPDX-License-Identifier: GPL-3.0-or-later
"""The motion skeleton of a rig, and the constraints by which the rig's controls follow it.

A control need not point where the part of the body does that it turns: each follows an anchor, a bone of an armature of
its own that rests just as the control does and is carried by a bone of the motion skeleton.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import bpy
from mathutils import Euler, Matrix, Vector

from ..rig.posing import playing, reset_pose
from .armatures import RestBone, make_armature
from .controls import ROOT, Controls
from .joints import Joint, height_of
from .planes import carry, lay_plane, plane_bones, plane_name

PREFIX = "Fragmotion"
"""What the names of all constraints on the rig begin with."""

_ROOT_LENGTH = 0.2  # of the body's height, at most
_TRIAL = 0.2  # rad by which a bone is turned at most to see whether the rig follows
_PACE = 0.1  # of the body's height by which the body is moved for it


def bone_name(role: str) -> str:
    """The motion skeleton's bone: "left_upper_arm" is "upper_arm.L"."""
    side, _, part = role.partition("_")
    return f"{part}.{side[0].upper()}" if side in {"left", "right"} else role


def make_motion_skeleton(
    context: bpy.types.Context,
    obj: bpy.types.Object,
    collection: bpy.types.Collection,
    controls: Controls,
    joints: Mapping[str, Joint],
) -> bpy.types.Object:
    """Plain bones through the rig's joints."""
    return make_armature(context, f"{obj.name} Motion", collection, obj, _plain_bones(obj, controls, joints))


def make_anchors(
    context: bpy.types.Context,
    obj: bpy.types.Object,
    collection: bpy.types.Collection,
    motion: bpy.types.Object,
    controls: Controls,
    joints: Mapping[str, Joint],
) -> bpy.types.Object:
    """Bones that rest as the controls do, and that the motion skeleton carries, or the planes of its limbs."""
    planes = {follower.plane.limb: follower.plane for follower in controls.followers if follower.plane}.values()
    rests = [_anchor(obj.data.bones[follower.control], follower.rest) for follower in controls.followers]
    laid = [bone for plane in planes for bone in plane_bones(plane, joints)]
    anchors = make_armature(context, f"{obj.name} Anchors", collection, obj, [*rests, *laid])
    for plane in planes:
        lay_plane(anchors, plane, motion, {role: bone_name(role) for role in plane.limb})
    for follower in controls.followers:
        if follower.plane is None:
            carry(anchors, follower.control, motion, bone_name(follower.role))
        else:
            carry(anchors, follower.control, anchors, plane_name(follower.plane))
    return anchors


def constrain(obj: bpy.types.Object, anchors: bpy.types.Object, controls: Controls) -> None:
    """Let the controls follow their anchors, whatever above them in the rig moves."""
    for follower in controls.followers:
        bone = obj.pose.bones[follower.control]
        for kind in ["COPY_ROTATION"] * follower.turns + ["COPY_LOCATION"] * follower.moves:
            constraint = bone.constraints.new(kind)
            constraint.name = f"{PREFIX} {constraint.name}"
            constraint.target, constraint.subtarget = anchors, follower.control
            constraint.owner_space = constraint.target_space = "POSE"


def constraints_of(obj: bpy.types.Object) -> Iterator[tuple[bpy.types.PoseBone, bpy.types.Constraint]]:
    """The constraints by which the rig follows, with their bones."""
    for bone in obj.pose.bones:
        for constraint in list(bone.constraints):
            if constraint.name.startswith(PREFIX):
                yield bone, constraint


def deviations(
    context: bpy.types.Context, obj: bpy.types.Object, motion: bpy.types.Object, joints: Mapping[str, Joint]
) -> dict[str, float]:
    """How far the rig's joints, by their roles, are from the motion skeleton's in a pose of trial, in the armature's
    units."""
    with playing(context, obj, None):
        _pose_for_trial(motion)
        context.view_layer.update()
        depsgraph = context.evaluated_depsgraph_get()
        rig, plain = obj.evaluated_get(depsgraph).pose.bones, motion.evaluated_get(depsgraph).pose.bones
        apart = {role: (rig[joint.bone].head - plain[bone_name(role)].head).length for role, joint in joints.items()}
    reset_pose(motion)
    return apart


def _pose_for_trial(motion: bpy.types.Object) -> None:
    for index, bone in enumerate(motion.pose.bones):
        angles = [_TRIAL * ((index * step) % 5 - 2) / 2 for step in (1, 2, 3)]
        bone.rotation_quaternion = Euler(angles).to_quaternion()
    motion.pose.bones[bone_name("hips")].location = 3 * [_PACE * motion.data.bones[bone_name("hips")].length]
    motion.update_tag()


def _plain_bones(obj: bpy.types.Object, controls: Controls, joints: Mapping[str, Joint]) -> Iterator[RestBone]:
    if controls.root:
        root = _rest(obj.data.bones[controls.root])
        yield root._replace(name=bone_name(ROOT), tail=root.head + _shortened(root.tail - root.head, joints))
    for role, joint in joints.items():
        parent = joint.parent or (ROOT if controls.root else "")
        up = obj.data.bones[joint.bone].matrix_local.col[2].to_3d()
        yield RestBone(bone_name(role), bone_name(parent) if parent else "", joint.head, joint.tail, up)


def _anchor(bone: bpy.types.Bone, rest: Matrix) -> RestBone:
    """A bone as a control is that rests so."""
    along, up = (rest.col[axis].to_3d().normalized() for axis in (1, 2))
    return RestBone(bone.name, "", rest.translation, rest.translation + bone.length * along, up)


def _rest(bone: bpy.types.Bone) -> RestBone:
    up = bone.matrix_local.col[2].to_3d()
    return RestBone(bone.name, "", bone.head_local.copy(), bone.tail_local.copy(), up)


def _shortened(way: Vector, joints: Mapping[str, Joint]) -> Vector:
    return min(way.length, _ROOT_LENGTH * height_of(joints)) * way.normalized()
