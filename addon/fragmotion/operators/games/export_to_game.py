# SPDX-License-Identifier: GPL-3.0-or-later
"""Export the active armature's character for a game."""

from __future__ import annotations

from typing import Any, ClassVar

import bpy
from bpy.props import StringProperty

from ...character.building import has_character
from ...character.moves import bring_up_to_date
from ...errors import reported
from ...games.exporting import POLICY, export
from ..base.context import active_armature
from ..base.saving import Saving

_NEXT = (
    "Browser: drop both on the live page, or press Open in Browser",
    "Godot 4: put both into the project and add a FragmotionCharacter (games/godot/README.md)",
    "Unity, C#: games/csharp/README.md",
    "Your own engine in C or C++: docs/game.md; a small game to copy from: games/raylib",
)


class FRAGMOTION_OT_export_to_game(Saving, bpy.types.Operator):
    """Save the character and its mesh side by side, as .policy and .glb, for the web, Godot or your own engine"""

    bl_idname = "fragmotion.export_to_game"
    bl_label = "Export to Game"

    bl_options: ClassVar[set[str]] = {"REGISTER"}

    filename_ext = POLICY
    filter_glob: StringProperty(default=f"*{POLICY}", options={"HIDDEN"})  # type: ignore[valid-type]

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
