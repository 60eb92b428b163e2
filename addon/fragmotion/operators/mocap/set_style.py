# SPDX-License-Identifier: GPL-3.0-or-later
"""Say what style takes are of."""

from __future__ import annotations

from typing import Any, ClassVar

import bpy
from bpy.props import StringProperty

from ...errors import UserError, reported
from ...mocap.actions import fitting
from ...mocap.styles import set_style, style_of
from ..base.context import active_armature, poll_armature


def _known(_self: object, context: bpy.types.Context, _text: str) -> list[str]:
    return sorted({style_of(action) for action in fitting(active_armature(context))} - {""})


class FRAGMOTION_OT_set_style(bpy.types.Operator):
    """Let takes be of a style"""

    bl_idname = "fragmotion.set_style"
    bl_label = "Set Style"
    bl_description = (
        "Say what style takes are of, such as tired: the ticked ones, or those whose name fits a pattern. Build makes "
        "one character that has all styles of the ticked takes"
    )
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    style: StringProperty(  # type: ignore[valid-type]
        name="Style",
        description="The style's name; empty: none",
        search=_known,
        search_options={"SUGGESTION"},
        options={"SKIP_SAVE"},
    )
    pattern: StringProperty(  # type: ignore[valid-type]
        name="Pattern",
        description="The takes whose name fits, such as *_tired_*, whatever the case; empty: the ticked takes",
        options={"SKIP_SAVE"},
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return poll_armature(cls, context)

    @reported
    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> Any:
        return context.window_manager.invoke_props_dialog(self)

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        takes = [action for action in fitting(active_armature(context)) if action.library is None]
        chosen = takes if self.pattern else [action for action in takes if action.fragmotion.use]
        count = set_style(chosen, self.style, self.pattern)
        if not count:
            raise UserError(f"No take's name fits '{self.pattern}'" if self.pattern else "No take is ticked")
        self.report({"INFO"}, f"{count} takes are {f'of style {self.style!r}' if self.style else 'of no style'} now")
        return {"FINISHED"}
