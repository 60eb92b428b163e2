# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators that ask for a file to write."""

from __future__ import annotations

from pathlib import Path

import bpy
from bpy_extras.io_utils import ExportHelper

from ...errors import UserError, reported


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
