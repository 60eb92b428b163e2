# SPDX-License-Identifier: GPL-3.0-or-later
"""Bake a trace to an Action."""

from __future__ import annotations

from typing import ClassVar

import bpy

from ..baking import bake, hindrances
from ..building import has_character
from ..drawing import draw_bake
from ..errors import reported
from ..properties import BakeFields
from .context import active_armature, adopt_settings, poll_armature


class FRAGMOTION_OT_bake(BakeFields, bpy.types.Operator):
    """Bake a trace to an Action of the active armature."""

    bl_idname = "fragmotion.bake"
    bl_label = "Bake"
    bl_description = (
        "Play a trace with the armature's character and write it to an Action at the scene's frame rate. It starts at "
        "the armature's origin, facing its -Y (towards the front view)"
    )
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if not poll_armature(cls, context):
            return False
        obj = active_armature(context)
        if not has_character(obj):
            cls.poll_message_set(f"Armature '{obj.name}' has no character yet: press Build first")
        return has_character(obj)

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        obj = active_armature(context)
        adopt_settings(self, obj.fragmotion.bake, BakeFields)
        action, played = bake(context, obj, self)
        frames = len(played.root_positions)
        self.report(
            {"INFO"},
            f"Baked {frames} frames ({self.frame_start}-{self.frame_start + frames - 1}) to Action '{action.name}'; "
            f"velocity error {played.velocity_error:.2f} m/s of {played.commanded_speed:.2f} m/s",
        )
        others = hindrances(obj)
        if others:
            self.report({"WARNING"}, f"The pose will differ from the bake because of {'; '.join(others)}")
        return {"FINISHED"}

    def draw(self, _context: bpy.types.Context) -> None:
        draw_bake(self.layout, self)
