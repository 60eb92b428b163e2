# SPDX-License-Identifier: GPL-3.0-or-later
"""What someone sees who has the add-on for the first time."""

from __future__ import annotations

import bpy

from ..character.building import has_character
from ..compat.icons import own_icon
from ..operators.base.context import active_armature
from ..settings import preferences
from ..settings.drawing import draw_wrapped
from .sidebar import Sidebar


class FRAGMOTION_PT_first_steps(Sidebar, bpy.types.Panel):
    """The three clicks to a character that is driven; it goes with the first drive, or by its cross."""

    bl_idname = "FRAGMOTION_PT_first_steps"
    bl_label = "First Steps"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return bool(preferences.get(context).first_steps)

    def draw_header(self, _context: bpy.types.Context) -> None:
        self.layout.label(text="", icon_value=own_icon())

    def draw_header_preset(self, context: bpy.types.Context) -> None:
        self.layout.prop(preferences.get(context), "first_steps", text="", icon="X", emboss=False)

    def draw(self, context: bpy.types.Context) -> None:
        obj = active_armature(context)
        column = self.layout.column(align=True)
        for number, (operator, text, done) in enumerate(
            (
                ("fragmotion.add_sample", "Add Sample Character", obj is not None),
                ("fragmotion.build", "Build", obj is not None and has_character(obj)),
                ("fragmotion.drive", "Drive", False),
            ),
            1,
        ):
            column.operator(operator, text=f"{number}   {text}", icon="CHECKMARK" if done else "BLANK1")
        words = "Then press W, A, S, D. For a character of your own click it, and Import Mocap instead of 1"
        draw_wrapped(self.layout.column(align=True), context, words)


CLASSES = (FRAGMOTION_PT_first_steps,)
