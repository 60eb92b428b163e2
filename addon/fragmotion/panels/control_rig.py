# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel of a rig whose bones are moved by controls."""

from __future__ import annotations

import bpy

from ..compat import versions
from ..control_rig import binding
from ..control_rig.detecting import is_control_rig
from ..operators.base import background
from ..operators.base.context import active_rig
from ..settings.drawing import aligned
from .sidebar import Sidebar


class FRAGMOTION_PT_control_rig(Sidebar, bpy.types.Panel):
    """Makes a control rig follow a motion skeleton."""

    bl_idname = "FRAGMOTION_PT_control_rig"
    bl_label = "Control Rig"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        rig = active_rig(context)
        return rig is not None and not binding.is_bound(rig) and is_control_rig(rig)

    def draw(self, _context: bpy.types.Context) -> None:
        self.layout.label(text="Moved by controls", icon="INFO")
        self.layout.operator("fragmotion.bind_rig", icon="ARMATURE_DATA")


class FRAGMOTION_PT_bound_rig(Sidebar, bpy.types.Panel):
    """Whether the rig follows, and keys of that on its controls: below Bake, which comes before them."""

    bl_idname = "FRAGMOTION_PT_bound_rig"
    bl_label = "Control Rig"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        rig = active_rig(context)
        return rig is not None and binding.is_bound(rig)

    def draw(self, context: bpy.types.Context) -> None:
        layout, rig, job = self.layout, active_rig(context), background.current
        if job is not None:
            versions.draw_progress(layout, job.fraction, job.stage)
        row = layout.row(align=True)
        row.operator("fragmotion.follow_motion", icon="CON_ARMATURE", depress=binding.follows(rig))
        row.operator("fragmotion.unbind_rig", icon="X")
        motion = binding.motion_of(rig)
        if motion is not None and motion.animation_data is not None:
            aligned(layout).prop(motion.animation_data, "action", text="Plays")
        layout.operator("fragmotion.bake_to_controls", icon="ACTION_TWEAK")


CLASSES = (FRAGMOTION_PT_control_rig,)
BOUND_CLASSES = (FRAGMOTION_PT_bound_rig,)
