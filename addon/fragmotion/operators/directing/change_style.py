# SPDX-License-Identifier: GPL-3.0-or-later
"""Change the style of the character that is driven."""

from __future__ import annotations

import bpy
from bpy.props import IntProperty

from ...errors import UserError, ends_on_error, reported
from .drive import WhileDriving, driven_session


class FRAGMOTION_OT_change_style(WhileDriving, bpy.types.Operator):
    """Go on in another style."""

    bl_idname = "fragmotion.change_style"
    bl_label = "Change Style"
    bl_description = "Let the character go on in this style, at the next moment at which that joins well"

    style: IntProperty(name="Style", description="Number of the style, from 0", min=0, options={"SKIP_SAVE"})  # type: ignore[valid-type]

    @ends_on_error
    @reported
    def execute(self, _context: bpy.types.Context) -> set[str]:
        styling = driven_session().styling
        if not self.style < len(styling.names):
            raise UserError(f"There is no style {self.style}: the character has {len(styling.names) or 'no styles'}")
        styling.want(self.style)
        return {"FINISHED"}
