# SPDX-License-Identifier: GPL-3.0-or-later
"""The sub-panel of the frames that a take leaves out."""

from __future__ import annotations

import bpy

from ..mocap.actions import chosen
from ..operators.base.context import active_armature
from .sidebar import TakePanel


class FRAGMOTION_PT_left_out(TakePanel, bpy.types.Panel):
    """Frames of the chosen take that Build leaves out."""

    bl_idname = "FRAGMOTION_PT_left_out"
    bl_label = "Left Out"

    def draw(self, context: bpy.types.Context) -> None:
        layout, action = self.layout, chosen(context, active_armature(context))
        if action is None:
            return
        layout.label(text=action.name, icon="ACTION", translate=False)
        for index, span in enumerate(action.fragmotion.left_out):
            row = layout.row(align=True)
            row.prop(span, "first", text="")
            row.prop(span, "last", text="")
            row.operator("fragmotion.take_in", text="", icon="X").index = index
        layout.operator("fragmotion.leave_out", icon="ADD")


CLASSES = (FRAGMOTION_PT_left_out,)
