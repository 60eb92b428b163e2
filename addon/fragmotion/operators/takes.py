# SPDX-License-Identifier: GPL-3.0-or-later
"""Keep the active armature's takes in order."""

from __future__ import annotations

from pathlib import Path
from typing import Any, ClassVar

import bpy
from bpy.props import CollectionProperty, FloatProperty, StringProperty
from bpy_extras.io_utils import ImportHelper

from ..bake.performing import measure_quality, origin_frame
from ..compat.core import core
from ..errors import UserError, core_errors, reported
from ..files import check_regular
from ..recordings.recordings import TRACE_RATE, active_take, add_take, duplicate_take, remove_take, trace_of, trim_take
from .context import active_armature, poll_armature
from .saving import Saving

EXTENSION = ".csv"
_FEWEST_ROWS = 2  # of a trace file


class _OnTake:
    """An operator on the take that is selected in the list."""

    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if not poll_armature(cls, context):
            return False
        obj: Any = active_armature(context)
        if active_take(obj) is None:
            cls.poll_message_set(f"Armature '{obj.name}' has no takes: record or import one")  # type: ignore[attr-defined]
        return active_take(obj) is not None


class FRAGMOTION_OT_delete_take(_OnTake, bpy.types.Operator):
    """Delete the selected take"""

    bl_idname = "fragmotion.delete_take"
    bl_label = "Delete Take"

    def execute(self, context: bpy.types.Context) -> set[str]:
        obj = active_armature(context)
        name = _selected(context).name
        remove_take(obj, obj.fragmotion.active_take)
        self.report({"INFO"}, f"Deleted take '{name}'")
        return {"FINISHED"}


class FRAGMOTION_OT_duplicate_take(_OnTake, bpy.types.Operator):
    """Copy the selected take, to trim the copy or train on it"""

    bl_idname = "fragmotion.duplicate_take"
    bl_label = "Duplicate Take"

    def execute(self, context: bpy.types.Context) -> set[str]:
        obj = active_armature(context)
        duplicate_take(obj, obj.fragmotion.active_take)
        return {"FINISHED"}


def _cut(name: str, dropped: str, default: float, least: float) -> Any:
    """A time in a take, to the tenth of a second that a control lasts."""
    return FloatProperty(
        name=name,
        description=f"What comes {dropped} is dropped; seconds from the take's beginning, to the nearest tenth",
        default=default,
        min=least,
        step=10,
        precision=1,
        unit="TIME_ABSOLUTE",
    )


class FRAGMOTION_OT_trim_take(_OnTake, bpy.types.Operator):
    """Keep only a part of the selected take. What the character did in that part is kept, too"""

    bl_idname = "fragmotion.trim_take"
    bl_label = "Trim Take"

    start: _cut("Start", "before", 0.0, 0.0)  # type: ignore[valid-type]
    end: _cut("End", "after", 60.0, 0.1)  # type: ignore[valid-type]

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        self.start, self.end = 0.0, _selected(context).seconds
        result: set[str] = context.window_manager.invoke_props_dialog(self)
        return result

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        obj, take = active_armature(context), _selected(context)
        trim_take(take, self.start, self.end)
        take.quality = measure_quality(obj, take)
        self.report({"INFO"}, f"Take '{take.name}' lasts {take.seconds:.1f} s now")
        return {"FINISHED"}


class FRAGMOTION_OT_export_take(_OnTake, Saving, bpy.types.Operator):
    """Write the selected take's controls to a CSV file: velocity_x,velocity_y (m/s),turn,jump; 10 rows a second"""

    bl_idname = "fragmotion.export_take"
    bl_label = "Export Take"
    bl_options: ClassVar[set[str]] = {"REGISTER"}

    filename_ext = EXTENSION
    filter_glob: StringProperty(default=f"*{EXTENSION}", options={"HIDDEN"})  # type: ignore[valid-type]

    def _suggestion(self, context: bpy.types.Context) -> str:
        return str(_selected(context).name)

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        path = self._path()
        take = _selected(context)
        trace = trace_of(take)
        if len(trace) < _FEWEST_ROWS:
            raise UserError(f"Take '{take.name}' holds a single control: record a longer one to export")
        with core_errors():
            core.write_trace(path, trace)
        self.report({"INFO"}, f"Saved take '{take.name}' ({take.seconds:.1f} s) to '{path}'")
        return {"FINISHED"}


class FRAGMOTION_OT_import_takes(ImportHelper, bpy.types.Operator):
    """Read takes from CSV files; nothing is imported where one is malformed."""

    bl_idname = "fragmotion.import_takes"
    bl_label = "Import Takes"
    bl_description = (
        "Read takes from CSV files with the header velocity_x,velocity_y,turn,jump: velocity to the right and forward "
        "in m/s, turn from -1 (right) to 1 (left), jump 0 or 1; 10 rows a second"
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
            check_regular(path)
            with core_errors():
                traces[path] = core.read_trace(path)
        for path, trace in traces.items():
            take = add_take(obj, trace, name=path.stem, start=origin_frame(obj))
            take.quality = measure_quality(obj, take)
        self.report({"INFO"}, f"Imported {len(traces)} takes ({sum(map(len, traces.values())) / TRACE_RATE:.1f} s)")
        return {"FINISHED"}

    def _paths(self) -> list[Path]:
        """The chosen files; UserError where there is none."""
        names = [file.name for file in self.files if file.name]
        folder = Path(bpy.path.abspath(self.directory))
        paths = [folder / name for name in names] or [Path(bpy.path.abspath(self.filepath))] * bool(self.filepath)
        if not paths:
            raise UserError("No file is chosen")
        return paths


def _selected(context: bpy.types.Context) -> Any:
    """The take that `_OnTake.poll` found."""
    return active_take(active_armature(context))


CLASSES = (
    FRAGMOTION_OT_delete_take,
    FRAGMOTION_OT_duplicate_take,
    FRAGMOTION_OT_trim_take,
    FRAGMOTION_OT_export_take,
    FRAGMOTION_OT_import_takes,
)
