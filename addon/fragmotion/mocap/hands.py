# SPDX-License-Identifier: GPL-3.0-or-later
"""The hands of takes in which nothing moves the fingers."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy
import numpy as np

from ..errors import UserError
from .sampling import sample_at

if TYPE_CHECKING:
    from fragmotion_core import Clip, Doubles, Rig


def hand_pose(context: bpy.types.Context, obj: bpy.types.Object, rig: Rig) -> Doubles | None:
    """Rotations [B,4] whose fingers are those of takes that do not move them, as the armature is set to; None: they
    rest. UserError where the Action of that pose is not there."""
    settings = obj.fragmotion
    if settings.hands == "REST":
        return None
    if settings.hands == "RELAXED":
        relaxed: Doubles = rig.skeleton.relaxed_pose()
        return relaxed
    action = settings.hand_action
    if action is None:
        raise UserError("No Action with a hand pose is chosen: choose one under Build Options, or Relaxed")
    first = action.frame_range[0]
    pose: Doubles = sample_at(context, obj, action, rig, 1.0, np.array([first, first])).rotations[0]
    return pose


def with_hands(clip: Clip, rig: Rig, pose: Doubles | None) -> Clip:
    """The clip with the fingers that rest in it as in the pose."""
    return clip if pose is None else clip.with_fingers(rig.skeleton, pose)
