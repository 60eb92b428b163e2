# SPDX-License-Identifier: GPL-3.0-or-later
"""Let the active armature's character follow a path."""

from __future__ import annotations

from typing import Any, ClassVar

import bpy

from ...bake.performing import character_frame
from ...errors import reported
from ...paths.following import follow
from ...recordings.recordings import NEXT
from ...rig.rigs import make_rig
from ..base.background import poll_character
from ..base.context import active_armature


class FRAGMOTION_OT_follow_path(bpy.types.Operator):
    """Walk the path once, and keep that as a recording."""

    bl_idname = "fragmotion.follow_path"
    bl_label = "Follow Path"
    bl_description = (
        "Let the character walk along the path and keep that as a recording, which is replayed, edited and baked as "
        "any other. Curves that move are taken as they are at the current frame"
    )
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls: Any, context: bpy.types.Context) -> bool:
        return poll_character(cls, context)

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        obj = active_armature(context)
        standing = character_frame(context, obj, make_rig(obj))
        recording, told, warnings = follow(context, obj, obj.fragmotion.path, standing)
        self.report({"INFO"}, f"Recorded '{recording.name}' ({recording.seconds:.1f} s): {told}; {NEXT}")
        for warning in warnings:
            self.report({"WARNING"}, warning)
        return {"FINISHED"}
