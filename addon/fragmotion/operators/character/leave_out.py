# SPDX-License-Identifier: GPL-3.0-or-later
"""Leave frames of an Action out of Build, or take them in again."""

from __future__ import annotations

import bpy
from bpy.props import IntProperty

from ...errors import reported
from ...mocap.actions import chosen
from ...mocap.left_out import choose_span
from ..base.context import OnTake, active_armature


class FRAGMOTION_OT_leave_out(OnTake, bpy.types.Operator):
    """Leave out the preview range, else the frames of the selected keys, else the current frame"""

    bl_idname = "fragmotion.leave_out"
    bl_label = "Leave Out Frames"
    bl_description = (
        "Leave frames of the take out of Build, such as a calibration pose: the timeline's preview range, else the "
        "frames of the selected keys, else the current frame. The numbers can be changed in the list"
    )

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        obj = active_armature(context)
        action = chosen(context, obj)
        if action is None:
            return {"CANCELLED"}
        first, last = choose_span(context.scene, obj, action)
        span = action.fragmotion.left_out.add()
        span.first = first
        span.last = last
        self.report({"INFO"}, f"Build leaves out the frames {first} to {last} of '{action.name}'")
        return {"FINISHED"}


class FRAGMOTION_OT_take_in(OnTake, bpy.types.Operator):
    """Let Build learn from these frames again"""

    bl_idname = "fragmotion.take_in"
    bl_label = "Take In Frames"

    index: IntProperty(  # type: ignore[valid-type]
        name="Number", description="Which of the take's left-out ranges, from 0", default=0, min=0
    )

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        action = chosen(context, active_armature(context))
        if action is not None:
            action.fragmotion.left_out.remove(self.index)
        return {"FINISHED"}
