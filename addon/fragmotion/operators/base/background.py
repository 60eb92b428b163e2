# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators whose work runs in the background, where Esc and the panel's Cancel stop it."""

from __future__ import annotations

from typing import Any, ClassVar

import bpy

from ...character.building import has_character
from ...compat.core import core
from ...errors import UserError, core_errors, ends_on_error, reported
from ...jobs import Job
from ...preview.waking import rest, wake
from . import status
from .context import active_armature, adopt_settings, poll_armature, progress_shown

_TICK = 0.1  # s between looks at the job
_SLICE = 0.25  # s of work between looks at what the user does
current: Job | None = None
"""What runs now; the panel shows it."""

_timer: bpy.types.Timer | None = None  # wakes the modal operator


class Background:
    """An operator of one job, `current` while it runs: in the background, or to its end at once where there is no
    window, and when executed. A job that takes no longer than `patience` (s) is waited for. Fields that the caller did
    not set are the panel's: those of the active armature's `settings`."""

    verb: ClassVar[str]
    settings: ClassVar[str]
    patience: ClassVar[float] = 0.0
    report: Any
    _armature: str

    def _prepare(self, context: bpy.types.Context, obj: bpy.types.Object) -> Job:
        """Make the job for the armature; UserError where it cannot be."""
        raise NotImplementedError

    def _keep(self, context: bpy.types.Context, obj: bpy.types.Object, result: Any) -> None:
        """Keep what the job returned with the armature, and report it."""
        raise NotImplementedError

    @ends_on_error
    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        if bpy.app.background:
            return self.execute(context)
        outcome = self._start(context)
        if outcome == {"RUNNING_MODAL"}:
            context.window_manager.modal_handler_add(self)
        return outcome

    def _start(self, context: bpy.types.Context) -> set[str]:
        """Start the job; what the operator returns, with its modal handler if it goes on."""
        job = self._make_job(context)
        _watch(context, job)
        job.wait(self.patience)
        if job.running:
            return {"RUNNING_MODAL"}
        self._end(context)
        return self._finish(context, job)

    @ends_on_error
    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        job = current
        if job is None:
            return {"CANCELLED"}
        if event.type == "ESC" and event.value == "PRESS":
            job.cancel()
            return {"RUNNING_MODAL"}
        if event.type == "TIMER":
            self._show(context)
            self._go_on(job)
            told = status.Progress(f"{job.label}: {job.stage}", job.fraction)
            status.show(context.workspace, [status.Hint(("ESC",), "Stop")], told)
            if not job.running:
                self._end(context)
                return self._finish(context, job)
        return {"PASS_THROUGH"}

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        job = self._make_job(context)
        _set_current(job)
        try:
            with progress_shown(context) as advance:
                job.run(advance)
        finally:
            _set_current(None)
        return self._finish(context, job)

    def cancel(self, context: bpy.types.Context) -> None:
        """Blender ends the operator: another file is loaded, or Blender quits."""
        stop()

    def abandon(self, context: bpy.types.Context) -> None:
        """Give up the job."""
        stop()

    def _make_job(self, context: bpy.types.Context) -> Job:
        obj = active_armature(context)
        adopt_settings(self, getattr(obj.fragmotion, self.settings))
        self._armature = obj.name
        return self._prepare(context, obj)

    def _finish(self, context: bpy.types.Context, job: Job) -> set[str]:
        """Keep the result, or say why there is none."""
        try:
            with core_errors(self.verb):
                result = job.result()
        except core.Cancelled:
            self.report({"WARNING"}, f"{self.verb} was cancelled; nothing has changed")
            return {"CANCELLED"}
        self._keep(context, self._owner(), result)
        return {"FINISHED"}

    def _owner(self) -> bpy.types.Object | None:
        """What the job was made for; UserError where it is gone."""
        obj = bpy.data.objects.get(self._armature)
        if obj is None:
            raise UserError(f"Armature '{self._armature}' was deleted or renamed meanwhile")
        return obj

    def _go_on(self, job: Job) -> None:
        """Do what a job without a thread of its own needs."""

    def _show(self, context: bpy.types.Context) -> None:
        for area in context.screen.areas if context.screen else ():
            if area.type == "VIEW_3D":
                area.tag_redraw()

    def _end(self, context: bpy.types.Context) -> None:
        _set_current(None)
        _stop_timer()
        self._show(context)


class Exclusive(Background):
    """One of a stepped job, during which nothing else is to happen in Blender: Esc alone is heard."""

    @ends_on_error
    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        outcome: set[str] = super().modal(context, event)
        return {"RUNNING_MODAL"} if outcome == {"PASS_THROUGH"} else outcome

    def _go_on(self, job: Job) -> None:
        job.wait(_SLICE)


class FRAGMOTION_OT_cancel(bpy.types.Operator):
    """Stop what is under way in the background; nothing changes in the file"""

    bl_idname = "fragmotion.cancel"
    bl_label = "Cancel"
    bl_options: ClassVar[set[str]] = {"INTERNAL"}

    @classmethod
    def poll(cls, _context: bpy.types.Context) -> bool:
        if current is None:
            cls.poll_message_set("Nothing is under way")
        return current is not None

    @reported
    def execute(self, _context: bpy.types.Context) -> set[str]:
        if current is not None:
            current.cancel()
        return {"FINISHED"}


def poll_idle(cls: Any) -> bool:
    """Whether nothing runs in the background; says what does."""
    if current is not None:
        cls.poll_message_set(f"{current.label} is under way: wait, or cancel it (Esc)")
    return current is None


def poll_character(cls: Any, context: bpy.types.Context) -> bool:
    """Whether the active armature has a character that can be used now; says why not."""
    if not poll_armature(cls, context) or not poll_idle(cls):
        return False
    obj = active_armature(context)
    if not has_character(obj):
        cls.poll_message_set(f"Armature '{obj.name}' has no character yet: press Build first")
    return has_character(obj)


def stop() -> None:
    """Cancel what is under way, return when it has stopped, and let nothing of it stay with Blender."""
    if current is not None:
        current.cancel()
        if current.running:
            current.wait()
    _set_current(None)
    _stop_timer()


def _watch(context: bpy.types.Context, job: Job) -> None:
    """Start the job, and a timer that wakes its operator."""
    global _timer
    _set_current(job)
    job.start()
    _timer = wake(context.window, _TICK)


def _stop_timer() -> None:
    global _timer
    rest(_timer)
    _timer = None


def _set_current(job: Job | None) -> None:
    global current
    current = job
