# SPDX-License-Identifier: GPL-3.0-or-later
"""Preview one class in the viewport."""

from __future__ import annotations

import time
from typing import ClassVar

import bpy

from ...character import classes
from ...drive import take_shown
from ...drive.hud import views
from ...drive.solo import Solo
from ...errors import UserError, ends_on_error
from ..base import background
from ..base.context import active_armature, end_modal
from .force_class import poll_class

_RATE = 60  # steps a second
_LONGEST = 0.25  # s that a step makes up for
_NAVIGATION = ("MOUSEMOVE", "INBETWEEN_MOUSEMOVE", "MIDDLEMOUSE", "WHEEL", "TRACKPAD", "NUMPAD", "TIMER", "WINDOW")
current: Solo | None = None
"""The preview that runs now; the panel shows it."""

_timer: bpy.types.Timer | None = None


class FRAGMOTION_OT_solo_class(bpy.types.Operator):
    """Play the chosen class alone, fragment after fragment"""

    bl_idname = "fragmotion.solo_class"
    bl_label = "Preview Class"
    bl_description = (
        "Play the fragments of the chosen class on the armature, one after another, from where it stands. Esc or a "
        "click stops, and armature and scene are as before"
    )
    bl_options: ClassVar[set[str]] = {"REGISTER"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if not poll_class(cls, context):
            return False
        running = background.current is not None or classes.session is not None or take_shown.current is not None
        if bpy.app.background:
            cls.poll_message_set("There is no window to play in")
        elif running:
            cls.poll_message_set("Stop what is under way first (Esc)")
        return not (bpy.app.background or running or current)

    @ends_on_error
    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        global current, _timer
        number = context.window_manager.fragmotion.active_class
        obj = active_armature(context)
        current = Solo(context, obj, number, classes.shown_style(obj.fragmotion.figures))
        _timer = context.window_manager.event_timer_add(1 / _RATE, window=context.window)
        self._before = time.perf_counter()
        context.workspace.status_text_set("Preview of a class: Esc or a click stops it")
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    @ends_on_error
    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if current is None:
            return {"CANCELLED"}
        if event.value == "PRESS" and event.type in {"ESC", "LEFTMOUSE", "RIGHTMOUSE", "RET", "SPACE"}:
            stop()
            return {"FINISHED"}
        if event.type == "TIMER":
            trouble = self._go_on(current)
            if trouble:
                stop()
                self.report({"WARNING"}, f"The preview has ended: {trouble}")
                return {"FINISHED"}
        return {"PASS_THROUGH"} if event.type.startswith(_NAVIGATION) else {"RUNNING_MODAL"}

    def _go_on(self, solo: Solo) -> str:
        """Play on by the time since the last step; why that cannot be, empty where it can."""
        now = time.perf_counter()
        trouble = solo.trouble()
        if not trouble:
            trouble = self._step(solo, min(now - self._before, _LONGEST))
        self._before = now
        return trouble

    def _step(self, solo: Solo, seconds: float) -> str:
        try:
            solo.step(seconds)
        except UserError as error:
            return str(error)
        views.tag_redraw()
        return ""

    def cancel(self, _context: bpy.types.Context) -> None:
        """Blender ends the operator: its window is closed, another file is loaded, or Blender quits."""
        stop()

    def abandon(self, _context: bpy.types.Context) -> None:
        """End the preview: armature and scene are as before."""
        stop()


def stop() -> None:
    """End the preview that is running, and let nothing of it stay."""
    global current, _timer
    solo, timer = current, _timer
    current = _timer = None
    try:
        end_modal(timer)
    finally:
        if solo is not None:
            solo.end()
