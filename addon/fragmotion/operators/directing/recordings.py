# SPDX-License-Identifier: GPL-3.0-or-later
"""Keep the active armature's recordings in order."""

from __future__ import annotations

from pathlib import Path
from typing import Any, ClassVar

import bpy
from bpy.props import CollectionProperty, FloatProperty, StringProperty
from bpy_extras.io_utils import ImportHelper

from ...bake.performing import measure_quality, origin_frame
from ...errors import UserError, reported
from ...recordings.curves import remove_curves, renew_curves
from ...recordings.recordings import (
    TRACE_RATE,
    active_recording,
    add_recording,
    asked_of,
    duplicate_recording,
    remove_recording,
    set_asked,
    trace_of,
    trim_recording,
)
from ...recordings.traces import read_trace_file, write_trace_file
from ...words import counted
from ..base.context import active_armature, poll_armature
from ..base.saving import Saving

EXTENSION = ".csv"
_FEWEST_ROWS = 2  # of a trace file


class OnRecording:
    """An operator on the recording that is selected in the list."""

    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if not poll_armature(cls, context):
            return False
        obj: Any = active_armature(context)
        if active_recording(obj) is None:
            cls.poll_message_set(f"Armature '{obj.name}' has no recordings: record or import one")  # type: ignore[attr-defined]
        return active_recording(obj) is not None


class FRAGMOTION_OT_delete_recording(OnRecording, bpy.types.Operator):
    """Delete the selected recording"""

    bl_idname = "fragmotion.delete_recording"
    bl_label = "Delete Recording"

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        obj = active_armature(context)
        name = selected(context).name
        remove_curves(obj, selected(context))
        remove_recording(obj, obj.fragmotion.active_recording)
        self.report({"INFO"}, f"Deleted recording '{name}'")
        return {"FINISHED"}


class FRAGMOTION_OT_duplicate_recording(OnRecording, bpy.types.Operator):
    """Copy the selected recording, to trim the copy or train on it"""

    bl_idname = "fragmotion.duplicate_recording"
    bl_label = "Duplicate Recording"

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        obj = active_armature(context)
        duplicate_recording(obj, obj.fragmotion.active_recording)
        return {"FINISHED"}


def _cut(name: str, dropped: str, default: float, least: float) -> Any:
    """A time in a recording, to the tenth of a second that a control lasts."""
    return FloatProperty(
        name=name,
        description=f"What comes {dropped} is dropped; seconds from the recording's beginning, to the nearest tenth",
        default=default,
        min=least,
        step=10,
        precision=1,
        unit="TIME_ABSOLUTE",
    )


class FRAGMOTION_OT_trim_recording(OnRecording, bpy.types.Operator):
    """Keep only a part of the selected recording. What the character did in that part is kept, too"""

    bl_idname = "fragmotion.trim_recording"
    bl_label = "Trim Recording"

    start: _cut("Start", "before", 0.0, 0.0)  # type: ignore[valid-type]
    end: _cut("End", "after", 60.0, 0.1)  # type: ignore[valid-type]

    @reported
    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        self.start, self.end = 0.0, selected(context).seconds
        result: set[str] = context.window_manager.invoke_props_dialog(self)
        return result

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        obj, recording = active_armature(context), selected(context)
        trim_recording(recording, self.start, self.end)
        recording.quality = measure_quality(obj, recording)
        renew_curves(obj, recording)
        self.report({"INFO"}, f"Recording '{recording.name}' lasts {recording.seconds:.1f} s now")
        return {"FINISHED"}


class FRAGMOTION_OT_export_recording(OnRecording, Saving, bpy.types.Operator):
    """Write the selected recording to a CSV file."""

    bl_idname = "fragmotion.export_recording"
    bl_label = "Export Recording"
    bl_description = (
        "Write the selected recording to a CSV file: velocity_x,velocity_y (m/s),turn,jump and, where it has any, its "
        "moves and styles; 10 rows a second"
    )
    bl_options: ClassVar[set[str]] = {"REGISTER"}

    filename_ext = EXTENSION
    filter_glob: StringProperty(default=f"*{EXTENSION}", options={"HIDDEN"})  # type: ignore[valid-type]

    def _suggestion(self, context: bpy.types.Context) -> str:
        return str(selected(context).name)

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        path = self._path()
        recording = selected(context)
        trace = trace_of(recording)
        if len(trace) < _FEWEST_ROWS:
            raise UserError(f"Recording '{recording.name}' holds a single control: record a longer one to export")
        write_trace_file(path, trace, asked_of(recording))
        self.report({"INFO"}, f"Saved recording '{recording.name}' ({recording.seconds:.1f} s) to '{path}'")
        return {"FINISHED"}


class FRAGMOTION_OT_import_recordings(ImportHelper, bpy.types.Operator):
    """Read recordings from CSV files; nothing is imported where one is malformed."""

    bl_idname = "fragmotion.import_recordings"
    bl_label = "Import Recordings"
    bl_description = (
        "Read recordings from CSV files with the header velocity_x,velocity_y,turn,jump: velocity to the right and "
        "forward in m/s, turn from -1 (right) to 1 (left; more to face about), jump 0 or 1; 10 rows a second. Columns "
        "'move' and 'style' after these may name the moves that are held and the style"
    )
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    filename_ext = EXTENSION
    filter_glob: StringProperty(default=f"*{EXTENSION}", options={"HIDDEN"})  # type: ignore[valid-type]
    directory: StringProperty(subtype="DIR_PATH", options={"HIDDEN", "SKIP_SAVE"})  # type: ignore[valid-type]
    files: CollectionProperty(  # type: ignore[valid-type]
        type=bpy.types.OperatorFileListElement, options={"HIDDEN", "SKIP_SAVE"}
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return poll_armature(cls, context)

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        obj = active_armature(context)
        traces = {}
        for path in self._paths():
            traces[path] = read_trace_file(path)
        for path, (trace, asked) in traces.items():
            recording = add_recording(obj, trace, name=path.stem, start=origin_frame(obj))
            set_asked(recording, asked)
            recording.quality = measure_quality(obj, recording)
        seconds = sum(len(trace) for trace, _ in traces.values()) / TRACE_RATE
        self.report({"INFO"}, f"Imported {counted(len(traces), 'recording')} ({seconds:.1f} s)")
        return {"FINISHED"}

    def _paths(self) -> list[Path]:
        """The chosen files; UserError where there is none."""
        names = [file.name for file in self.files if file.name]
        folder = Path(bpy.path.abspath(self.directory))
        paths = [folder / name for name in names] or [Path(bpy.path.abspath(self.filepath))] * bool(self.filepath)
        if not paths:
            raise UserError("No file is chosen")
        return paths


def selected(context: bpy.types.Context) -> Any:
    """The recording that `OnRecording.poll` found."""
    return active_recording(active_armature(context))


CLASSES = (
    FRAGMOTION_OT_delete_recording,
    FRAGMOTION_OT_duplicate_recording,
    FRAGMOTION_OT_trim_recording,
    FRAGMOTION_OT_export_recording,
    FRAGMOTION_OT_import_recordings,
)
