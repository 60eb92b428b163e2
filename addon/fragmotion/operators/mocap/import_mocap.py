# SPDX-License-Identifier: GPL-3.0-or-later
"""Import a folder of takes."""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar

import bpy
from bpy.props import BoolProperty, CollectionProperty, EnumProperty, StringProperty

from ...errors import UserError, ends_on_error, reported
from ...jobs import Job, SteppedJob
from ...mocap import by_blender
from ...mocap.doctor import tell_size, worst
from ...mocap.importing import METRES, Imported, import_takes
from ...mocap.take_files import ENDINGS, find_takes
from ...rig.bodies import doubts_at_import
from ...rig.rigs import make_rig
from ...settings.drawing import aligned, draw_wrapped
from ...words import counted
from ..base import background
from ..base.background import Exclusive
from ..base.context import active_armature, advise_on_foreign, can_change, check_plain, poll_idle
from ..base.framing import frame_selected

_UNITS = (
    ("AUTO", "By the Body", "What makes the body as tall as people are"),
    ("CENTIMETRES", "Centimetres", "One BVH unit is 0.01 m"),
    ("METRES", "Metres", "One BVH unit is 1 m"),
    ("INCHES", "Inches", "One BVH unit is 0.0254 m"),
)


_MOST_TOLD = 10  # files that are named


class FRAGMOTION_OT_import_mocap(Exclusive, bpy.types.Operator):
    """Import a folder's takes, or those of its files that are selected."""

    bl_idname = "fragmotion.import_mocap"
    bl_label = "Import Mocap"
    bl_description = (
        "Import a folder of motion capture takes (BVH, ASF with AMC, FBX, glTF, VRM, USD), of whatever skeletons, onto "
        "your character or a new armature, an Action for each take. With files selected in the folder, only these. "
        "Esc stops it, and nothing has changed"
    )
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    directory: StringProperty(subtype="DIR_PATH", options={"HIDDEN", "SKIP_SAVE"})  # type: ignore[valid-type]
    files: CollectionProperty(  # type: ignore[valid-type]
        type=bpy.types.OperatorFileListElement, options={"HIDDEN", "SKIP_SAVE"}
    )
    filter_glob: StringProperty(default=f"*{';*'.join((*ENDINGS, '.asf'))}", options={"HIDDEN"})  # type: ignore[valid-type]
    unit: EnumProperty(  # type: ignore[valid-type]
        name="BVH Unit",
        description="Length of one unit in BVH files (all others tell theirs)",
        items=_UNITS,
        default="AUTO",
    )
    onto: EnumProperty(  # type: ignore[valid-type]
        name="Onto",
        description="What the takes move",
        items=(
            ("NEW", "New Armature", "An armature of the takes' own bones"),
            ("ACTIVE", "Active Armature", "The armature that is active, whatever its bones are called: they are found"),
        ),
        default="NEW",
        options={"SKIP_SAVE"},
    )
    mend: BoolProperty(  # type: ignore[valid-type]
        name="Mend",
        description="Put right what is surely wrong with a take: its unit, which way is up, spikes, frozen frames",
        default=True,
    )
    style: EnumProperty(  # type: ignore[valid-type]
        name="Style",
        description="What tells the style of a take",
        items=(
            ("NONE", "None", "Takes are of no style, or get it afterwards"),
            ("FOLDER", "Folder", "Each take is of the style that the folder of its file is called"),
        ),
        default="NONE",
        options={"SKIP_SAVE"},
    )
    character: StringProperty(  # type: ignore[valid-type]
        name="Character",
        description="In files with several armatures, the one whose takes are wanted; empty: the takes of all",
        search=lambda _self, _context, _text: by_blender.seen,
        options={"SKIP_SAVE"},
    )

    verb = "Import"
    patience = 0.5
    _is_asking = False  # which folder

    @classmethod
    def poll(cls, _context: bpy.types.Context) -> bool:
        return poll_idle(cls) and background.poll_idle(cls)

    @ends_on_error
    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if not self.properties.is_property_set("onto") and can_change(active_armature(context)):
            self.onto = "ACTIVE"
        if self.directory:
            outcome: set[str] = super().invoke(context, event)
            return outcome
        self._is_asking = True
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def draw(self, context: bpy.types.Context) -> None:
        if context.space_data is not None and context.space_data.type == "FILE_BROWSER":
            words = "All of this folder and of those in it, or the files that you select"
            draw_wrapped(self.layout.column(align=True), context, words, "INFO")
        column = aligned(self.layout)
        for name in ("onto", "mend", "unit", "style", "character"):
            column.prop(self, name)

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        asked, self._is_asking = self._is_asking, False
        outcome: set[str] = super().invoke(context, None) if asked else super().execute(context)
        return outcome

    def _make_job(self, context: bpy.types.Context) -> Job:
        if not self.directory:
            raise UserError("No folder is chosen")
        folder = Path(bpy.path.abspath(self.directory)).resolve()
        files = find_takes(folder, [file.name for file in self.files if file.name])
        name, unit = folder.name or "Mocap", METRES.get(self.unit)
        steps = import_takes(context, name, files, unit, self._target(context), self.mend, self.character)
        return SteppedJob(f"Importing '{name}'", counted(len(files), "file"), steps)

    def _owner(self) -> None:
        """There may be none yet."""

    def _keep(self, context: bpy.types.Context, _obj: None, result: Imported) -> None:
        if self.onto == "NEW":
            frame_selected(context)
        if self.style == "FOLDER":
            for action, file in zip(result.actions, result.files):
                action.fragmotion.style = file.parent.name
        for cause in result.broken[:_MOST_TOLD]:
            self.report({"WARNING"}, f"Left out: {cause}")
        more = len(result.broken) - _MOST_TOLD
        if more > 0:
            self.report({"WARNING"}, f"Left out: {counted(more, 'more file')} that cannot be used")
        for doubt in _doubts(result) if self.onto == "ACTIVE" else ():
            self.report({"WARNING"}, doubt)
        self.report({"INFO"}, _told(result))

    def _target(self, context: bpy.types.Context) -> bpy.types.Object | None:
        if self.onto == "NEW":
            return None
        obj = active_armature(context)
        if obj is None:
            raise UserError("No armature is active that the takes could move: click your character, or import onto new")
        if not can_change(obj):
            raise UserError(advise_on_foreign(obj))
        check_plain(obj)
        return obj


def _doubts(imported: Imported) -> list[str]:
    return [
        *doubts_at_import(imported.obj),
        *tell_size(imported.actions, make_rig(imported.obj).skeleton),
    ]


def _told(imported: Imported) -> str:
    obj, actions, _, without, broken, resized = imported
    told = f"Imported {counted(len(actions), 'take')} onto armature '{obj.name}' ({len(obj.data.bones)} bones)"
    mended = sum(row.mended for action in actions for row in action.fragmotion.findings)
    left = sum(worst(action) in {"warning", "error"} for action in actions)
    parts = (
        f"{counted(mended, 'fault')} mended" if mended else "",
        f"{counted(resized, 'take')} of other proportions brought onto its body" if resized else "",
        f"{counted(left, 'take')} to look at in Doctor" if left else "",
        f"{counted(len(without), 'file')} left out in which no armature is animated" if without else "",
        f"{counted(len(broken), 'file')} left out that cannot be used" if broken else "",
    )
    return "; ".join([told, *filter(None, parts)])


def _drop_handlers() -> tuple[type, ...]:
    """What imports files that are dropped into a viewport, from Blender 4.1 on."""
    if not hasattr(bpy.types, "FileHandler"):
        return ()

    class FRAGMOTION_FH_import_mocap(bpy.types.FileHandler):
        """Motion capture that is dropped moves the active armature, or a new one."""

        bl_idname = "FRAGMOTION_FH_import_mocap"
        bl_label = "Fragmotion: Import Mocap"
        bl_import_operator = FRAGMOTION_OT_import_mocap.bl_idname
        bl_file_extensions = ";".join(ENDINGS)

        @classmethod
        def poll_drop(cls, context: bpy.types.Context) -> bool:
            return context.area is not None and context.area.type == "VIEW_3D"

    return (FRAGMOTION_FH_import_mocap,)


DROP_HANDLERS = _drop_handlers()
