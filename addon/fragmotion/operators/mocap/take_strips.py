# SPDX-License-Identifier: GPL-3.0-or-later
"""Make takes of the active armature's NLA strips."""

from __future__ import annotations

from typing import ClassVar

import bpy

from ...errors import reported
from ...mocap.strips import actions_of_strips, strips_of
from ...words import counted
from ..base.context import active_armature, check_plain, poll_armature


class FRAGMOTION_OT_take_strips(bpy.types.Operator):
    """Make an Action of each NLA strip as it plays: scaled, repeated, reversed, cut. The strips' own Actions are
    unticked"""

    bl_idname = "fragmotion.take_strips"
    bl_label = "Takes of NLA Strips"
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if not poll_armature(cls, context):
            return False
        if not strips_of(active_armature(context)):
            cls.poll_message_set("No NLA track of the armature has a strip of an Action that fits it")
            return False
        return True

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        obj = active_armature(context)
        check_plain(obj)
        made = actions_of_strips(context, obj)
        self.report({"INFO"}, f"Armature '{obj.name}' has {counted(len(made), 'Action')} of its NLA strips")
        return {"FINISHED"}
