# SPDX-License-Identifier: GPL-3.0-or-later
"""The Storyboard panel of the sidebar."""

from __future__ import annotations

from typing import Any

import bpy

from ..operators.base.context import active_armature
from ..settings.drawing import aligned, draw_look, draw_wrapped
from .sidebar import SubPanel

_ROWS = 4


class FRAGMOTION_UL_story(bpy.types.UIList):
    """The storyboard's entries: each with its name, its move and its frame."""

    bl_idname = "FRAGMOTION_UL_story"

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
        split = layout.split(factor=0.45)
        split.prop(item, "name", text="", emboss=False)
        rest = split.split(factor=0.5)
        rest.label(text=item.move, translate=False)
        frame = rest.row()
        frame.alignment = "RIGHT"
        frame.label(text=str(item.frame), translate=False)  # a field would show its first digit alone


class FRAGMOTION_PT_storyboard(SubPanel, bpy.types.Panel):
    """Where the character is to be by when, and what it does there."""

    bl_idname = "FRAGMOTION_PT_storyboard"
    bl_label = "Storyboard"

    def draw(self, context: bpy.types.Context) -> None:
        layout, settings = self.layout, active_armature(context).fragmotion
        row = layout.row()
        row.template_list("FRAGMOTION_UL_story", "", settings, "story", settings, "active_beat", rows=_ROWS)
        buttons = row.column(align=True)
        buttons.operator("fragmotion.add_beat", text="", icon="ADD")
        buttons.operator("fragmotion.remove_beat", text="", icon="REMOVE")
        if not len(settings.story):
            draw_wrapped(layout.column(align=True), context, "Press + and click on the ground", "INFO")
        if 0 <= settings.active_beat < len(settings.story):
            beat, column = settings.story[settings.active_beat], aligned(layout)
            column.prop(beat, "frame")
            column.prop(beat, "place")
            column.prop(beat, "move")
            if len(settings.figures.styles):
                column.prop(beat, "style")
            draw_look(column, beat.look)
        layout.operator("fragmotion.record_story", icon="SEQUENCE")


CLASSES = (FRAGMOTION_UL_story, FRAGMOTION_PT_storyboard)
