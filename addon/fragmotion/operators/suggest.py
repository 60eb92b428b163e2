# SPDX-License-Identifier: GPL-3.0-or-later
"""Find out how many classes to build."""

from __future__ import annotations

from typing import Any, ClassVar

import bpy

from .. import suggesting
from ..jobs import Job
from ..properties import BuildFields
from .background import Background
from .build import poll_build
from .context import active_armature, adopt_settings


class FRAGMOTION_OT_suggest_classes(BuildFields, Background, bpy.types.Operator):
    """Try numbers of classes in the background; to its end at once where there is no window, and when executed."""

    bl_idname = "fragmotion.suggest_classes"
    bl_label = "Suggest Number of Classes"
    bl_description = (
        "Build with several numbers of classes and set the fewest with which the character follows the stick as well "
        "as with any more. Blender stays usable meanwhile; Esc or Cancel stops it"
    )
    bl_options: ClassVar[set[str]] = {"UNDO"}
    verb = "Suggest"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return poll_build(cls, context)

    def _prepare(self, context: bpy.types.Context) -> Job:
        obj = active_armature(context)
        adopt_settings(self, obj.fragmotion.build, BuildFields)
        self._armature, self._before = obj.name, self.classes
        return Job("Trying class numbers", suggesting.prepare(context, obj, self))

    def _keep(self, _context: bpy.types.Context, obj: bpy.types.Object, result: Any) -> None:
        self.report({"INFO"}, suggesting.keep(obj, result, self._before))
