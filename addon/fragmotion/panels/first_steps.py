# SPDX-License-Identifier: GPL-3.0-or-later
"""What someone sees who has the add-on for the first time."""

from __future__ import annotations

import bpy

from ..character.building import has_character
from ..compat.icons import own_icon
from ..drive import session
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
        armatures = [obj for obj in context.scene.objects if obj.type == "ARMATURE"]
        built = any(map(has_character, armatures))
        column = self.layout.column(align=True)
        for number, (operator, text, done) in enumerate(
            (
                ("fragmotion.add_sample", "Add Sample Character", bool(armatures)),
                ("fragmotion.build", "Build", built),
                ("fragmotion.drive", "Drive", session.current is not None),
            ),
            1,
        ):
            column.operator(operator, text=f"{number}   {text}", icon="CHECKMARK" if done else "BLANK1")
        words = "Then press W, A, S, D"
        if not built:
            words += ". For a character of your own click it, and Import Mocap instead of 1"
        draw_wrapped(self.layout.column(align=True), context, words)


CLASSES = (FRAGMOTION_PT_first_steps,)
