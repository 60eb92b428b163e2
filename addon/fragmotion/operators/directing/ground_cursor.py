# SPDX-License-Identifier: GPL-3.0-or-later
"""Put the 3D cursor on the ground."""

from __future__ import annotations

from typing import Any, ClassVar

import bpy

from ...errors import UserError, reported
from ...ground.meshes import find_ground
from ...paths.drawing import ground_behind_cursor
from ..base.context import active_armature, poll_armature


class FRAGMOTION_OT_ground_cursor(bpy.types.Operator):
    """The 3D cursor goes to where this view shows it on the ground: a click into the air leaves it above or below"""

    bl_idname = "fragmotion.ground_cursor"
    bl_label = "Cursor to Ground"
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls: Any, context: bpy.types.Context) -> bool:
        if context.area is None or context.area.type != "VIEW_3D":
            cls.poll_message_set("It needs a 3D viewport, which shows where the cursor is")
            return False
        return poll_armature(cls, context)

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        place = ground_behind_cursor(context, find_ground(context, active_armature(context)))
        if place is None:
            raise UserError("This view shows no ground behind the 3D cursor: look from further above")
        context.scene.cursor.location = place
        return {"FINISHED"}
