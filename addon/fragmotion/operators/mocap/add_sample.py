# SPDX-License-Identifier: GPL-3.0-or-later
"""Add the sample character."""

from __future__ import annotations

from typing import ClassVar

import bpy

from ...drive import session
from ...errors import reported
from ...mocap.actions import fitting
from ...mocap.sample import add_sample
from ..base.framing import frame_selected


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
        frame_selected(context)
        self.report({"INFO"}, f"Added '{obj.name}' with {len(fitting(obj))} Actions: press Build, then Drive")
        return {"FINISHED"}
