# SPDX-License-Identifier: GPL-3.0-or-later
"""Bake a trace to an Action."""

from __future__ import annotations

from typing import ClassVar

import bpy

from ..baking import hindrances, prepare
from ..building import has_character
from ..drawing import draw_bake, draw_bake_options
from ..errors import core_errors, reported
from ..jobs import Job
from ..properties import BakeFields
from ..targets import write
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
        prepared = prepare(context, obj, self)
        job, manager = Job(f"Baking '{obj.name}'", prepared.task), context.window_manager
        manager.progress_begin(0, 100)
        try:
            job.run(lambda fraction: manager.progress_update(100 * fraction))
        finally:
            manager.progress_end()
        with core_errors("Bake"):
            baked = job.result()
        action = write(context, obj, prepared.target, baked.tracks, baked.classes, self)
        first, frames = prepared.target.first, len(baked.classes)
        self.report(
            {"INFO"},
            f"Baked {frames} frames ({first}-{first + frames - 1}) to Action '{action.name}'; {baked.remark}",
        )
        others = hindrances(obj, own_strip=self.target == "NLA")
        if others:
            self.report({"WARNING"}, f"The pose will differ from the bake because of {'; '.join(others)}")
        return {"FINISHED"}

    def draw(self, _context: bpy.types.Context) -> None:
        draw_bake(self.layout, self)
        draw_bake_options(self.layout, self)
