# SPDX-License-Identifier: GPL-3.0-or-later
"""The Moves panel of the sidebar."""

from __future__ import annotations

from typing import Any

import bpy

from ..character.moves import key_trouble
from ..operators.base.context import active_armature
from ..settings import preferences
from ..settings.drawing import aligned
from .sidebar import Sidebar

_ROWS = 3


class FRAGMOTION_UL_moves(bpy.types.UIList):
    """The armature's moves, each with its name and its key."""

    bl_idname = "FRAGMOTION_UL_moves"

    def draw_item(
        self,
        _context: bpy.types.Context,
        layout: bpy.types.UILayout,
        _data: object,
        item: Any,
        _icon: int,
        _active_data: object,
        _active_name: str,
    ) -> None:
        split = layout.split(factor=0.7)
        split.prop(item, "name", text="", emboss=False)
        split.prop(item, "key", text="", event=True)


class FRAGMOTION_PT_moves(Sidebar, bpy.types.Panel):
    """What is not locomotion: waves, punches, sitting down."""

    bl_idname = "FRAGMOTION_PT_moves"
    bl_label = "Moves"
    bl_options = {"DEFAULT_CLOSED"}  # noqa: RUF012

    def draw(self, context: bpy.types.Context) -> None:
        layout, obj = self.layout, active_armature(context)
        if obj is None:
            layout.label(text="No armature is active", icon="INFO")
            return
        settings = obj.fragmotion
        row = layout.row()
        row.template_list("FRAGMOTION_UL_moves", "", settings, "moves", settings, "active_move", rows=_ROWS)
        buttons = row.column(align=True)
        buttons.operator("fragmotion.add_move", text="", icon="ADD")
        buttons.operator("fragmotion.remove_move", text="", icon="REMOVE")
        keys = {key: action for action, key in preferences.get(context).keys().items()}
        trouble = key_trouble(settings.moves, keys)
        if trouble:
            layout.label(text=trouble, icon="ERROR", translate=False)
        if 0 <= settings.active_move < len(settings.moves):
            _draw_move(layout, settings.moves[settings.active_move])


def _draw_move(layout: bpy.types.UILayout, move: Any) -> None:
    column = aligned(layout)
    column.prop(move, "action")
    column.prop(move, "whole")
    if not move.whole:
        _draw_range(column, move, "first", "last")
    column.prop(move, "upper_body")
    column.prop(move, "wait")
    column.prop(move, "button")
    column.prop(move, "loop")
    if move.loop and move.action is not None:
        _draw_range(column, move, "loop_first", "loop_last")


def _draw_range(column: bpy.types.UILayout, move: Any, first: str, last: str) -> None:
    row = column.row(align=True)
    row.prop(move, first, text="Frames")
    row.prop(move, last, text="")


CLASSES = (FRAGMOTION_UL_moves, FRAGMOTION_PT_moves)
