# SPDX-License-Identifier: GPL-3.0-or-later
"""Build the active armature's character from the ticked Actions."""

from __future__ import annotations

from typing import Any, ClassVar

import bpy

from .. import building
from ..actions import fitting
from ..core import core
from ..errors import UserError, core_errors, reported
from ..jobs import Job
from ..properties import BuildFields
from .context import active_armature, adopt_settings, poll_armature

_TICK = 0.1  # s between looks at the job
current: Job | None = None
"""The build that runs now; the panel shows it."""

_timer: bpy.types.Timer | None = None  # wakes the modal operator while a build runs in the background


class Background:
    """An operator of one job, `current` while it runs: in the background, or at once where there is no window."""

    verb: ClassVar[str]
    report: Any
    _armature: str

    def _prepare(self, context: bpy.types.Context) -> Job:
        """Make the job, and set `_armature` to the name of the object that it is for."""
        raise NotImplementedError

    def _keep(self, obj: bpy.types.Object, result: Any) -> None:
        """Keep what the job returned with the armature, and report it."""
        raise NotImplementedError

    @reported
    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        if bpy.app.background:
            return self.execute(context)
        _watch(context, self._prepare(context))
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    @reported
    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        job = current
        if job is None:
            return {"CANCELLED"}
        if event.type == "ESC" and event.value == "PRESS":
            job.cancel()
            return {"RUNNING_MODAL"}
        if event.type == "TIMER":
            self._show(context)
            if not job.running:
                self._end(context)
                return self._finish(job)
        return {"PASS_THROUGH"}

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        manager = context.window_manager
        job = self._prepare(context)
        _set_current(job)
        manager.progress_begin(0, 100)
        try:
            job.run(lambda fraction: manager.progress_update(100 * fraction))
        finally:
            manager.progress_end()
            _set_current(None)
        return self._finish(job)

    def cancel(self, context: bpy.types.Context) -> None:
        """Blender ends the operator: another file is loaded, or Blender quits."""
        stop()

    def _finish(self, job: Job) -> set[str]:
        """Keep the result, or say why there is none."""
        try:
            with core_errors(self.verb):
                result = job.result()
        except core.Cancelled:
            self.report({"WARNING"}, f"{self.verb} was cancelled; nothing has changed")
            return {"CANCELLED"}
        obj = bpy.data.objects.get(self._armature)
        if obj is None:
            raise UserError(f"Armature '{self._armature}' was deleted or renamed meanwhile")
        self._keep(obj, result)
        return {"FINISHED"}

    def _show(self, context: bpy.types.Context) -> None:
        for area in context.screen.areas if context.screen else ():
            if area.type == "VIEW_3D":
                area.tag_redraw()

    def _end(self, context: bpy.types.Context) -> None:
        _set_current(None)
        _stop_timer()
        self._show(context)


def poll_build(cls: Any, context: bpy.types.Context) -> bool:
    """Whether there is something to build from and no build is running; says why not."""
    if not poll_armature(cls, context):
        return False
    obj = active_armature(context)
    takes = fitting(obj)
    if current is not None:
        cls.poll_message_set("A build is running")
    elif takes and not any(action.fragmotion.use for action in takes):
        cls.poll_message_set("No Action is ticked: tick the takes to learn from, under Mocap")
    elif not takes and not any(action.fragmotion.use for action in bpy.data.actions):
        cls.poll_message_set(f"Armature '{obj.name}' has no Actions to learn from: import mocap first")
    else:
        return True
    return False


class FRAGMOTION_OT_build(BuildFields, Background, bpy.types.Operator):
    """Build in the background; to its end at once where there is no window, and when executed."""

    bl_idname = "fragmotion.build"
    bl_label = "Build"
    bl_description = (
        "Cut the ticked Actions into fragments, cluster them and find the policy: what to play next for each control. "
        "Blender stays usable meanwhile; Esc or Cancel stops it"
    )
    bl_options: ClassVar[set[str]] = {"UNDO"}
    verb = "Build"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return poll_build(cls, context)

    def _prepare(self, context: bpy.types.Context) -> Job:
        obj = active_armature(context)
        adopt_settings(self, obj.fragmotion.build, BuildFields)
        task, self._warnings = building.prepare(context, obj, self)
        self._armature = obj.name
        return Job(f"Building '{obj.name}'", task)

    def _keep(self, obj: bpy.types.Object, built: building.Built) -> None:
        building.keep(obj, built)
        figures = obj.fragmotion.figures
        self.report(
            {"INFO"},
            f"{figures.fragments} fragments in {figures.classes} classes, built in {figures.seconds:.1f} s; "
            f"quality {figures.quality:.0f} % of Optimal",
        )
        for warning in self._warnings:
            self.report({"WARNING"}, warning)


class FRAGMOTION_OT_cancel_build(bpy.types.Operator):
    """Stop the build that is running; nothing changes in the file"""

    bl_idname = "fragmotion.cancel_build"
    bl_label = "Cancel Build"
    bl_options: ClassVar[set[str]] = {"INTERNAL"}

    @classmethod
    def poll(cls, _context: bpy.types.Context) -> bool:
        if current is None:
            cls.poll_message_set("No build is running")
        return current is not None

    def execute(self, _context: bpy.types.Context) -> set[str]:
        if current is not None:
            current.cancel()
        return {"FINISHED"}


def stop() -> None:
    """Cancel the build that is running, return when it has stopped, and let nothing of it stay with Blender."""
    if current is not None:
        current.cancel()
        if current.running:
            current.wait()
    _set_current(None)
    _stop_timer()


def _watch(context: bpy.types.Context, job: Job) -> None:
    """Start the build in the background, and a timer that wakes its operator."""
    global _timer
    _set_current(job)
    job.start()
    _timer = context.window_manager.event_timer_add(_TICK, window=context.window)


def _stop_timer() -> None:
    global _timer
    if _timer is not None:
        bpy.context.window_manager.event_timer_remove(_timer)
    _timer = None


def _set_current(job: Job | None) -> None:
    global current
    current = job
