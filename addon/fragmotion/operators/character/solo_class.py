# SPDX-License-Identifier: GPL-3.0-or-later
"""Preview one class in the viewport."""

from __future__ import annotations

import bpy

from ...character import classes
from ...preview import previews
from ...preview.class_preview import ClassPreview
from ..base.woken import Previewing
from .force_class import poll_class


class FRAGMOTION_OT_solo_class(Previewing, bpy.types.Operator):
    """Plays the chosen class alone, fragment after fragment; pressed again it stops."""

    bl_idname = "fragmotion.solo_class"
    bl_label = "Preview Class"
    bl_description = (
        "Play the fragments of the class that is chosen in the list on the armature, one after another, from where it "
        "stands: click another one to see that. Esc, this button or a click beside the sidebar stops, and armature and "
        "scene are as before"
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return super().poll(context) and (previews.current is not None or poll_class(cls, context))

    def _chosen(self, context: bpy.types.Context, obj: bpy.types.Object) -> tuple[int, int] | None:
        number: int = context.window_manager.fragmotion.active_class
        return (number, classes.shown_style(obj.fragmotion.figures)) if number < len(classes.shown_rows(obj)) else None

    def _make(self, context: bpy.types.Context, obj: bpy.types.Object, chosen: tuple[int, int]) -> ClassPreview:
        return ClassPreview(context, obj, *chosen)
