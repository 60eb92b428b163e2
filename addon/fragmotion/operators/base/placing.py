# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators that ask for a place by a click on the ground."""

from __future__ import annotations

from typing import Any

import bpy

from ...drive.hud import views
from ...ground.meshes import find_ground
from ...paths.drawing import ground_under
from . import status
from .context import active_armature
from .status import Hint
from .woken import is_navigation

_HINTS = (
    Hint(("ESC", "RIGHTMOUSE"), "Nowhere"),
    Hint(("LEFTMOUSE",), "Place on the Ground"),
    Hint(("RET",), "At the 3D Cursor"),
)


class Placing:
    """Pressed in a 3D view, it asks where: the 3D cursor goes to the ground that is clicked, and it does its work
    there. Executed, or where there is no view, the place is the 3D cursor's."""

    report: Any
    _asks_in: bpy.types.Area | None = None

    def _begin_asking(self, context: bpy.types.Context) -> set[str]:
        """Wait for the click."""
        self._asks_in = context.area
        self._ground = find_ground(context, active_armature(context))
        context.window.cursor_modal_set("CROSSHAIR")
        status.show(context.workspace, _HINTS)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def _go_on_asking(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str] | None:
        """What the operator's modal returns as long as there is no place; None once the 3D cursor is there."""
        area = self._asks_in
        if area is None or not any(area == other for other in views.areas_of(context.window)):
            return self._end_asking(context, {"CANCELLED"})
        if event.value == "PRESS" and event.type in {"ESC", "RIGHTMOUSE"}:
            return self._end_asking(context, {"CANCELLED"})
        if event.value == "PRESS" and event.type in {"RET", "NUMPAD_ENTER"}:
            return self._end_asking(context, None)
        if event.value == "PRESS" and event.type == "LEFTMOUSE":
            return self._click(context, event, area)
        return {"PASS_THROUGH"} if is_navigation(event) else {"RUNNING_MODAL"}

    def _click(self, context: bpy.types.Context, event: bpy.types.Event, area: bpy.types.Area) -> set[str] | None:
        part, free = views.window_region(area), views.free_part(area)
        x, y = event.mouse_x - part.x, event.mouse_y - part.y
        if not (free.left <= x < free.right and free.bottom <= y < free.top):
            return self._end_asking(context, {"CANCELLED", "PASS_THROUGH"})
        place = ground_under(area, x, y, self._ground)
        if place is None:
            self.report({"WARNING"}, "There is no ground under the mouse: click on it, or look from further above")
            return {"RUNNING_MODAL"}
        context.scene.cursor.location = place
        return self._end_asking(context, None)

    def _end_asking(self, context: bpy.types.Context, result: set[str] | None) -> set[str] | None:
        """Give back mouse and status bar."""
        if self._asks_in is not None:
            self._asks_in = None
            context.window.cursor_modal_restore()
            context.workspace.status_text_set(None)
        return result


def is_in_view(context: bpy.types.Context) -> bool:
    """Whether there is a window, and the button that was pressed is in a 3D view of it."""
    return not bpy.app.background and context.area is not None and context.area.type == "VIEW_3D"
