# SPDX-License-Identifier: GPL-3.0-or-later
"""Mend what the doctor found in the chosen take."""

from __future__ import annotations

import bpy
from bpy.props import IntProperty

from ...errors import UserError, reported
from ...mocap.actions import chosen
from ...mocap.mending import mend_finding
from ..base.context import OnTake, active_armature


class FRAGMOTION_OT_mend_finding(OnTake, bpy.types.Operator):
    """Put right in the Action what is said here; a take that is there twice is unticked"""

    bl_idname = "fragmotion.mend_finding"
    bl_label = "Mend"

    index: IntProperty(min=0, options={"HIDDEN", "SKIP_SAVE"})  # type: ignore[valid-type]

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        obj = active_armature(context)
        action = chosen(context, obj)
        findings = action.fragmotion.findings if action else ()
        if action is None or self.index >= len(findings) or not findings[self.index].mendable:
            raise UserError("There is nothing here that could be mended")
        if mend_finding(context, obj, action, findings[self.index]):
            self.report({"INFO"}, f"Mended '{action.name}'")
        else:
            self.report({"INFO"}, f"Nothing of it is left in '{action.name}' on this armature")
        return {"FINISHED"}
