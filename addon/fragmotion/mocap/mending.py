# SPDX-License-Identifier: GPL-3.0-or-later
"""What the doctor found in an Action's take, put right in the Action."""

from __future__ import annotations

from typing import TYPE_CHECKING

import bpy

from ..compat.core import core
from ..errors import UserError, core_errors
from ..rig.rigs import carriers
from ..rig.writing import write_poses
from .actions import RATE, SCENE_RATE, rate_of
from .doctor import DUPLICATE, TakeFinding
from .other_bodies import keep_own_leg
from .retargeting import FIRST_FRAME, key_times, retargeted_takes
from .sampling import rig_as_posed, sample, scene_rate

if TYPE_CHECKING:
    from fragmotion_core import Rig, Take


def mend_finding(context: bpy.types.Context, obj: bpy.types.Object, action: bpy.types.Action, row: TakeFinding) -> bool:
    """Put right in an Action of the armature what a finding says and all of its code, or untick it where it is a
    duplicate. False where nothing of it was left to mend. UserError where the Action stays as it was."""
    if row.code == DUPLICATE:
        action.fragmotion.use, row.mended = False, True
        return True
    rig = rig_as_posed(obj)
    clip = sample(context, obj, action, rig)
    take = core.Take.from_clip(clip, rig.skeleton)
    found = [each for each in core.examine([take])[0].findings if each.code == row.code and each.mendable]
    if found:
        with core_errors(f"Action '{action.name}'"):
            _write(context, obj, action, rig, take, core.mend(take, found))
    for each in action.fragmotion.findings:
        each.mended = each.mended or (each.mendable and each.code == row.code)
    return bool(found)


def _write(
    context: bpy.types.Context, obj: bpy.types.Object, action: bpy.types.Action, rig: Rig, before: Take, take: Take
) -> None:
    """Write a take over what the Action holds, from where that begins."""
    if len(action.fragmotion.left_out) and len(take.rotations) != len(before.rotations):
        raise UserError(f"Action '{action.name}' gets other frames, and some are left out: take these in first")
    brought, refused = retargeted_takes(obj, rig, [take])
    if refused:
        raise UserError(refused[0])
    locations, rotations = brought[0].channels
    start = action.frame_range[0] - FIRST_FRAME
    action[SCENE_RATE] = rate_of(action, SCENE_RATE, scene_rate(context.scene))
    action[RATE] = take.rate
    times = start + key_times(action, len(rotations))
    keep_own_leg(obj, action, rig)
    write_poses(action, obj, times, locations, rotations, carriers(obj, rig))
    context.view_layer.update()
