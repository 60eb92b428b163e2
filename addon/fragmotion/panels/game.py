# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel of what leads out of Blender."""

from __future__ import annotations

from typing import ClassVar

import bpy

from .sidebar import Sidebar


class FRAGMOTION_PT_game(Sidebar, bpy.types.Panel):
    """The character in a game, and in a browser."""

    bl_idname = "FRAGMOTION_PT_game"
    bl_label = "Game"
    bl_options: ClassVar[set[str]] = {"DEFAULT_CLOSED"}

    def draw(self, _context: bpy.types.Context) -> None:
        column = self.layout.column(align=True)
        column.operator("fragmotion.export_to_game", icon="EXPORT")
        column.operator("fragmotion.open_in_browser", icon="URL")


CLASSES = (FRAGMOTION_PT_game,)
