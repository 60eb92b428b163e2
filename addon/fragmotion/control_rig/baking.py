# SPDX-License-Identifier: GPL-3.0-or-later
"""What a control rig does while it follows its motion skeleton, as keys on its controls."""

from __future__ import annotations

from collections.abc import Generator, Iterator, Sequence
from math import ceil, floor
from typing import TYPE_CHECKING, NamedTuple

import bpy
import numpy as np

from ..compat import versions
from ..errors import UserError
from ..mocap.actions import BAKED
from ..rig.keys import Bone, Poses, Track, make_tracks
from ..rig.posing import visit
from ..rig.rigs import bone_path
from ..rig.writing import keep_former, write_tracks
from .binding import follows, motion_of, set_following
from .following import constraints_of
from .stretching import Stretching
from .wiring import Switch, read_switch

if TYPE_CHECKING:
    from fragmotion_core import Doubles


class Keyed(NamedTuple):
    """What is keyed of the controls: their channels, and of some by their names the scales [F,N]."""

    poses: Poses
    scaled: list[str]
    scales: Doubles


Stepping = Generator[float, None, Keyed]


def span(obj: bpy.types.Object) -> range:
    """The frames of the Action that the rig's motion skeleton plays; UserError where there is none."""
    first, last = _motion(obj).frame_range
    return range(floor(first), ceil(last) + 1)


def _motion(obj: bpy.types.Object) -> bpy.types.Action:
    """The Action that the rig's motion skeleton plays."""
    motion = motion_of(obj)
    if motion is None or obj.fragmotion.control_rig.anchors is None:
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
    did_follow = follows(obj)
    names = [bone.name for bone in keyed_controls(obj)]
    locations, rotations = np.empty((len(frames), len(names), 3)), np.empty((len(frames), len(names), 4))
    set_following(obj, True)
    stretching = Stretching(context, obj, motion_of(obj))
    scales = np.empty((len(frames), len(stretching.controls)))
    try:
        for index, _ in enumerate(visit(context.scene, frames)):
            scales[index] = stretching.settle()
            locations[index], rotations[index] = _channels(context, obj, names)
            turned_round = (rotations[index] * rotations[max(index - 1, 0)]).sum(-1) < 0
            rotations[index, turned_round] *= -1
            yield (index + 1) / len(frames)
    finally:
        stretching.restore()
        set_following(obj, did_follow)
    return Keyed(Poses(locations, rotations), stretching.controls, scales)


def _channels(context: bpy.types.Context, obj: bpy.types.Object, names: Sequence[str]) -> tuple[Doubles, Doubles]:
    """What the controls' own channels would have to be where they follow, before a solver turns them."""
    graph = context.evaluated_depsgraph_get()
    posed, anchors = obj.evaluated_get(graph), obj.fragmotion.control_rig.anchors.evaluated_get(graph)
    own = [
        posed.convert_space(
            pose_bone=posed.pose.bones[name],
            matrix=anchors.pose.bones[name].matrix,
            from_space="POSE",
            to_space="LOCAL",
        )
        for name in names
    ]
    return np.array([matrix.translation for matrix in own]), np.array([matrix.to_quaternion() for matrix in own])


def keep(context: bpy.types.Context, obj: bpy.types.Object, frames: range, keyed: Keyed) -> bpy.types.Action:
    """Write the channels to a new Action, with the switches as they stand, and let the rig play it and follow no
    more."""
    action = bpy.data.actions.new(f"{_motion(obj).name} on {obj.name}")
    action[BAKED] = True
    controls = make_tracks([*keyed_controls(obj), Bone("", obj.rotation_mode, False)], keyed.poses)
    tracks = [*controls, *_scale_tracks(keyed), *_switch_tracks(obj)]
    write_tracks(action, obj, np.array(frames, float), tracks, replace=True)
    keep_former(obj, action)
    versions.assign(obj, action)
    set_following(obj, False)
    context.view_layer.update()
    return action


def _scale_tracks(keyed: Keyed) -> Iterator[Track]:
    """Keys of the controls' scales, the same on all axes."""
    every = np.arange(len(keyed.scales), dtype=np.int32)
    for name, scales in zip(keyed.scaled, keyed.scales.T, strict=True):
        yield Track(bone_path(name, "scale"), name, 0, "", np.tile(scales[:, None], 3), every)


def _switch_tracks(obj: bpy.types.Object) -> Iterator[Track]:
    """One key for each switch that was set for the rig to follow, so that it stays with the Action."""
    for former in obj.fragmotion.control_rig.switches:
        switch = Switch(former.bone, former.name)
        value = read_switch(obj, switch)
        if value is not None:
            yield Track(switch.path, switch.bone, 0, "", np.array([[value]]), np.zeros(1, int))
