# SPDX-License-Identifier: GPL-3.0-or-later
"""Save the active armature's character as a policy file."""

from __future__ import annotations

from typing import ClassVar

import bpy
from bpy.props import StringProperty

from ...character.building import has_character, save_policy
from ...character.moves import bring_up_to_date
from ...errors import reported
from ..base.context import active_armature
from ..base.saving import Saving

EXTENSION = ".policy"


class FRAGMOTION_OT_save_policy(Saving, bpy.types.Operator):
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

    def _suggestion(self, context: bpy.types.Context) -> str:
        return str(active_armature(context).name)

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        path = self._path()
        obj = active_armature(context)
        bring_up_to_date(context, obj)
        save_policy(obj, path)
        self.report({"INFO"}, f"Saved '{path}' ({path.stat().st_size / 1e6:.1f} MB)")
        return {"FINISHED"}
