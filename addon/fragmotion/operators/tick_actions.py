# SPDX-License-Identifier: GPL-3.0-or-later
"""Tick all Actions, or none."""

from __future__ import annotations

from typing import ClassVar

import bpy
from bpy.props import BoolProperty

from ..mocap.actions import fitting
from .context import active_armature, poll_armature


class FRAGMOTION_OT_tick_actions(bpy.types.Operator):
    """Tick or untick all Actions that fit the active armature"""

    bl_idname = "fragmotion.tick_actions"
    bl_label = "Tick Actions"
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    use: BoolProperty(name="Tick", description="Tick rather than untick", default=True)  # type: ignore[valid-type]

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return poll_armature(cls, context)

    @classmethod
    def description(cls, _context: bpy.types.Context, properties: bpy.types.OperatorProperties) -> str:
        verb = "Tick" if properties.use else "Untick"
        return f"{verb} all Actions that fit the active armature"

    def execute(self, context: bpy.types.Context) -> set[str]:
        for action in fitting(active_armature(context)):
            if action.library is None:
                action.fragmotion.use = self.use
        return {"FINISHED"}
