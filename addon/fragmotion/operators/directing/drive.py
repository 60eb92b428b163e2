# SPDX-License-Identifier: GPL-3.0-or-later
"""Drive the active armature in the viewport."""

from __future__ import annotations

import time
from typing import Any, ClassVar

import bpy
from bpy.props import EnumProperty, IntProperty, StringProperty

from ...character.moves import names_of
from ...control_rig.binding import follows, rig_of
from ...drive import recorded, session
from ...drive.hud import views
from ...errors import UserError, core_errors, ends_on_error, reported
from ...input.keyboard import STYLE_STEPS
from ...input.pads import Pads
from ...input.sdl import SdlMissing
from ...paths.drawing import ground_under
from ...preview.waking import rest
from ...recordings.traces import asked_beside, make_trace
from ...rig.external_motion import external_motion
from ...settings import preferences
from ..base import status
from ..base.background import poll_idle
from ..base.context import active_armature, frame_rate, playhead, poll_armature
from ..base.woken import Woken
from .drive_hints import hints

_PANEL_INTERVAL = 0.2  # s between drawings of the sidebar, which holds the pads, and looks at the other windows
_GIZMOS = 100, 330  # pixels from a view's upper right corner, at a UI scale of 1, where clicks turn the view
_UNDO = {"ed.undo", "ed.redo"}
seen_pads: list[str] = []
"""The gamepads that the last Find Gamepads found."""


class _Hearing(Woken):
    """A modal operator by which a drive hears the keys and the mouse of a window, until that drive ends. It lets
    through what is not used. Blender gives a modal operator the events of one window only."""

    report: Any
    _session: session.Session = None  # type: ignore[assignment]  # until it hears one

    def _listen(self, context: bpy.types.Context, driven: session.Session, seconds: float) -> set[str]:
        """Hear the context's window, and be woken that often."""
        self._session, self._window = driven, context.window.as_pointer()
        driven.windows.add(self._window)
        return self._begin(context, seconds)

    @ends_on_error
    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        return self._handle(context, event) if session.current is self._session else self._end()

    def abandon(self, _context: bpy.types.Context) -> None:
        """End the drive that it hears, if any: it must never leave the armature half way, or go on unheard."""
        rest(self._timer)
        if session.current is self._session:
            session.stop()

    def cancel(self, context: bpy.types.Context) -> None:
        """Blender ends the operator."""
        self._session.windows.discard(self._window)
        super().cancel(context)

    def _handle(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        raise NotImplementedError

    def _hear(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Use an event of the window, if it is for the drive."""
        if event.type == "ESC" and event.value == "PRESS":
            session.stop()
            return self._end()
        if _is_undo(context, event):
            session.stop()
            self._session.farewell = "Undo has ended the drive; press again to undo what was done before"
            return self._end()
        return {"RUNNING_MODAL"} if _hear(self._session, context, event) else {"PASS_THROUGH"}

    def _end(self) -> set[str]:
        """The drive is over: say how it ended, where that is not said yet."""
        rest(self._timer)
        news = self._session.news  # which nobody could read yet: Blender shows no report before an operator ends
        if news and news not in self._session.inputs.messages:
            self._session.inputs.messages.append(news)
        self._tell()
        preferences.end_first_steps(bpy.context)
        if self._session.farewell:
            self.report({"WARNING"}, self._session.farewell)
            self._session.farewell = ""
        return {"FINISHED"}

    def _tell(self) -> None:
        for message in self._session.inputs.messages:
            self.report({"INFO"}, message)
        self._session.inputs.messages.clear()


class FRAGMOTION_OT_drive(_Hearing, bpy.types.Operator):
    """Begins a drive and updates it; pressed again it ends the drive."""

    bl_idname = "fragmotion.drive"
    bl_label = "Drive Character"
    bl_description = (
        "Drive the armature live with a gamepad, the keyboard, the on-screen stick or a trace; the last one touched "
        "drives. Esc or the button ends it, and everything is as it was before. Before Build, the body only slides"
    )
    bl_options: ClassVar[set[str]] = set()

    source: EnumProperty(  # type: ignore[valid-type]
        name="Drive by",
        description="What drives first; touching another input takes over",
        items=(
            ("INPUTS", "Inputs", "The input that is touched last"),
            ("RECORDING", "Recording", "A recording, from where it began"),
            ("OVER", "Over", "A recording, over which the stick is recorded from the playhead on"),
        ),
        default="INPUTS",
        options={"SKIP_SAVE"},
    )
    recording: IntProperty(  # type: ignore[valid-type]
        name="Recording",
        description="Number of the recording in the list, from 0",
        min=0,
        options={"SKIP_SAVE"},
    )
    seed: IntProperty(  # type: ignore[valid-type]
        name="Seed",
        description="Draws which fragment of a class plays; -1: the recording's seed, or the panel's",
        default=-1,
        min=-1,
        options={"SKIP_SAVE"},
    )
    policy: StringProperty(  # type: ignore[valid-type]
        name="Policy",
        description="The policy that drives; empty: the recording's, or the one that Build put first",
        options={"SKIP_SAVE"},
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if session.current is not None:
            return True
        if not poll_idle(cls) or not poll_armature(cls, context):
            return False
        if bpy.app.background:
            cls.poll_message_set("Driving needs a window")
        return not bpy.app.background

    @ends_on_error
    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        if session.current is not None and self.source == "INPUTS":
            session.stop()
            return {"FINISHED"}
        obj = active_armature(context) if session.current is None else driven_session().obj
        driven = self._session = self._start(context, obj)
        self._drawn = time.perf_counter()
        self._hints: list[status.Hint] = []
        self._show_hints(context)
        self._warn(obj)
        return self._listen(context, driven, 1 / session.RATE)

    def _start(self, context: bpy.types.Context, obj: bpy.types.Object) -> session.Session:
        if self.source == "INPUTS":
            return session.start(context, obj, self.seed, self.policy)
        recordings = obj.fragmotion.recordings
        if self.recording >= len(recordings):
            raise UserError(f"Armature '{obj.name}' has no such recording: record or import one")
        if self.source == "OVER":
            begin = playhead(context, recordings[self.recording])
            end = begin + obj.fragmotion.drive.over_seconds
            driven = recorded.record_over(context, obj, recordings[self.recording], begin, end)
            seconds = min(end, recordings[self.recording].seconds) - begin
            frame = context.scene.frame_current_final
            driven.span = frame, frame + seconds * frame_rate(context, recordings[self.recording])
            return driven
        return recorded.replay(context, obj, recordings[self.recording], self.seed, self.policy)

    def cancel(self, context: bpy.types.Context) -> None:
        """Without this window there is nothing to update the drive."""
        if session.current is self._session:
            session.stop()
        super().cancel(context)

    def _handle(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        trouble = self._session.trouble()
        if trouble:
            session.stop()
            self._session.farewell = f"The drive has ended: {trouble}"
            return self._end()
        return self._update(context) if event.type == "TIMER" else self._hear(context, event)

    def _update(self, context: bpy.types.Context) -> set[str]:
        seconds, now = self._passed(), time.perf_counter()
        if not bpy.app.is_job_running("RENDER"):  # which reads the armature meanwhile
            with core_errors("Drive"):
                if self._session.update(seconds):
                    views.tag_redraw()
        if self._session.is_done:
            session.stop()
            return self._end()
        self._tell()
        self._show_hints(context)
        if now - self._drawn > _PANEL_INTERVAL:
            views.tag_redraw("UI")
            self._drawn = now
            self._hear_other_windows(context)
        return {"PASS_THROUGH"}

    def _show_hints(self, context: bpy.types.Context) -> None:
        """Say in the status bar what can be pressed now, where that has changed."""
        told = hints(self._session)
        if told != self._hints:
            self._hints = told
            status.show(context.workspace, told)

    def _hear_other_windows(self, context: bpy.types.Context) -> None:
        """Those that show the scene in a 3D view, also when they are opened meanwhile."""
        for window in context.window_manager.windows:
            unheard = window.as_pointer() not in self._session.windows and window.scene == self._session.scene
            if unheard and any(True for _ in views.areas_of(window)):
                with context.temp_override(window=window):
                    bpy.ops.fragmotion.listen("INVOKE_DEFAULT")

    def _warn(self, obj: bpy.types.Object) -> None:
        rig = rig_of(obj)
        if rig != obj and not follows(rig):
            self.report(
                {"WARNING"}, f"'{rig.name}' plays its own Action: press Follow, under Control Rig, to see it move"
            )
        others = external_motion(obj)
        if others:
            self.report({"WARNING"}, f"The pose will differ from the character's because of {'; '.join(others)}")


class FRAGMOTION_OT_listen(_Hearing, bpy.types.Operator):
    """Let the drive hear the keys in this window, too"""

    bl_idname = "fragmotion.listen"
    bl_label = "Hear This Window"
    bl_options: ClassVar[set[str]] = {"INTERNAL"}

    @classmethod
    def poll(cls, _context: bpy.types.Context) -> bool:
        return session.current is not None and not bpy.app.background

    @ends_on_error
    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        return self._listen(context, driven_session(), _PANEL_INTERVAL)

    def _handle(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type == "TIMER" or self._session.trouble():
            return {"PASS_THROUGH"}
        return self._hear(context, event)


def driven_session() -> session.Session:
    """The drive that is under way; UserError where there is none that goes on."""
    if session.current is None:
        raise UserError("Nothing is driven: press Drive first")
    trouble = session.current.trouble()
    if trouble:
        session.stop()
        raise UserError(f"The drive has ended: {trouble}")
    return session.current


def _is_undo(context: bpy.types.Context, event: bpy.types.Event) -> bool:
    """Whether a key would undo or redo in the user's own keymap."""
    keymap = context.window_manager.keyconfigs.user.keymaps.get("Screen")
    item = keymap.keymap_items.match_event(event) if keymap is not None and event.value == "PRESS" else None
    return item is not None and item.idname in _UNDO


def _hear(driven: session.Session, context: bpy.types.Context, event: bpy.types.Event) -> bool:
    """Give an event to the inputs; whether they used it up."""
    inputs = driven.inputs
    if event.type == "WINDOW_DEACTIVATE":
        inputs.keyboard.release()
        inputs.stick.release()
        return False
    if event.type in {"MOUSEMOVE", "LEFTMOUSE"}:
        return _hear_mouse(driven, context, event)
    if event.value == "RELEASE":
        inputs.keyboard.let_go(event.type)
        return False
    action = inputs.keyboard.action_of(event.type)
    if action is None or event.value != "PRESS" or not _is_for_view(context, event):
        return False
    if action == "record":
        if not event.is_repeat:
            driven.toggle_recording()
    elif action in STYLE_STEPS:
        if not event.is_repeat:
            driven.styling.step_by(STYLE_STEPS[action])
    else:
        inputs.keyboard.press(event.type)
    return True


def _is_for_view(context: bpy.types.Context, event: bpy.types.Event) -> bool:
    """Whether a key is pressed over a 3D view of the window, and is no shortcut."""
    if event.ctrl or event.alt or event.oskey:
        return False
    return any(views.is_inside(area, event) for area in views.areas_of(context.window))


def _hear_mouse(driven: session.Session, context: bpy.types.Context, event: bpy.types.Event) -> bool:
    """Drag the on-screen stick, or send the character to where the ground is clicked; whether the drive uses the mouse.
    The main view's mouse counts, where it is in the window."""
    stick, area = driven.inputs.stick, driven.views.main()
    if area is None or area not in list(views.areas_of(context.window)):
        return False
    region = views.window_region(area)
    x, y = event.mouse_x - region.x, event.mouse_y - region.y
    if event.type == "LEFTMOUSE" and event.value == "PRESS":
        if not views.is_inside(area, event):
            return False
        return (driven.settings.show_stick and stick.press(x, y)) or _send_there(driven, area, event, (x, y))
    if not stick.held:
        return False
    if event.type == "MOUSEMOVE":
        stick.drag(x, y)
    else:
        stick.release()
    return True


def _send_there(
    driven: session.Session, area: bpy.types.Area, event: bpy.types.Event, pixel: tuple[float, float]
) -> bool:
    """Send the character to the ground at a pixel; whether there is any that no panel or gizmo covers."""
    if not driven.settings.click_to_walk or event.ctrl or event.alt or event.oskey:
        return False
    free, scale, (x, y) = views.free_part(area), bpy.context.preferences.system.ui_scale, pixel
    gizmo = x > free.right - _GIZMOS[0] * scale and y > free.top - _GIZMOS[1] * scale
    if gizmo or not (free.left <= x < free.right and free.bottom <= y < free.top):
        return False
    place = ground_under(area, x, y, driven.ground)
    if place is not None:
        driven.walk_to((place.x, place.y), event.shift, place.z)
    return place is not None


class WhileDriving:
    bl_options: ClassVar[set[str]] = set()

    @classmethod
    def poll(cls, _context: bpy.types.Context) -> bool:
        if session.current is None:
            cls.poll_message_set("Nothing is driven: press Drive first")  # type: ignore[attr-defined]
        return session.current is not None

    def abandon(self, _context: bpy.types.Context) -> None:
        """End the drive; what the user can put right is reported, and it goes on."""
        session.stop()


class FRAGMOTION_OT_record(WhileDriving, bpy.types.Operator):
    """Start a recording, or end it and keep it."""

    bl_idname = "fragmotion.record"
    bl_label = "Record"
    bl_description = (
        "Record what you do, 10 controls a second, and keep it with the armature. A recording begins where the "
        "character stands now; press again to end it"
    )

    @ends_on_error
    @reported
    def execute(self, _context: bpy.types.Context) -> set[str]:
        driven_session().toggle_recording()
        return {"FINISHED"}


class FRAGMOTION_OT_play_trace(WhileDriving, bpy.types.Operator):
    """Let a trace drive."""

    bl_idname = "fragmotion.play_trace"
    bl_label = "Play Trace"
    bl_description = "Let a trace drive until it ends, or until you touch another input"

    @ends_on_error
    @reported
    def execute(self, _context: bpy.types.Context) -> set[str]:
        driven = driven_session()
        trace = make_trace(driven.settings, driven.actor.space)
        moves, styled, asked = asked_beside(
            driven.settings, names_of(driven.actor.character), driven.styling.names, driven.actor.style
        )
        driven.play(trace, moves=moves, styled=styled, looks=asked.looks, reaches=asked.reaches)
        return {"FINISHED"}


class FRAGMOTION_OT_find_pads(bpy.types.Operator):
    """Look which gamepads are connected."""

    bl_idname = "fragmotion.find_pads"
    bl_label = "Find Gamepads"
    bl_description = "List the gamepads that are connected. While you drive, the list and the sticks are live"
    bl_options: ClassVar[set[str]] = {"INTERNAL"}

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        try:
            pads = Pads(preferences.get(context))
        except SdlMissing as missing:
            raise UserError(str(missing)) from missing
        pads.poll()
        seen_pads[:] = [pad.label for pad in pads.pads]
        pads.close()
        self.report({"INFO"}, f"Gamepads: {', '.join(seen_pads) or 'none found'}")
        return {"FINISHED"}
