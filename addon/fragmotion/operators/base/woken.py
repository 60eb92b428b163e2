# SPDX-License-Identifier: GPL-3.0-or-later
"""Modal operators that let something play."""

from __future__ import annotations

import time
from typing import Any, ClassVar

import bpy

from ...drive.hud import views
from ...errors import UserError, ends_on_error
from ...preview import previews
from ...preview.waking import rest, wake
from . import background, status
from .context import active_armature, poll_armature
from .status import Hint

_RATE = 60  # steps a second
_LONGEST = 0.25  # s that a step makes up for
_NAVIGATION = ("MOUSEMOVE", "INBETWEEN_MOUSEMOVE", "MIDDLEMOUSE", "WHEEL", "TRACKPAD", "NUMPAD", "TIMER", "WINDOW")


class Woken:
    """A modal operator that is woken by a timer until it ends."""

    _timer: bpy.types.Timer | None = None

    def _begin(self, context: bpy.types.Context, seconds: float) -> set[str]:
        """Be woken that often."""
        self._time = time.perf_counter()
        self._timer = wake(context.window, seconds)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def _passed(self) -> float:
        """Seconds since it was asked last, or began."""
        before, self._time = self._time, time.perf_counter()
        return self._time - before

    def cancel(self, _context: bpy.types.Context) -> None:
        """Blender ends the operator: its window is closed, another file is loaded, or Blender quits."""
        rest(self._timer)


class Previewing(Woken):
    """Shows what is chosen in a list of the sidebar, until Esc or a click beside it; pressed again it stops."""

    bl_options: ClassVar[set[str]] = {"REGISTER"}
    bl_label: str
    report: Any
    _preview: previews.Preview | None = None

    def _chosen(self, context: bpy.types.Context, obj: bpy.types.Object) -> Any:
        """What is chosen for the armature; None where nothing is."""
        raise NotImplementedError

    def _make(self, context: bpy.types.Context, obj: bpy.types.Object, chosen: Any) -> previews.Preview:
        raise NotImplementedError

    @classmethod
    def poll(cls: Any, context: bpy.types.Context) -> bool:
        if previews.current is not None:
            return True
        if not poll_armature(cls, context) or not background.poll_idle(cls):
            return False
        if bpy.app.background:
            cls.poll_message_set("There is no window to play in")
        return not bpy.app.background

    @ends_on_error
    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        if previews.current is not None:
            previews.stop()
            return {"FINISHED"}
        obj = active_armature(context)
        self._show(context, obj, self._chosen(context, obj))
        status.show(context.workspace, [Hint(("ESC",), "Stop"), Hint(("LEFTMOUSE",), "Another One in the List")])
        return self._begin(context, 1 / _RATE)

    @ends_on_error
    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if previews.current is None or previews.current is not self._preview:
            return self._end(context)
        if event.type == "TIMER":
            trouble = self._go_on(context, previews.current)
            if trouble:
                self.report({"WARNING"}, f"{self.bl_label} has ended: {trouble}")
                return self._end(context)
        clicked = event.type in {"LEFTMOUSE", "RIGHTMOUSE"}
        if is_navigation(event) or (clicked and _is_over_sidebar(context, event)):
            return {"PASS_THROUGH"}
        if event.value == "PRESS" and (clicked or event.type == "ESC"):
            return self._end(context)
        return {"RUNNING_MODAL"}

    def _show(self, context: bpy.types.Context, obj: bpy.types.Object, chosen: Any) -> None:
        previews.stop()
        self._preview, self._shown = self._make(context, obj, chosen), chosen
        previews.show(self._preview)

    def _go_on(self, context: bpy.types.Context, preview: previews.Preview) -> str:
        """Play on by the time since the last step, or what else is chosen; why that cannot be."""
        seconds, trouble = self._passed(), preview.trouble()
        if trouble:
            return trouble
        obj = active_armature(context)
        chosen = self._chosen(context, obj) if obj == preview.obj else None
        if chosen is None:
            return "nothing of this armature is chosen in the list"
        try:
            if chosen != self._shown:
                self._show(context, obj, chosen)
            else:
                preview.step(min(seconds, _LONGEST))
        except UserError as error:
            return str(error)
        views.tag_redraw()
        return ""

    def cancel(self, context: bpy.types.Context) -> None:
        """Blender ends the operator."""
        self._end(context)

    def abandon(self, context: bpy.types.Context) -> None:
        """Show nothing more: armature and scene are as before."""
        self._end(context)

    def _end(self, _context: bpy.types.Context) -> set[str]:
        rest(self._timer)
        if previews.current is self._preview:
            previews.stop()
        views.tag_redraw()
        views.tag_redraw("UI")
        return {"FINISHED"}


def is_navigation(event: bpy.types.Event) -> bool:
    """Whether it is a modal operator's to let through: what moves a view, or only tells."""
    return bool(event.type.startswith(_NAVIGATION))


def _is_over_sidebar(context: bpy.types.Context, event: bpy.types.Event) -> bool:
    """Whether the mouse is over a 3D view's sidebar, where the lists are."""
    regions = (region for area in views.areas_of(context.window) for region in area.regions)
    return any(region.type == "UI" and views.is_inside(region, event) for region in regions)
