# SPDX-License-Identifier: GPL-3.0-or-later
"""Show a take beside what was made of it."""

from __future__ import annotations

import bpy

from ...errors import reported
from ...mocap.actions import chosen
from ...mocap.comparing import compare, source_of
from ..base.context import OnTake, active_armature
from ..base.editors import ensure_editor


class FRAGMOTION_OT_compare_take(OnTake, bpy.types.Operator):
    """Show three moments of the take and, beside each, what the armature makes of it, as an image"""

    bl_idname = "fragmotion.compare_take"
    bl_label = "Compare with Source"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if not super().poll(context):
            return False
        if source_of(chosen(context, active_armature(context))) is None:
            cls.poll_message_set("This take was not brought over from another body")
            return False
        return True

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        obj = active_armature(context)
        image = compare(context, obj, chosen(context, obj))
        area = ensure_editor(context, "IMAGE_EDITOR")
        if area is not None:
            area.spaces.active.image = image
        self.report({"INFO"}, f"Image '{image.name}': the take in blue, '{obj.name}' in orange")
        return {"FINISHED"}
