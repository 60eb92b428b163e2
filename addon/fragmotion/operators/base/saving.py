# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators that ask for a file to write."""

from __future__ import annotations

from pathlib import Path
from typing import Any, ClassVar

import bpy
from bpy.props import StringProperty
from bpy_extras.io_utils import ExportHelper

from ...character.building import has_character
from ...errors import UserError, reported
from ...games.exporting import POLICY
from .context import active_armature


def poll_learned(cls: Any, context: bpy.types.Context) -> bool:
    """Whether the active armature has a character; says why not."""
    obj = active_armature(context)
    if obj is None or not has_character(obj):
        cls.poll_message_set("No armature with a character is active: press Build first")
        return False
    return True


class Saving(ExportHelper):
    """An operator that suggests a file beside the .blend."""

    def _suggestion(self, context: bpy.types.Context) -> str:
        """The file's name without its ending."""
        raise NotImplementedError

    def _path(self) -> Path:
        """The file that was chosen; UserError where none was."""
        if not self.filepath:
            raise UserError("No file is chosen")
        return Path(bpy.path.ensure_ext(bpy.path.abspath(self.filepath), self.filename_ext))

    @reported
    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        name = bpy.path.clean_name(self._suggestion(context))
        self.filepath = str(Path(bpy.data.filepath).parent / f"{name}{self.filename_ext}")
        result: set[str] = super().invoke(context, event)
        return result


class SavingCharacter(Saving):
    """An operator that saves the active armature's character as a policy file."""

    bl_options: ClassVar[set[str]] = {"REGISTER"}

    filename_ext = POLICY
    filter_glob: StringProperty(default=f"*{POLICY}", options={"HIDDEN"})  # type: ignore[valid-type]

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return poll_learned(cls, context)

    def _suggestion(self, context: bpy.types.Context) -> str:
        return str(active_armature(context).name)
