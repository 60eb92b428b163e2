# SPDX-License-Identifier: GPL-3.0-or-later
"""Add a crowd."""

from __future__ import annotations

from typing import ClassVar

import bpy

from ..baking import Baked
from ..drawing import draw_populate
from ..jobs import Job
from ..populating import populate, prepare
from ..properties import PopulateFields
from .background import Background
from .bake import poll_bake
from .context import active_armature, adopt_settings


class FRAGMOTION_OT_populate(PopulateFields, Background, bpy.types.Operator):
    """Copies of the active armature with its meshes, each baked with a trace of its own"""

    bl_idname = "fragmotion.populate"
    bl_label = "Populate"
    bl_description = (
        "Add copies of the armature and its meshes around it, and bake each with a trace of its own to an Action "
        "of its own, on the root bone. Meshes and armature data are shared; what else matters is set under Bake"
    )
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}
    verb = "Populate"
    patience = 0.5

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return poll_bake(cls, context)

    def _prepare(self, context: bpy.types.Context) -> Job:
        obj = active_armature(context)
        adopt_settings(self, obj.fragmotion.populate, PopulateFields)
        self._armature = obj.name
        return Job(f"Populating with '{obj.name}'", prepare(context, obj, self))

    def _keep(self, context: bpy.types.Context, obj: bpy.types.Object, crowd: list[Baked]) -> None:
        collection = populate(context, obj, crowd, self)
        longest = max(len(baked.classes) for baked in crowd)
        self.report({"INFO"}, f"Added {len(crowd)} copies, of {longest} frames, to collection '{collection.name}'")

    def draw(self, _context: bpy.types.Context) -> None:
        draw_populate(self.layout, self)
