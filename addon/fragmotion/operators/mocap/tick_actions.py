# SPDX-License-Identifier: GPL-3.0-or-later
"""Tick all Actions, or none."""

from __future__ import annotations

from typing import ClassVar

import bpy
from bpy.props import BoolProperty, StringProperty

from ...errors import reported
from ...mocap.actions import fitting, is_found
from ..base.context import active_armature, poll_armature


class FRAGMOTION_OT_tick_actions(bpy.types.Operator):
    """Tick or untick all Actions that fit the active armature, or those of them that the list shows. A move's Action is
    no locomotion, and is not ticked"""

    bl_idname = "fragmotion.tick_actions"
    bl_label = "Tick Actions"
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    use: BoolProperty(name="Tick", description="Tick rather than untick", default=True)  # type: ignore[valid-type]

    search: StringProperty(  # type: ignore[valid-type]
        name="Search",
        description="Only those with this in their name, whatever the case; empty for all",
        options={"SKIP_SAVE"},
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return poll_armature(cls, context)

    @classmethod
    def description(cls, _context: bpy.types.Context, properties: bpy.types.OperatorProperties) -> str:
        verb = "Tick" if properties.use else "Untick"
        those = f" and have '{properties.search}' in their name" if properties.search else ""
        but = ", but for those of its moves" if properties.use else ""
        return f"{verb} all Actions that fit the active armature{those}{but}"

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        obj = active_armature(context)
        moves = {row.action for row in obj.fragmotion.moves} if self.use else ()
        for action in fitting(obj):
            if action not in moves and action.library is None and is_found(action, self.search):
                action.fragmotion.use = self.use
        return {"FINISHED"}
