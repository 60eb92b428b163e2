# SPDX-License-Identifier: GPL-3.0-or-later
"""Leave frames of an Action out of Build, or take them in again."""

from __future__ import annotations

from typing import Any, ClassVar

import bpy
from bpy.props import IntProperty

from ..mocap.actions import chosen
from ..mocap.left_out import choose_span
from .context import active_armature, poll_armature


class _OnTake:
    """An operator on the take that is chosen in the panel's list."""

    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls: Any, context: bpy.types.Context) -> bool:
        if not poll_armature(cls, context):
            return False
        action = chosen(context, active_armature(context))
        if action is None:
            cls.poll_message_set("No take is chosen in the list under Mocap")
        elif action.library is not None:
            cls.poll_message_set(f"Action '{action.name}' is linked from another file")
        return action is not None and action.library is None


class FRAGMOTION_OT_leave_out(_OnTake, bpy.types.Operator):
    """Leave out the preview range, else the frames of the selected keys, else the current frame"""

    bl_idname = "fragmotion.leave_out"
    bl_label = "Leave Out Frames"
    bl_description = (
        "Leave frames of the take out of Build, such as a calibration pose: the timeline's preview range, else the "
        "frames of the selected keys, else the current frame. The numbers can be changed in the list"
    )

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


class FRAGMOTION_OT_take_in(_OnTake, bpy.types.Operator):
    """Let Build learn from these frames again"""

    bl_idname = "fragmotion.take_in"
    bl_label = "Take In Frames"

    index: IntProperty(  # type: ignore[valid-type]
        name="Number", description="Which of the take's left-out ranges, from 0", default=0, min=0
    )

    def execute(self, context: bpy.types.Context) -> set[str]:
        action = chosen(context, active_armature(context))
        if action is not None:
            action.fragmotion.left_out.remove(self.index)
        return {"FINISHED"}
