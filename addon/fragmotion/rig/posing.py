# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's own evaluated poses, frame by frame, for armatures that constraints, drivers or scale move too."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING, NamedTuple

import bpy
import numpy as np

from ..compat import versions
from ..errors import UserError
from .keys import from_quaternions
from .rigs import bone_path, held_of, sizes_of

if TYPE_CHECKING:
    from fragmotion_core import Doubles
    from numpy.typing import NDArray

_REST = {
    "location": (0, 0, 0),
    "rotation_quaternion": (1, 0, 0, 0),
    "rotation_euler": (0, 0, 0),
    "rotation_axis_angle": (0, 0, 1, 0),
    "scale": (1, 1, 1),
}
CHANNELS = tuple(_REST)
"""What poses a bone, or an object."""
_BEYOND_KEYS = ("scale", "rotation_mode", "delta_location", "delta_rotation_euler", "delta_rotation_quaternion")
_AS_ONE = 1e-3  # a bone's scale that differs from 1 by less shows as 1.000, as importers of FBX key it in all bones


def is_needed(obj: bpy.types.Object, curves: Mapping[tuple[str, int], bpy.types.FCurve]) -> bool:
    """Whether anything but location and rotation keys of the bones and the object moves the armature."""
    drivers = obj.animation_data.drivers if obj.animation_data else ()
    return (
        obj.parent is not None
        or any(not constraint.mute for constraint in obj.constraints)
        or any(not driver.mute for driver in drivers)
        or any(not constraint.mute for bone in obj.pose.bones for constraint in bone.constraints)
        or any(bone.inherit_scale != "FULL" for bone in obj.data.bones)
        or any(
            path.startswith("pose.") and path.rpartition(".")[2] in _BEYOND_KEYS and not _is_one(path, curve)
            for (path, _), curve in curves.items()
        )
        or any(path in _BEYOND_KEYS for path, _ in curves)
        or any((*obj.delta_location, *obj.delta_rotation_euler))
    )


def _is_one(path: str, curve: bpy.types.FCurve) -> bool:
    """Whether a curve is of a scale that is 1 throughout, as it is without it."""
    if not path.endswith(".scale") or curve.modifiers or not curve.keyframe_points:
        return False
    points = np.empty((3, 2 * len(curve.keyframe_points)), np.float32)
    for channel, row in zip(("co", "handle_left", "handle_right"), points):
        curve.keyframe_points.foreach_get(channel, row)
    told = points if len(curve.keyframe_points) > 1 else points[:1]  # a single key has no use for handles
    return bool(np.abs(told[:, 1::2] - 1).max() < _AS_ONE)


def sample_poses(
    context: bpy.types.Context, obj: bpy.types.Object, action: bpy.types.Action, times: Doubles, longer: float
) -> tuple[Doubles, Doubles]:
    """Pose matrices [F,B,4,4] in the armature's space and order of bones, and the object's world matrices [F,4,4], the
    bones' locations so many times as long as they are keyed."""
    bones = obj.pose.bones
    keyed = {curve.data_path for curve in versions.curves_of(action, obj)} if longer != 1 else set[str]()
    moved = [bone for bone in bones if bone_path(bone.name, "location") in keyed]
    order = [bones.find(bone.name) for bone in obj.data.bones]
    matrices = np.empty((len(times), len(bones), 4, 4))
    worlds = np.empty((len(times), 4, 4))
    column_major = np.empty(16 * len(bones), np.float32)
    with playing(context, obj, action):
        for index, time in enumerate(times):
            _go_to(context.scene, time)
            for bone in moved:
                bone.location *= longer
            posed = obj.evaluated_get(context.evaluated_depsgraph_get())
            posed.pose.bones.foreach_get("matrix", column_major)
            matrices[index] = column_major.reshape(-1, 4, 4).transpose(0, 2, 1)[order]
            worlds[index] = posed.matrix_world
    return matrices, worlds


def reset_pose(obj: bpy.types.Object, channels: Collection[str] = CHANNELS) -> None:
    """Let these channels of all the armature's bones rest, or be as bones are held."""
    for channel in channels:
        obj.pose.bones.foreach_set(channel, np.tile(np.array(_REST[channel], np.float32), len(obj.pose.bones)))
    for name, row in held_of(obj).items():
        bone = obj.pose.bones[name]
        channel, (rotation,) = from_quaternions(bone.rotation_mode, np.array([row[3:]]))
        for each, value in (("location", row[:3]), (channel, rotation)):
            if each in channels:
                setattr(bone, each, value)
    for name, size in sizes_of(obj).items() if "scale" in channels else ():
        obj.pose.bones[name].scale = (size, size, size)
    obj.update_tag()


class Pose(NamedTuple):
    """An armature's channels, those of all its bones and the object's own."""

    bones: dict[str, NDArray[np.float32]]
    place: dict[str, tuple[float, ...]]


def pose_of(obj: bpy.types.Object) -> Pose:
    """The channels as they are set now."""
    bones = {channel: get_channel(obj, channel) for channel in CHANNELS}
    return Pose(bones, {channel: tuple(getattr(obj, channel)) for channel in CHANNELS})


def set_pose(obj: bpy.types.Object, pose: Pose) -> None:
    """Set what `pose_of` told."""
    for channel in CHANNELS:
        obj.pose.bones.foreach_set(channel, pose.bones[channel])
        setattr(obj, channel, pose.place[channel])
    obj.update_tag()


@contextmanager
def playing(context: bpy.types.Context, obj: bpy.types.Object, action: bpy.types.Action | None) -> Iterator[None]:
    """The object plays the Action (or none) alone from the pose of `reset_pose`; afterwards everything is as it was."""
    check_free(obj)
    had_data, played, frame = (
        obj.animation_data is not None,
        versions.assignment(obj),
        context.scene.frame_current_final,
    )
    pose = pose_of(obj)
    data = obj.animation_data or obj.animation_data_create()
    armature, use_nla, position = obj.data, data.use_nla, obj.data.pose_position
    try:
        data.use_nla, armature.pose_position = False, "POSE"
        reset_pose(obj)
        versions.assign(obj, action)
        yield
    finally:
        armature.pose_position = position  # first, as another object may show it when this one was deleted
        versions.restore(obj, played)
        data.use_nla = use_nla
        if not had_data:
            obj.animation_data_clear()
        _go_to(context.scene, frame)
        set_pose(obj, pose)
        context.view_layer.update()


def check_free(obj: bpy.types.Object) -> None:
    """UserError where the NLA editor forbids to assign an Action."""
    if obj.animation_data is not None and obj.animation_data.use_tweak_mode:
        raise UserError(f"Armature '{obj.name}' is in the NLA's tweak mode: leave it first (Tab in the NLA editor)")


def get_channel(obj: bpy.types.Object, channel: str) -> NDArray[np.float32]:
    """A channel of all the armature's bones, flat."""
    values = np.empty(len(_REST[channel]) * len(obj.pose.bones), np.float32)
    obj.pose.bones.foreach_get(channel, values)
    return values


def visit(scene: bpy.types.Scene, times: Iterable[float]) -> Iterator[float]:
    """Show each of these frames in turn, and at the end the one that was shown."""
    now = (scene.frame_current, scene.frame_subframe)
    try:
        for time in times:
            _go_to(scene, time)
            yield time
    finally:
        scene.frame_set(now[0], subframe=now[1])


def _go_to(scene: bpy.types.Scene, time: float) -> None:
    """Fractional frames as frame and subframe; the nearest whole frame where that is meant."""
    whole = math.floor(time + 1e-4)
    scene.frame_set(whole, subframe=min(max(time - whole, 0.0), 0.9999))
