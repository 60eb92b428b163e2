# SPDX-License-Identifier: GPL-3.0-or-later
"""What a control rig does while it follows its motion skeleton, as keys on its controls."""

from __future__ import annotations

from collections.abc import Generator, Iterator, Sequence
from math import ceil, floor
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ..compat import versions
from ..errors import UserError
from ..mocap.actions import BAKED
from ..rig.keys import Bone, Poses, Track, make_tracks
from ..rig.writing import keep_former, write_tracks
from .binding import follows, motion_of, set_following
from .following import constraints_of
from .wiring import Switch, read_switch

if TYPE_CHECKING:
    from fragmotion_core import Doubles

Stepping = Generator[float, None, Poses]


def span(obj: bpy.types.Object) -> range:
    """The frames of the Action that the rig's motion skeleton plays; UserError where there is none."""
    first, last = _motion(obj).frame_range
    return range(floor(first), ceil(last) + 1)


def _motion(obj: bpy.types.Object) -> bpy.types.Action:
    """The Action that the rig's motion skeleton plays."""
    motion = motion_of(obj)
    if motion is None:
        raise UserError(f"Armature '{obj.name}' has no motion skeleton any more: press Unbind, and make it anew")
    action, _ = versions.assignment(motion)
    if action is None or not versions.curves_of(action, motion):
        raise UserError(f"Armature '{motion.name}' plays no Action: bake a trace first, or choose a take for it")
    return action


def keyed_controls(obj: bpy.types.Object) -> list[Bone]:
    """How the controls that follow are keyed."""
    bones, moving = {}, set()
    for bone, constraint in constraints_of(obj):
        bones[bone.name] = bone
        if constraint.type == "COPY_LOCATION":
            moving.add(bone.name)
    return [Bone(name, bone.rotation_mode, name in moving) for name, bone in bones.items()]


def step(context: bpy.types.Context, obj: bpy.types.Object, frames: range) -> Stepping:
    """Go through the frames, telling what share is done, and return the controls' channels on them. When it ends, is
    closed or fails, the frame and the constraints are as they were."""
    scene, frame, did_follow = context.scene, context.scene.frame_current_final, follows(obj)
    names = [bone.name for bone in keyed_controls(obj)]
    locations, rotations = np.empty((len(frames), len(names), 3)), np.empty((len(frames), len(names), 4))
    set_following(obj, True)
    try:
        for index, number in enumerate(frames):
            scene.frame_set(number)
            locations[index], rotations[index] = _channels(context, obj, names)
            turned_round = (rotations[index] * rotations[max(index - 1, 0)]).sum(-1) < 0
            rotations[index, turned_round] *= -1
            yield (index + 1) / len(frames)
    finally:
        set_following(obj, did_follow)
        scene.frame_set(floor(frame), subframe=frame - floor(frame))
    return Poses(locations, rotations)


def _channels(context: bpy.types.Context, obj: bpy.types.Object, names: Sequence[str]) -> tuple[Doubles, Doubles]:
    """What the controls' own channels would have to be for their pose."""
    posed = obj.evaluated_get(context.evaluated_depsgraph_get())
    bones = [posed.pose.bones[name] for name in names]
    own = [
        posed.convert_space(pose_bone=bone, matrix=bone.matrix, from_space="POSE", to_space="LOCAL") for bone in bones
    ]
    return np.array([matrix.translation for matrix in own]), np.array([matrix.to_quaternion() for matrix in own])


def keep(context: bpy.types.Context, obj: bpy.types.Object, frames: range, poses: Poses) -> bpy.types.Action:
    """Write the channels to a new Action, with the switches as they stand, and let the rig play it and follow no
    more."""
    action = bpy.data.actions.new(f"{_motion(obj).name} on {obj.name}")
    action[BAKED] = True
    controls = make_tracks([*keyed_controls(obj), Bone("", obj.rotation_mode, False)], poses)
    write_tracks(action, obj, np.array(frames, float), [*controls, *_switch_tracks(obj)], replace=True)
    keep_former(obj, action)
    versions.assign(obj, action)
    set_following(obj, False)
    context.view_layer.update()
    return action


def _switch_tracks(obj: bpy.types.Object) -> Iterator[Track]:
    """One key for each switch that was set for the rig to follow, so that it stays with the Action."""
    for former in obj.fragmotion.control_rig.switches:
        switch = Switch(former.bone, former.name)
        value = read_switch(obj, switch)
        if value is not None:
            yield Track(switch.path, switch.bone, 0, "", np.array([[value]]), np.zeros(1, int))
