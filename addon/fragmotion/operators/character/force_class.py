# SPDX-License-Identifier: GPL-3.0-or-later
"""Let the drive in progress play a class now."""

from __future__ import annotations

from typing import Any, ClassVar

import bpy
from bpy.props import IntProperty

from ...character import classes
from ...errors import UserError, reported
from ..base.context import active_armature


def poll_class(cls: Any, context: bpy.types.Context) -> bool:
    """Whether a class is chosen in the panel's list; says why not."""
    obj = active_armature(context)
    if obj is None or not classes.shown_rows(obj):
        cls.poll_message_set("No armature with a character is active: press Build first")
    elif context.window_manager.fragmotion.active_class >= len(classes.shown_rows(obj)):
        cls.poll_message_set("No class is chosen in the list")
    else:
        return True
    return False


class FRAGMOTION_OT_force_class(bpy.types.Operator):
    """Play a class now while driving"""

    bl_idname = "fragmotion.force_class"
    bl_label = "Force"
    bl_description = (
        "While driving, play the chosen class now, also one that is left out: a wave, a kick. Then the policy goes on"
    )
    bl_options: ClassVar[set[str]] = {"REGISTER"}

    number: IntProperty(  # type: ignore[valid-type]
        name="Class", description="Number of the class, from 0; -1 for the one chosen in the list", default=-1, min=-1
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if not poll_class(cls, context):
            return False
        obj = active_armature(context)
        drive, shown = classes.driven(obj), classes.shown_style(obj.fragmotion.figures)
        if drive is None:
            cls.poll_message_set(f"Armature '{obj.name}' is not being driven: start Drive first")
        elif drive.player.playing_style != shown:
            cls.poll_message_set("The list shows the classes of another style than plays: choose that style above it")
        return drive is not None and drive.player.playing_style == shown

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        obj = active_armature(context)
        number = self.number if self.number >= 0 else context.window_manager.fragmotion.active_class
        if number >= len(classes.shown_rows(obj)):
            raise UserError(f"Armature '{obj.name}' has no class {number}")
        classes.force(obj, number)
        return {"FINISHED"}
