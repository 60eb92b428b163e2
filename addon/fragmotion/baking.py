# SPDX-License-Identifier: GPL-3.0-or-later
"""A trace played by the armature's character, written to an Action."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import bpy
import numpy as np

from . import versions
from .actions import BAKED, RATE
from .building import check_skeleton, load
from .core import core
from .errors import UserError, core_errors
from .posing import check_free, reset_pose
from .rigs import carriers, make_rig
from .sampling import scene_rate
from .traces import make_trace
from .writing import write_poses

if TYPE_CHECKING:
    from fragmotion_core import Character, Performance


def bake(context: bpy.types.Context, obj: bpy.types.Object, settings: Any) -> tuple[bpy.types.Action, Performance]:
    """Play the trace from where the armature stands, at the scene's rate, and let the armature play the result.

    `settings` have BakeFields. Everything is computed before the file is changed.
    """
    check_free(obj)
    character = load(obj)
    context.view_layer.update()
    rig = make_rig(obj)
    check_skeleton(obj, character.skeleton, rig.skeleton)
    moving = carriers(obj, rig)
    target = _target(obj, settings.action)
    performance = perform(context.scene, obj, character, settings)
    with core_errors(f"Armature '{obj.name}'"):
        locations, rotations = rig.channels(performance.root_positions, performance.rotations)
    times = settings.frame_start + np.arange(len(rotations), dtype=float)
    action = target or bpy.data.actions.new(settings.action or f"{obj.name} Bake")
    action[BAKED] = True
    _keep_former(obj)
    write_poses(action, obj, times, locations, rotations, moving)
    reset_pose(obj, ("location", "scale"))
    versions.assign(obj, action)
    context.view_layer.update()
    return action, performance


def perform(scene: bpy.types.Scene, obj: bpy.types.Object, character: Character, settings: Any) -> Performance:
    """The player's poses at the scene's rate, from the armature's origin, first facing its -Y (Blender's front)."""
    trace = make_trace(settings, character.space)
    player = core.Player(character, settings.seed)
    place = obj.matrix_world
    player.reset(place.translation.x, place.translation.y, place.to_euler().z + math.pi)
    with core_errors("Bake"):
        performance: Performance = player.run(trace, scene_rate(scene))
        return performance


def hindrances(obj: bpy.types.Object, bones: list[str]) -> list[str]:
    """What will move the armature beside the baked keys, in words."""
    constrained = [name for name in bones if any(not c.mute for c in obj.pose.bones[name].constraints)]
    found = [f"bone '{constrained[0]}' has constraints"] if constrained else []
    data = obj.animation_data
    if data is not None and data.use_nla and any(not track.mute for track in data.nla_tracks):
        found.append("NLA tracks play too")
    if obj.data.pose_position == "REST":
        found.append("the armature shows its rest position")
    return found


def _target(obj: bpy.types.Object, name: str) -> bpy.types.Action | None:
    """The Action of that name to write to, or None for a new one."""
    action = bpy.data.actions.get(name) if name else None
    if action is None:
        return None
    if action.library is not None:
        raise UserError(f"Action '{name}' is linked from '{action.library.filepath}': choose another name")
    if RATE in action or action.fragmotion.use:
        raise UserError(f"Action '{name}' is a take that Build learns from: choose another name, or untick it")
    if BAKED not in action and versions.count_curves(action) > 0:
        raise UserError(f"Action '{name}' holds keys that no bake made, which would be lost: choose another name")
    return action


def _keep_former(obj: bpy.types.Object) -> None:
    """Save the Action that the armature played so far from being lost when nothing else uses it."""
    former, _ = versions.assignment(obj)
    if former is not None and former.users == 1 and former.library is None:
        former.use_fake_user = True
