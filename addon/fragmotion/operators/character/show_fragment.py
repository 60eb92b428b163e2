# SPDX-License-Identifier: GPL-3.0-or-later
"""Show where a fragment was cut from."""

from __future__ import annotations

from typing import ClassVar

import bpy
from bpy.props import FloatProperty, StringProperty

from ...character.inspector import show
from ...errors import UserError, reported
from ...rig.posing import check_free
from ...rig.writing import keep_former
from ..base.context import active_armature, poll_armature


class FRAGMOTION_OT_show_fragment(bpy.types.Operator):
    """Let the armature play this take, and go to the frame where the fragment begins"""

    bl_idname = "fragmotion.show_fragment"
    bl_label = "Show Fragment"
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    action: StringProperty(name="Action", description="The take that the fragment was cut from")  # type: ignore[valid-type]
    frame: FloatProperty(name="Frame", description="The scene frame to go to")  # type: ignore[valid-type]

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return poll_armature(cls, context)

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        action = bpy.data.actions.get(self.action)
        if action is None:
            raise UserError(f"There is no Action '{self.action}' any more")
        obj = active_armature(context)
        check_free(obj)
        keep_former(obj, action)
        show(obj, context.scene, action, self.frame)
        return {"FINISHED"}
