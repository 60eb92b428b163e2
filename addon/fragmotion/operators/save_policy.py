# SPDX-License-Identifier: GPL-3.0-or-later
"""Save the active armature's character as a policy file."""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar

import bpy
from bpy.props import StringProperty
from bpy_extras.io_utils import ExportHelper

from ..building import has_character, save_policy
from ..errors import UserError, reported
from .context import active_armature

EXTENSION = ".policy"


class FRAGMOTION_OT_save_policy(ExportHelper, bpy.types.Operator):
    """Save the character as a policy file, for another .blend or a program of yours"""

    bl_idname = "fragmotion.save_policy"
    bl_label = "Save Policy"

    bl_options: ClassVar[set[str]] = {"REGISTER"}

    filename_ext = EXTENSION
    filter_glob: StringProperty(default=f"*{EXTENSION}", options={"HIDDEN"})  # type: ignore[valid-type]

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        obj = active_armature(context)
        if obj is None or not has_character(obj):
            cls.poll_message_set("No armature with a character is active: press Build first")
            return False
        return True

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        name = bpy.path.clean_name(active_armature(context).name)
        self.filepath = str(Path(bpy.data.filepath).parent / f"{name}{EXTENSION}")
        result: set[str] = super().invoke(context, event)
        return result

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        if not self.filepath:
            raise UserError("No file is chosen")
        path = Path(bpy.path.ensure_ext(bpy.path.abspath(self.filepath), EXTENSION))
        save_policy(active_armature(context), path)
        self.report({"INFO"}, f"Saved '{path}' ({path.stat().st_size / 1e6:.1f} MB)")
        return {"FINISHED"}
