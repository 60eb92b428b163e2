# SPDX-License-Identifier: GPL-3.0-or-later
"""Find what the bones of the armature are to a body, and keep it as a preset."""

from __future__ import annotations

from pathlib import Path
from typing import ClassVar

import bpy
from bpy.props import StringProperty
from bpy_extras.io_utils import ImportHelper

from ...errors import UserError, reported
from ...rig.bodies import DoubtfulBone, chosen_roles, find_and_doubt, read_roles, save_roles, set_roles
from ...rig.rigs import make_rig
from ...rig.selection import highlight, select
from ..base.context import active_armature, poll_armature
from ..base.saving import Saving

EXTENSION = ".json"


class FRAGMOTION_OT_find_bones(bpy.types.Operator):
    """Find which bone is the hips, a thigh, a hand ..., by their names and where those say nothing by their shape"""

    bl_idname = "fragmotion.find_bones"
    bl_label = "Find Bones"
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return poll_armature(cls, context)

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        obj = active_armature(context)
        doubts = find_and_doubt(obj, make_rig(obj))
        missing = [role.name for role in obj.fragmotion.roles if not role.bone]
        told = f"Found {len(chosen_roles(obj) or ())} bones of the body"
        for doubt in doubts:
            self.report({"WARNING"}, doubt)
        self.report({"INFO"}, f"{told}; not found: {', '.join(missing)}" if missing else told)
        return {"FINISHED"}


class _OfDoubtfulBone:
    """Of the bone that is doubtful as the role."""

    role: StringProperty(options={"HIDDEN", "SKIP_SAVE"})  # type: ignore[valid-type]

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return poll_armature(cls, context)

    def _doubt(self, obj: bpy.types.Object) -> DoubtfulBone:
        doubt: DoubtfulBone | None = obj.fragmotion.doubts.get(self.role)
        if doubt is None or doubt.bone not in obj.data.bones:
            raise UserError(f"Armature '{obj.name}': nothing is doubtful about its {self.role or 'bones'} any more")
        return doubt


class FRAGMOTION_OT_confirm_bone(_OfDoubtfulBone, bpy.types.Operator):
    """The bone is what it is taken for: the doubt goes away, and the bone stays that part of the body"""

    bl_idname = "fragmotion.confirm_bone"
    bl_label = "That Is Right"
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        self._doubt(active_armature(context)).right = True
        return {"FINISHED"}


class FRAGMOTION_OT_show_bone(_OfDoubtfulBone, bpy.types.Operator):
    """Select the bone, in Pose Mode"""

    bl_idname = "fragmotion.show_bone"
    bl_label = "Show the Bone"
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        obj = active_armature(context)
        bone = self._doubt(obj).bone
        if not obj.visible_get():
            raise UserError(f"Armature '{obj.name}' is hidden: show it first (Outliner)")
        if context.mode != "POSE":
            select(context, [obj], obj)
            bpy.ops.object.mode_set(mode="POSE")
        highlight(obj, [bone])
        return {"FINISHED"}


class FRAGMOTION_OT_save_bones(Saving, bpy.types.Operator):
    """Save which bone is which, for other characters with the same bones"""

    bl_idname = "fragmotion.save_bones"
    bl_label = "Save Bones"
    bl_options: ClassVar[set[str]] = {"REGISTER"}

    filename_ext = EXTENSION
    filter_glob: StringProperty(default=f"*{EXTENSION}", options={"HIDDEN"})  # type: ignore[valid-type]

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        obj = active_armature(context)
        if obj is None or chosen_roles(obj) is None:
            cls.poll_message_set("Nothing to save: press Find Bones first")
            return False
        return True

    def _suggestion(self, context: bpy.types.Context) -> str:
        return f"{active_armature(context).name} bones"

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        path = self._path()
        save_roles(active_armature(context), path)
        self.report({"INFO"}, f"Saved '{path}'")
        return {"FINISHED"}


class FRAGMOTION_OT_load_bones(ImportHelper, bpy.types.Operator):
    """Load which bone is which from a preset"""

    bl_idname = "fragmotion.load_bones"
    bl_label = "Load Bones"
    bl_options: ClassVar[set[str]] = {"UNDO"}

    filename_ext = EXTENSION
    filter_glob: StringProperty(default=f"*{EXTENSION}", options={"HIDDEN"})  # type: ignore[valid-type]

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return poll_armature(cls, context)

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        if not self.filepath:
            raise UserError("No file is chosen")
        obj = active_armature(context)
        set_roles(obj, read_roles(obj, Path(bpy.path.abspath(self.filepath))))
        self.report({"INFO"}, f"Armature '{obj.name}' has {len(chosen_roles(obj) or ())} bones of a body")
        return {"FINISHED"}


CLASSES = (
    FRAGMOTION_OT_find_bones,
    FRAGMOTION_OT_confirm_bone,
    FRAGMOTION_OT_show_bone,
    FRAGMOTION_OT_save_bones,
    FRAGMOTION_OT_load_bones,
)
