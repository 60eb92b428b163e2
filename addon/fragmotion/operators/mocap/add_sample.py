# SPDX-License-Identifier: GPL-3.0-or-later
"""Add the sample character."""

from __future__ import annotations

from typing import ClassVar

import bpy

from ...drive import session
from ...drive.hud import views
from ...errors import reported
from ...mocap.actions import fitting
from ...mocap.sample import add_sample


def _frame(context: bpy.types.Context) -> None:
    """Have the view in which the button was pressed show what is selected, if there is any."""
    area = context.area
    if area is not None and area.type == "VIEW_3D":
        with context.temp_override(area=area, region=views.window_region(area)):
            bpy.ops.view3d.view_selected()


class FRAGMOTION_OT_add_sample(bpy.types.Operator):
    """Add a mannequin with Actions of standing, walks, runs and jumps, to try Build and Drive with"""

    bl_idname = "fragmotion.add_sample"
    bl_label = "Add Sample Character"
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, _context: bpy.types.Context) -> bool:
        return session.current is None

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        obj = add_sample(context)
        _frame(context)
        self.report({"INFO"}, f"Added '{obj.name}' with {len(fitting(obj))} Actions: press Build, then Drive")
        return {"FINISHED"}
