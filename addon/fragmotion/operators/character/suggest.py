# SPDX-License-Identifier: GPL-3.0-or-later
"""Find out how many classes to build."""

from __future__ import annotations

from typing import Any

import bpy

from ...character import suggesting
from ...jobs import Job
from ...settings.build_fields import BuildFields
from .build import Building


class FRAGMOTION_OT_suggest_classes(BuildFields, Building, bpy.types.Operator):
    """Try numbers of classes in the background; to its end at once where there is no window, and when executed."""

    bl_idname = "fragmotion.suggest_classes"
    bl_label = "Suggest Number of Classes"
    bl_description = (
        "Build with several numbers of classes and set the fewest with which the character follows the stick as well "
        "as with any more. Blender stays usable meanwhile; Esc or Cancel stops it"
    )
    verb = "Suggest"

    def _prepare(self, context: bpy.types.Context, obj: bpy.types.Object) -> Job:
        self._before = self.classes
        return Job("Trying class numbers", suggesting.prepare(context, obj, self))

    def _keep(self, _context: bpy.types.Context, obj: bpy.types.Object, result: Any) -> None:
        self.report({"INFO"}, suggesting.keep(obj, result, self._before))
