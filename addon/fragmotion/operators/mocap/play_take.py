# SPDX-License-Identifier: GPL-3.0-or-later
"""Play the take that is chosen in the Mocap list."""

from __future__ import annotations

import bpy

from ...mocap.actions import chosen
from ...preview import previews
from ...preview.take_preview import TakePreview
from ..base.context import active_armature
from ..base.woken import Previewing


class FRAGMOTION_OT_play_take(Previewing, bpy.types.Operator):
    """Plays the chosen take; pressed again it stops."""

    bl_idname = "fragmotion.play_take"
    bl_label = "Play Take"
    bl_description = (
        "Play the take that is chosen in the list on the armature, on loop: click another one to see that. Esc, this "
        "button or a click beside the sidebar stops, and armature and scene are as before"
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if not super().poll(context):
            return False
        if previews.current is None and chosen(context, active_armature(context)) is None:
            cls.poll_message_set("No take is chosen in the list under Mocap")
            return False
        return True

    def _chosen(self, context: bpy.types.Context, obj: bpy.types.Object) -> bpy.types.Action | None:
        return chosen(context, obj)

    def _make(self, context: bpy.types.Context, obj: bpy.types.Object, chosen: bpy.types.Action) -> TakePreview:
        return TakePreview(context, obj, chosen)
