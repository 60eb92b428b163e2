# SPDX-License-Identifier: GPL-3.0-or-later
"""Export the active armature's character for a game."""

from __future__ import annotations

from typing import Any

import bpy

from ...character.moves import bring_up_to_date
from ...errors import reported
from ...games.exporting import export
from ..base.context import active_armature
from ..base.saving import SavingCharacter

_NEXT = (
    "Browser: drop both on the live page, or press Open in Browser",
    "Godot 4: put both into the project and add a FragmotionCharacter (games/godot/README.md)",
    "Unity, C#: games/csharp/README.md",
    "Your own engine in C or C++: docs/game.md; a small game to copy from: games/raylib",
)


class FRAGMOTION_OT_export_to_game(SavingCharacter, bpy.types.Operator):
    """Save the character and its mesh side by side, as .policy and .glb, for the web, Godot or your own engine"""

    bl_idname = "fragmotion.export_to_game"
    bl_label = "Export to Game"

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        path, obj = self._path(), active_armature(context)
        bring_up_to_date(context, obj)
        policy, mesh = export(context, obj, path)
        self.report({"INFO"}, f"Saved '{policy}' and '{mesh.name}' beside it")
        if not bpy.app.background:
            context.window_manager.popup_menu(_draw_next, title=f"{policy.name} and {mesh.name} are saved. Next:")
        return {"FINISHED"}


def _draw_next(menu: Any, _context: bpy.types.Context) -> None:
    for line in _NEXT:
        menu.layout.label(text=line)
