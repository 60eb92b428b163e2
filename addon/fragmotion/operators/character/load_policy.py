# SPDX-License-Identifier: GPL-3.0-or-later
"""Give the active armature the character of a policy file."""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar

import bpy
from bpy.props import StringProperty
from bpy_extras.io_utils import ImportHelper

from ...character.building import load_policy
from ...character.moves import list_moves
from ...errors import UserError, reported
from ...games.exporting import POLICY
from ...settings import preferences
from ..base.background import poll_idle
from ..base.context import active_armature, poll_armature


class FRAGMOTION_OT_load_policy(ImportHelper, bpy.types.Operator):
    """Give the armature the character of a policy file that was built for the same bones"""

    bl_idname = "fragmotion.load_policy"
    bl_label = "Load Policy"
    bl_options: ClassVar[set[str]] = {"UNDO"}

    filename_ext = POLICY
    filter_glob: StringProperty(default=f"*{POLICY}", options={"HIDDEN"})  # type: ignore[valid-type]

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return poll_idle(cls) and poll_armature(cls, context)

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        if not self.filepath:
            raise UserError("No file is chosen")
        obj, path = active_armature(context), Path(bpy.path.abspath(self.filepath))
        load_policy(context, obj, path)
        list_moves(obj, preferences.get(context).keys().values())
        figures = obj.fragmotion.figures
        self.report(
            {"INFO"},
            f"Armature '{obj.name}' has the character of '{path.name}': {figures.fragments} fragments in "
            f"{figures.classes} classes",
        )
        return {"FINISHED"}
