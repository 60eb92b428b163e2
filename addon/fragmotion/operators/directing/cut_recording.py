# SPDX-License-Identifier: GPL-3.0-or-later
"""Cut a stretch out of a recording, between two joins that are dragged on the timeline."""

from __future__ import annotations

from typing import Any, NamedTuple

import bpy
from bpy.props import BoolProperty, FloatProperty

from ...drive.hud import timeline, views
from ...edits import cutting
from ...errors import ends_on_error, reported
from ...recordings.recordings import TRACE_RATE
from ..base import status
from ..base.context import active_armature, first_frame, frame_rate, playhead
from ..base.status import Hint
from ..base.woken import is_navigation
from .recordings import OnRecording, selected

_RED = (1.0, 0.1, 0.1, 0.35)
_HINTS = (
    Hint(("ESC", "RIGHTMOUSE"), "Cut Nothing"),
    Hint(("RET",), "Cut Out"),
    Hint(("LEFTMOUSE",), "Drag the Nearer End of the Red on the Timeline"),
)
_SPAN = 10.0  # s that a field's whole slide is: more is typed
_LEAST = 1 / TRACE_RATE  # s of the recording before the stretch, in it, and behind it


class Held(NamedTuple):
    """Which join the mouse drags, in which editor's part, and how much later than the mouse it was asked for, s."""

    name: str
    part: bpy.types.Region
    later: float


def _moment(name: str, description: str, default: float) -> Any:
    return FloatProperty(
        name=f"{name} (s)", description=description, default=default, min=0.0, soft_max=_SPAN, step=10, precision=1
    )


class FRAGMOTION_OT_cut_recording(OnRecording, bpy.types.Operator):
    """Cut a stretch out of the middle of the selected recording; what follows goes on from where the character is."""

    bl_idname = "fragmotion.cut_recording"
    bl_label = "Cut Out"
    bl_description = (
        "Cut a stretch out of the middle of the selected recording, and up to half a second more, so that the "
        "poses fit. It is red on the timeline, where its ends are dragged: at first the preview range, which is then "
        "over, or the second after the playhead. What follows goes on from where the character is then, and moves as "
        "it did"
    )

    start: _moment("From", "Where the stretch begins, in seconds from the recording's beginning", 1.0)  # type: ignore[valid-type]
    end: _moment("To", "Where the stretch ends, in seconds from the recording's beginning", 2.0)  # type: ignore[valid-type]
    of_range: BoolProperty(options={"HIDDEN", "SKIP_SAVE"})  # type: ignore[valid-type]

    _held: Held | None = None

    @ends_on_error
    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        obj, recording = active_armature(context), selected(context)
        self._length = recording.seconds
        self._first, self._rate = first_frame(obj, recording), frame_rate(context, recording)
        self._find = cutting.cut_finder(obj, recording)
        self._ask(context.scene, playhead(context, recording))
        if not timeline.areas_of(context.window):
            return self.execute(context)
        self._show(context)
        status.show(context.workspace, _HINTS)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    @ends_on_error
    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.value == "PRESS" and event.type in {"ESC", "RIGHTMOUSE"}:
            self.abandon(context)
            return {"CANCELLED"}
        if event.value == "PRESS" and event.type in {"RET", "NUMPAD_ENTER"}:
            self.abandon(context)
            return self.execute(context)
        if event.type == "LEFTMOUSE":
            self._held = self._grab(context, event) if event.value == "PRESS" else None
        elif event.type == "MOUSEMOVE" and self._held is not None:
            self._drag(context, event, self._held)
        elif is_navigation(event):
            return {"PASS_THROUGH"}
        return {"RUNNING_MODAL"}

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        recording = selected(context)
        seam = cutting.cut_out(active_armature(context), recording, self.start, self.end)
        views.tag_redraw("UI")  # which says how long the recording is; the mouse is on the timeline
        if self.of_range:  # which is gone
            context.scene.use_preview_range = False
        self.report(
            {"INFO"},
            f"Cut {seam.end / TRACE_RATE:.1f} s to {seam.beginning / TRACE_RATE:.1f} s out of '{recording.name}'"
            f"{cutting.fit_in_words(seam)}",
        )
        return {"FINISHED"}

    def cancel(self, context: bpy.types.Context) -> None:
        """Blender ends the operator."""
        self.abandon(context)

    def abandon(self, context: bpy.types.Context) -> None:
        """Give back timeline and status bar; nothing is cut."""
        timeline.unmark()
        timeline.tell(context.window, None)
        context.workspace.status_text_set(None)

    def _ask(self, scene: bpy.types.Scene, now: float) -> None:
        """Begin with the preview range, or the second after the playhead, as far as the recording has it."""
        start, end = now, now + 1.0
        self.of_range = scene.use_preview_range
        if self.of_range:
            start, end = map(self._seconds_at, (scene.frame_preview_start, scene.frame_preview_end))
        self.end = max(min(end, self._length - _LEAST), 2 * _LEAST)
        self.start = max(min(start, self.end - _LEAST), _LEAST)

    def _seconds_at(self, frame: float) -> float:
        """Where in the recording a frame is."""
        return (frame - self._first) / self._rate

    def _grab(self, context: bpy.types.Context, event: bpy.types.Event) -> Held | None:
        """The join nearer to the mouse, where that is on a timeline."""
        part = timeline.part_under(context.window, event)
        if part is None:
            return None
        now = self._seconds_at(timeline.frame_at(part, event))
        begin, beyond = self._seam.end / TRACE_RATE, self._seam.beginning / TRACE_RATE
        name = "start" if abs(now - begin) < abs(now - beyond) else "end"
        return Held(name, part, getattr(self, name) - now)

    def _drag(self, context: bpy.types.Context, event: bpy.types.Event, held: Held) -> None:
        """Move the join that is held, as far as the other one and the recording's ends let it."""
        wanted = self._seconds_at(timeline.frame_at(held.part, event)) + held.later
        if held.name == "start":
            self.start = max(min(wanted, self.end - _LEAST), _LEAST)
        else:
            self.end = min(max(wanted, self.start + _LEAST), self._length - _LEAST)
        self._show(context)

    def _show(self, context: bpy.types.Context) -> None:
        """Say and mark on the timeline where it would be cut, and how well the poses fit there."""
        self._seam = seam = self._find(self.start, self.end)
        first, last = (self._first + self._rate * control / TRACE_RATE for control in (seam.end, seam.beginning))
        timeline.mark(lambda: [timeline.Span(first, last, _RED)])
        timeline.tell(
            context.window,
            f"Cuts {seam.end / TRACE_RATE:.1f} s to {seam.beginning / TRACE_RATE:.1f} s{cutting.fit_in_words(seam)}",
        )


CLASSES = (FRAGMOTION_OT_cut_recording,)
