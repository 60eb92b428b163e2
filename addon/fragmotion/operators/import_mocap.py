# SPDX-License-Identifier: GPL-3.0-or-later
"""Import a folder of takes."""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar

import bpy
from bpy.props import CollectionProperty, EnumProperty, StringProperty

from ..errors import UserError, reported
from ..mocap.importing import METRES, find_takes, import_takes

_UNITS = (
    ("CENTIMETRES", "Centimetres", "One BVH unit is 0.01 m"),
    ("METRES", "Metres", "One BVH unit is 1 m"),
    ("INCHES", "Inches", "One BVH unit is 0.0254 m"),
)


class FRAGMOTION_OT_import_mocap(bpy.types.Operator):
    """Import a folder's takes, or those of its files that are selected."""

    bl_idname = "fragmotion.import_mocap"
    bl_label = "Import Mocap"
    bl_description = (
        "Import a folder of motion capture takes (BVH, or ASF with AMC) onto one new armature, an Action for each "
        "take. With files selected in the folder, only these"
    )
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    directory: StringProperty(subtype="DIR_PATH", options={"HIDDEN", "SKIP_SAVE"})  # type: ignore[valid-type]
    files: CollectionProperty(  # type: ignore[valid-type]
        type=bpy.types.OperatorFileListElement, options={"HIDDEN", "SKIP_SAVE"}
    )
    filter_glob: StringProperty(default="*.bvh;*.asf;*.amc", options={"HIDDEN"})  # type: ignore[valid-type]
    unit: EnumProperty(  # type: ignore[valid-type]
        name="BVH Unit",
        description="Length of one unit in BVH files (ASF files tell theirs)",
        items=_UNITS,
        default="CENTIMETRES",
    )

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        if not self.directory:
            raise UserError("No folder is chosen")
        folder = Path(bpy.path.abspath(self.directory)).resolve()
        files = find_takes(folder, [file.name for file in self.files if file.name])
        manager = context.window_manager
        manager.progress_begin(0, 100)
        try:
            obj, actions = import_takes(
                context,
                folder.name or "Mocap",
                files,
                METRES[self.unit],
                lambda fraction: manager.progress_update(100 * fraction),
            )
        finally:
            manager.progress_end()
        self.report({"INFO"}, f"Imported {len(actions)} takes onto armature '{obj.name}' ({len(obj.data.bones)} bones)")
        return {"FINISHED"}
