# SPDX-License-Identifier: GPL-3.0-or-later
"""Play the take that is chosen in the Mocap list."""

from __future__ import annotations

import time
from typing import ClassVar

import bpy

from ...character import classes
from ...drive import take_shown
from ...drive.hud import views
from ...errors import UserError, ends_on_error
from ...mocap.actions import chosen
from ..base import background
from ..base.context import active_armature, end_modal, poll_armature
from ..character import solo_class

_RATE = 60  # steps a second
_LONGEST = 0.25  # s that a step makes up for
_KEYS = {"MOUSEMOVE", "INBETWEEN_MOUSEMOVE", "MIDDLEMOUSE"}
_NAVIGATION = ("WHEEL", "TRACKPAD", "NUMPAD", "TIMER", "WINDOW")

_timer: bpy.types.Timer | None = None


class FRAGMOTION_OT_play_take(bpy.types.Operator):
    """Plays the chosen take; pressed again it stops."""

    bl_idname = "fragmotion.play_take"
    bl_label = "Play Take"
    bl_description = (
        "Play the take that is chosen in the list on the armature, on loop: click another one to see that. Esc, this "
        "button or a click beside the sidebar stops, and armature and scene are as before"
    )
    bl_options: ClassVar[set[str]] = {"REGISTER"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if take_shown.current is not None:
            return True
        if not poll_armature(cls, context) or not background.poll_idle(cls):
            return False
        if bpy.app.background:
            cls.poll_message_set("There is no window to play in")
        elif solo_class.current is not None or classes.session is not None:
            cls.poll_message_set("Stop what is under way first (Esc)")
        elif chosen(context, active_armature(context)) is None:
            cls.poll_message_set("No take is chosen in the list under Mocap")
        else:
            return True
        return False

    @ends_on_error
    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        global _timer
        if take_shown.current is not None:
            stop()
            return {"FINISHED"}
        obj = active_armature(context)
        take_shown.show(context, obj, chosen(context, obj))
        _timer = context.window_manager.event_timer_add(1 / _RATE, window=context.window)
        self._before = time.perf_counter()
        context.workspace.status_text_set("A take plays: click another one in the list to see it; Esc stops")
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    @ends_on_error
    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if take_shown.current is None:
            return {"CANCELLED"}
        if event.type == "TIMER":
            trouble = self._go_on(context, take_shown.current)
            if trouble:
                stop()
                self.report({"WARNING"}, f"The take is shown no more: {trouble}")
                return {"FINISHED"}
        if event.type in _KEYS or event.type.startswith(_NAVIGATION):
            return {"PASS_THROUGH"}
        if event.type in {"LEFTMOUSE", "RIGHTMOUSE"} and _is_over_sidebar(context, event):
            return {"PASS_THROUGH"}
        if event.value == "PRESS" and event.type in {"ESC", "LEFTMOUSE", "RIGHTMOUSE"}:
            stop()
            return {"FINISHED"}
        return {"RUNNING_MODAL"}

    def _go_on(self, context: bpy.types.Context, shown: take_shown.TakeShown) -> str:
        """Play on by the time since the last step, or another take where one is chosen; why that cannot be."""
        now = time.perf_counter()
        seconds, self._before = min(now - self._before, _LONGEST), now
        trouble = shown.trouble()
        if trouble:
            return trouble
        obj = active_armature(context)
        action = chosen(context, obj) if obj is not None and obj.name == shown.armature else None
        if action is None:
            return "nothing of this armature is chosen in the list"
        try:
            if action.name != shown.name:
                take_shown.show(context, obj, action)
            else:
                shown.step(seconds)
        except UserError as error:
            return str(error)
        views.tag_redraw()
        return ""

    def cancel(self, _context: bpy.types.Context) -> None:
        """Blender ends the operator: its window is closed, another file is loaded, or Blender quits."""
        stop()

    def abandon(self, _context: bpy.types.Context) -> None:
        """Show the take no more: armature and scene are as before."""
        stop()


def stop() -> None:
    """Show no take any more, and let nothing of it stay with Blender."""
    global _timer
    timer, _timer = _timer, None
    try:
        end_modal(timer)
    finally:
        take_shown.stop()
    views.tag_redraw()
    views.tag_redraw("UI")


def _is_over_sidebar(context: bpy.types.Context, event: bpy.types.Event) -> bool:
    """Whether the mouse is over a 3D view's sidebar, where the list is."""
    regions = (region for area in views.areas_of(context.window) for region in area.regions)
    return any(region.type == "UI" and views.is_inside(region, event) for region in regions)
