# SPDX-License-Identifier: GPL-3.0-or-later
"""The Path panel of the sidebar."""

from __future__ import annotations

import bpy

from ..operators.base.context import active_armature
from ..settings.drawing import aligned
from ..settings.path_fields import PathSettings
from .sidebar import SubPanel


class FRAGMOTION_PT_path(SubPanel, bpy.types.Panel):
    """Where the character goes without a stick."""

    bl_idname = "FRAGMOTION_PT_path"
    bl_label = "Path"

    def draw(self, context: bpy.types.Context) -> None:
        settings = active_armature(context).fragmotion.path
        column = aligned(self.layout)
        _draw_source(column, settings)
        column.separator()
        _draw_pace(column, settings)
        column.separator()
        _draw_facing(column, settings)
        column.prop(settings, "end")
        if settings.end != "STAND":
            column.prop(settings, "seconds")
        column.prop(settings, "seed")
        self.layout.operator("fragmotion.follow_path", icon="CURVE_PATH")


def _draw_source(column: bpy.types.UILayout, settings: PathSettings) -> None:
    column.prop(settings, "source")
    if settings.source == "CURVE":
        row = column.row(align=True)
        row.use_property_split = False  # a name takes all of the width
        row.prop(settings, "curve", text="")
        row.operator("fragmotion.draw_path", text="" if settings.curve else "Draw", icon="GREASEPENCIL")
    elif settings.source == "COLLECTION":
        column.prop(settings, "collection")
    column.prop(settings, "start")


def _draw_pace(column: bpy.types.UILayout, settings: PathSettings) -> None:
    column.prop(settings, "speed_by")
    column.prop(settings, "arrive_frame" if settings.speed_by == "ARRIVE" else "speed")


def _draw_facing(column: bpy.types.UILayout, settings: PathSettings) -> None:
    column.prop(settings, "facing")
    if settings.facing == "FIXED":
        column.prop(settings, "heading")
    elif settings.facing == "OBJECT":
        column.prop(settings, "look_at")


CLASSES = (FRAGMOTION_PT_path,)
