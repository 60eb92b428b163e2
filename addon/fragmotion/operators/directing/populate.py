# SPDX-License-Identifier: GPL-3.0-or-later
"""Add a crowd."""

from __future__ import annotations

import bpy

from ...bake.baking import Baked
from ...bake.populating import populate, prepare
from ...control_rig.binding import rig_of
from ...jobs import Job
from ...settings.bake_fields import PopulateFields
from ...settings.drawing import draw_populate
from ...words import counted
from ..base.context import active_armature
from .bake import Baking


class FRAGMOTION_OT_populate(PopulateFields, Baking, bpy.types.Operator):
    """Copies of the active armature with its meshes, each baked with a trace of its own"""

    bl_idname = "fragmotion.populate"
    bl_label = "Populate"
    bl_description = (
        "Add copies of the armature and its meshes around it, and bake each with a trace of its own to an Action "
        "of its own, on the root bone. Meshes and armature data are shared; what else matters is set under Bake"
    )
    verb = "Populate"
    settings = "populate"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        obj = active_armature(context)
        if obj is not None and rig_of(obj) != obj:
            cls.poll_message_set(
                f"'{rig_of(obj).name}' is a control rig, and only plain armatures can be copied: press Bake to "
                "Controls, and duplicate the rig with its meshes (Shift D); each copy plays what Action you give it"
            )
            return False
        return bool(super().poll(context))

    def _prepare(self, context: bpy.types.Context, obj: bpy.types.Object) -> Job:
        return Job(f"Populating with '{obj.name}'", prepare(context, obj, self))

    def _keep(self, context: bpy.types.Context, obj: bpy.types.Object, crowd: list[Baked]) -> None:
        collection = populate(context, obj, crowd, self)
        longest = max(len(baked.classes) for baked in crowd)
        copies = "copy" if len(crowd) == 1 else "copies"
        where = f"collection '{collection.name}'"
        self.report({"INFO"}, f"Added {len(crowd)} {copies}, of {counted(longest, 'frame')}, to {where}")

    def draw(self, _context: bpy.types.Context) -> None:
        draw_populate(self.layout, self)
