# SPDX-License-Identifier: GPL-3.0-or-later
"""Poses to an Action's F-curves, each bone in its own rotation mode."""

from __future__ import annotations

from collections.abc import Collection
from typing import TYPE_CHECKING

import bpy
import numpy as np

from . import versions
from .core import core
from .rigs import bone_path, is_tied

if TYPE_CHECKING:
    from fragmotion_core import Doubles

_LINEAR = 1  # RNA's number of the interpolation 'LINEAR'


def write_poses(
    action: bpy.types.Action,
    obj: bpy.types.Object,
    times: Doubles,
    locations: Doubles,
    rotations: Doubles,
    moving: Collection[str],
) -> None:
    """Key all bones' rotations [F,B,4] and the `moving` bones' locations [F,B,3] at the times (scene frames).

    Bones are in the armature's order. The object's former keys in the Action go.
    """
    holder = versions.holder_for(action, obj)
    holder.fcurves.clear()
    for index, bone in enumerate(obj.data.bones):
        if bone.name in moving and not is_tied(bone):
            _write_channel(holder, bone, "location", times, locations[:, index])
        channel, values = from_quaternions(obj.pose.bones[bone.name].rotation_mode, rotations[:, index])
        _write_channel(holder, bone, channel, times, values)


def from_quaternions(mode: str, rotations: Doubles) -> tuple[str, Doubles]:
    """The channel of a rotation mode, and the rotations [F,4] in its terms."""
    if mode == "QUATERNION":
        return "rotation_quaternion", rotations
    if mode == "AXIS_ANGLE":
        return "rotation_axis_angle", core.quaternion_to_axis_angle(rotations)
    return "rotation_euler", core.quaternion_to_euler(mode, rotations)


def _write_channel(holder: object, bone: bpy.types.Bone, channel: str, times: Doubles, values: Doubles) -> None:
    for index in range(values.shape[1]):
        curve = versions.new_curve(holder, bone_path(bone.name, channel), index, bone.name)
        keys = curve.keyframe_points
        keys.add(len(times))
        keys.foreach_set("co", np.column_stack((times, values[:, index])).astype(np.float32).ravel())
        keys.foreach_set("interpolation", np.full(len(times), _LINEAR, np.int32))
        curve.update()
