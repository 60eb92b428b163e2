# SPDX-License-Identifier: GPL-3.0-or-later
"""Bring another armature's Actions onto the active one."""

from __future__ import annotations

from typing import ClassVar

import bpy

from ...control_rig.binding import is_source
from ...errors import UserError
from ...jobs import Job, SteppedJob
from ...mocap.actions import ticked
from ...mocap.doctor import tell_size
from ...mocap.retargeting import retarget_actions
from ...rig.bodies import doubts_at_import
from ...rig.rigs import make_rig
from ...words import counted
from ..base import background
from ..base.background import Exclusive
from ..base.context import active_armature, check_plain, poll_armature


class FRAGMOTION_OT_retarget_actions(Exclusive, bpy.types.Operator):
    """Make the armature perform the ticked Actions of another one, whatever its bones are called"""

    bl_idname = "fragmotion.retarget_actions"
    bl_label = "Retarget Actions"
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}
    verb = "Retarget"
    patience = 0.5

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if not poll_armature(cls, context) or not background.poll_idle(cls):
            return False
        if active_armature(context).fragmotion.source is None:
            cls.poll_message_set("Choose the armature that the Actions are from")
            return False
        return True

    def _make_job(self, context: bpy.types.Context) -> Job:
        obj = active_armature(context)
        check_plain(obj)
        source = obj.fragmotion.source
        if not is_source(source, obj):
            raise UserError(f"'{source.name}' is no other armature: choose the one that the Actions are from")
        actions = ticked(source)
        if not actions:
            raise UserError(f"No Action of armature '{source.name}' is ticked: click it, and tick them")
        self._armature = obj.name
        steps = retarget_actions(context, source, obj, actions)
        return SteppedJob(f"Retargeting onto '{obj.name}'", counted(len(actions), "Action"), steps)

    def _keep(self, _context: bpy.types.Context, obj: bpy.types.Object, made: list[bpy.types.Action]) -> None:
        for doubt in (*doubts_at_import(obj), *tell_size(made, make_rig(obj).skeleton)):
            self.report({"WARNING"}, doubt)
        self.report(
            {"INFO"}, f"Armature '{obj.name}' has {counted(len(made), 'Action')} of '{obj.fragmotion.source.name}'"
        )
