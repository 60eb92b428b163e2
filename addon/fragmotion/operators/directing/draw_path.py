# SPDX-License-Identifier: GPL-3.0-or-later
"""Draw a path on the ground by mouse."""

from __future__ import annotations

from typing import Any, ClassVar

import bpy
from mathutils import Vector

from ...errors import UserError, ends_on_error
from ...ground.meshes import find_ground
from ...paths.drawing import add_curve, ground_under
from ..base import status
from ..base.context import active_armature, poll_armature
from ..base.status import Hint

_APART = 8  # pixels between the points that are kept
_ABOVE = Vector((0, 0, 0.01))  # the ground, m, so that the curve is seen
_HINTS = (Hint(("ESC", "RIGHTMOUSE"), "Draw None"), Hint(("LEFTMOUSE",), "Hold and Move Over the Ground"))


class FRAGMOTION_OT_draw_path(bpy.types.Operator):
    """A stroke on the ground becomes a curve object."""

    bl_idname = "fragmotion.draw_path"
    bl_label = "Draw Path"
    bl_description = (
        "Draw a path on the ground in the 3D viewport: hold the left mouse button and move. It becomes a curve object, "
        "which Follow Path then follows and you can edit as any curve"
    )
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls: Any, context: bpy.types.Context) -> bool:
        return poll_armature(cls, context)

    @ends_on_error
    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        self._ground = find_ground(context, active_armature(context))
        self._area, self._last = context.area, None
        self._points: list[Vector] = []
        context.window.cursor_modal_set("PAINT_BRUSH")
        status.show(context.workspace, _HINTS)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    @ends_on_error
    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type in {"ESC", "RIGHTMOUSE"}:
            return self._end(context, {"CANCELLED"})
        if event.type == "LEFTMOUSE" and event.value == "RELEASE" and self._last is not None:
            self._end(context, set())
            return self._keep(context)
        if (event.type == "LEFTMOUSE" and event.value == "PRESS") or (event.type == "MOUSEMOVE" and self._last):
            self._add(event)
            return {"RUNNING_MODAL"}
        return {"PASS_THROUGH"} if self._last is None else {"RUNNING_MODAL"}

    def _add(self, event: bpy.types.Event) -> None:
        """A point under the mouse, where the ground is and the last one is far enough."""
        region = next(part for part in self._area.regions if part.type == "WINDOW")
        mouse = Vector((event.mouse_x - region.x, event.mouse_y - region.y))
        if self._last is not None and (mouse - self._last).length < _APART:
            return
        self._last = mouse
        place = ground_under(self._area, mouse.x, mouse.y, self._ground)
        if place is not None:
            self._points.append(place + _ABOVE)

    def _keep(self, context: bpy.types.Context) -> set[str]:
        if len(self._points) < 2:
            raise UserError("Nothing was drawn on the ground: hold the left mouse button and move, over the floor")
        curve = add_curve(context, self._points)
        settings = active_armature(context).fragmotion.path
        settings.source, settings.curve = "CURVE", curve
        self.report({"INFO"}, f"Drew '{curve.name}': press Follow Path, or edit it first")
        return {"FINISHED"}

    def abandon(self, context: bpy.types.Context) -> None:
        """Draw nothing, and give the mouse back."""
        self._end(context, set())

    def _end(self, context: bpy.types.Context, result: set[str]) -> set[str]:
        context.window.cursor_modal_restore()
        context.workspace.status_text_set(None)
        return result
