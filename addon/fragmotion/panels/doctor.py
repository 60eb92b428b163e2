# SPDX-License-Identifier: GPL-3.0-or-later
"""The sub-panel of what was wrong with the chosen take."""

from __future__ import annotations

import bpy

from ..mocap.actions import chosen
from ..mocap.comparing import source_of
from ..mocap.doctor import DUPLICATE, IN_PLACE
from ..operators.base.context import active_armature
from ..settings.drawing import draw_wrapped
from .sidebar import SubPanel

LIGHTS = {"error": "CANCEL", "warning": "ERROR", "info": "INFO"}


class FRAGMOTION_PT_doctor(SubPanel, bpy.types.Panel):
    """What was found in the chosen take when it was imported."""

    bl_idname = "FRAGMOTION_PT_doctor"
    bl_label = "Doctor"
    bl_parent_id = "FRAGMOTION_PT_mocap"
    folds = "mocap"

    def draw(self, context: bpy.types.Context) -> None:
        action = chosen(context, active_armature(context))
        if action is None:
            self.layout.label(text="No take is chosen", icon="INFO")
            return
        findings = action.fragmotion.findings
        if not len(findings):
            self.layout.label(text="Nothing is wrong", icon="CHECKMARK")
        for index, row in enumerate(findings):
            text = f"{row.text} (mended)" if row.mended else row.text
            column = self.layout.column(align=True)
            draw_wrapped(column, context, text, "CHECKMARK" if row.mended else LIGHTS[row.severity])
            if row.code == IN_PLACE and not row.mended:
                column.prop(action.fragmotion, "speed")
            if row.mendable and not row.mended:
                label = "Untick" if row.code == DUPLICATE else "Mend"
                column.operator("fragmotion.mend_finding", text=label, icon="MODIFIER").index = index
        if source_of(action) is not None:
            self.layout.operator("fragmotion.compare_take", icon="IMAGE_DATA")


CLASSES = (FRAGMOTION_PT_doctor,)
