# SPDX-License-Identifier: GPL-3.0-or-later
"""Bring another armature's Actions onto the active one."""

from __future__ import annotations

from typing import ClassVar

import bpy

from ...control_rig.binding import is_source
from ...errors import UserError, reported
from ...mocap.actions import ticked
from ...mocap.retargeting import retarget_actions
from ..base.context import active_armature, check_plain, poll_armature, progress_shown


class FRAGMOTION_OT_retarget_actions(bpy.types.Operator):
    """Make the armature perform the ticked Actions of another one, whatever its bones are called"""

    bl_idname = "fragmotion.retarget_actions"
    bl_label = "Retarget Actions"
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if not poll_armature(cls, context):
            return False
        if active_armature(context).fragmotion.source is None:
            cls.poll_message_set("Choose the armature that the Actions are from")
            return False
        return True

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        obj = active_armature(context)
        check_plain(obj)
        source = obj.fragmotion.source
        if not is_source(source, obj):
            raise UserError(f"'{source.name}' is no other armature: choose the one that the Actions are from")
        actions = ticked(source)
        if not actions:
            raise UserError(f"No Action of armature '{source.name}' is ticked: click it, and tick them")
        with progress_shown(context) as advance:
            made = retarget_actions(context, source, obj, actions, advance)
        self.report({"INFO"}, f"Armature '{obj.name}' has {len(made)} Actions of '{source.name}'")
        return {"FINISHED"}
