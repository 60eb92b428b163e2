# SPDX-License-Identifier: GPL-3.0-or-later
"""Add moves to the active armature, or remove them."""

from __future__ import annotations

from typing import Any, ClassVar

import bpy

from ...character.moves import add_move, remove_move
from ...errors import UserError, reported
from ...mocap.actions import chosen
from ...settings import preferences
from ..base.context import OnTake, active_armature, poll_armature


class FRAGMOTION_OT_add_move(OnTake, bpy.types.Operator):
    """Make a move of the take that is chosen under Mocap"""

    bl_idname = "fragmotion.add_move"
    bl_label = "Add Move"
    bl_description = (
        "Make a move of the take that is chosen in the list under Mocap: of the timeline's preview range, else of the "
        "whole Action. While you drive, its key starts it"
    )

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        obj, scene = active_armature(context), context.scene
        action = chosen(context, obj)
        if action is None:
            raise UserError("No take is chosen in the list under Mocap")
        frames = (scene.frame_preview_start, scene.frame_preview_end) if scene.use_preview_range else None
        row: Any = add_move(context, obj, action, frames, preferences.get(context).keys().values())
        self.report({"INFO"}, f"Added the move '{row.name}', on key {row.key}")
        return {"FINISHED"}


class FRAGMOTION_OT_remove_move(bpy.types.Operator):
    """Remove the selected move; its Action stays"""

    bl_idname = "fragmotion.remove_move"
    bl_label = "Remove Move"
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return poll_armature(cls, context) and len(active_armature(context).fragmotion.moves) > 0

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        obj = active_armature(context)
        index = obj.fragmotion.active_move
        if not 0 <= index < len(obj.fragmotion.moves):
            raise UserError("No move is selected in the list")
        name = obj.fragmotion.moves[index].name
        remove_move(context, obj, index)
        self.report({"INFO"}, f"Removed the move '{name}'")
        return {"FINISHED"}
