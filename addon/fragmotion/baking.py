# SPDX-License-Identifier: GPL-3.0-or-later
"""A trace played by the armature's character, written to an Action."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import bpy
import numpy as np

from . import versions
from .actions import BAKED, RATE
from .building import load
from .core import core
from .errors import UserError, core_errors
from .movers import movers
from .posing import check_free, reset_pose
from .rigs import carriers, make_rig
from .sampling import scene_rate
from .skeletons import difference
from .traces import make_trace
from .writing import write_poses

if TYPE_CHECKING:
    from fragmotion_core import Character, Performance, Rig


def bake(context: bpy.types.Context, obj: bpy.types.Object, settings: Any) -> tuple[bpy.types.Action, Performance]:
    """Play the trace from where the armature stands, at the scene's rate, and let the armature play the result.

    `settings` have BakeFields. Everything is computed before the file is changed.
    """
    check_free(obj)
    character = load(obj)
    context.view_layer.update()
    rig = make_rig(obj)
    _check_skeleton(obj, character, rig)
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
    if settings.fit_end:
        context.scene.frame_end = max(context.scene.frame_end, int(times[-1]))
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


def hindrances(obj: bpy.types.Object) -> list[str]:
    """What will show the armature otherwise than the baked keys say, in words."""
    data = obj.animation_data
    tracks = data.nla_tracks if data is not None and data.use_nla else ()
    playing = [f"NLA track '{track.name}'" for track in tracks if not track.mute]
    resting = ["the armature's Rest Position"] if obj.data.pose_position == "REST" else []
    return [*movers(obj), *playing[:1], *resting]


def _check_skeleton(obj: bpy.types.Object, character: Character, rig: Rig) -> None:
    """UserError where the armature's bones are not those that the character was built on."""
    changed = difference(character.skeleton, rig.skeleton)
    if changed:
        raise UserError(f"Armature '{obj.name}' has changed since Build: {changed}. Undo that, or press Build again")


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
