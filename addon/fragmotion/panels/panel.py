# SPDX-License-Identifier: GPL-3.0-or-later
"""The Fragmotion tab of the 3D viewport's sidebar, in the order of the work."""

from __future__ import annotations

import bpy

from ..character import building
from ..character.coverage_picture import draw_pictures
from ..character.staleness import is_stale
from ..compat import versions
from ..control_rig.binding import own_armatures
from ..mocap.actions import fits_cached, fitting
from ..mocap.doctor import worst
from ..operators import background
from ..operators.context import active_armature
from ..settings.drawing import (
    draw_bake,
    draw_build,
    draw_coverage,
    draw_figures,
    draw_keeping,
    draw_summary,
    draw_training,
)
from . import bones, classes, control_rig, doctor, drive, left_out, moves, recordings
from .doctor import LIGHTS
from .sidebar import Sidebar, SubPanel

_ROWS = 5


class FRAGMOTION_UL_actions(bpy.types.UIList):
    """The file's Actions that fit the active armature, each with a tick."""

    bl_idname = "FRAGMOTION_UL_actions"

    def draw_item(
        self,
        _context: bpy.types.Context,
        layout: bpy.types.UILayout,
        _data: object,
        item: bpy.types.Action,
        _icon: int,
        _active_data: object,
        _active_name: str,
    ) -> None:
        row = layout.row(align=True)
        row.prop(item.fragmotion, "use", text="")
        row.label(text=item.name, translate=False)
        severity = worst(item)
        if severity in {"error", "warning"}:
            row.label(text="", icon=LIGHTS[severity])

    def filter_items(self, context: bpy.types.Context, data: object, name: str) -> tuple[list[int], list[int]]:
        actions, obj = getattr(data, name), active_armature(context)
        by_name = bpy.types.UI_UL_list.filter_items_by_name(self.filter_name, self.bitflag_filter_item, actions)
        named = by_name or [self.bitflag_filter_item] * len(actions)
        return [flag if obj and fits_cached(action, obj) else 0 for flag, action in zip(named, actions)], []


def _has_other_armatures(obj: bpy.types.Object) -> bool:
    """Whether the file has armatures beside the object's; quick enough for drawing."""
    own = own_armatures(obj)
    return any(armature.users and armature not in own for armature in bpy.data.armatures)


class FRAGMOTION_PT_mocap(Sidebar, bpy.types.Panel):
    """What the character learns from."""

    bl_idname = "FRAGMOTION_PT_mocap"
    bl_label = "Mocap"

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        layout.operator("fragmotion.import_mocap", text="Import Mocap...", icon="IMPORT")
        obj = active_armature(context)
        if obj is None:
            layout.label(text="Click your character, or:", icon="INFO")
            layout.operator("fragmotion.add_sample", icon="OUTLINER_OB_ARMATURE")
            return
        if obj.fragmotion.source or _has_other_armatures(obj):
            row = layout.row(align=True)
            row.prop(obj.fragmotion, "source", text="")
            row.operator("fragmotion.retarget_actions", text="Retarget")
        if obj != context.active_object:
            layout.label(text=obj.name, icon="ARMATURE_DATA", translate=False)
        actions = fitting(obj)
        if not actions:
            layout.label(text=f"No Actions for '{obj.name}'", icon="INFO")
            return
        layout.template_list(
            "FRAGMOTION_UL_actions",
            "",
            bpy.data,
            "actions",
            context.window_manager.fragmotion,
            "active_action",
            rows=_ROWS,
        )
        row = layout.row(align=True)
        row.label(text=f"{sum(action.fragmotion.use for action in actions)} of {len(actions)}")
        row.operator("fragmotion.tick_actions", text="All").use = True
        row.operator("fragmotion.tick_actions", text="None").use = False


class FRAGMOTION_PT_build(Sidebar, bpy.types.Panel):
    """From takes to a character."""

    bl_idname = "FRAGMOTION_PT_build"
    bl_label = "Build"

    def draw(self, context: bpy.types.Context) -> None:
        layout, obj, job = self.layout, active_armature(context), background.current
        if job is not None:
            layout.label(text=job.label)
            versions.draw_progress(layout, job.fraction, job.stage)
            layout.operator("fragmotion.cancel", text="Cancel", icon="CANCEL")
            return
        if obj is not None:
            draw_build(layout, obj.fragmotion.build)
        layout.operator("fragmotion.build", icon="SHADERFX")
        if obj is None or not building.has_character(obj):
            return
        if is_stale(obj):
            layout.label(text="Stale: Actions changed", icon="ERROR")
        draw_summary(layout, obj.fragmotion.figures)


class _BuildSubPanel(SubPanel):
    bl_parent_id = "FRAGMOTION_PT_build"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return super().poll(context) and background.current is None


class FRAGMOTION_PT_figures(_BuildSubPanel, bpy.types.Panel):
    """What the last build found."""

    bl_idname = "FRAGMOTION_PT_figures"
    bl_label = "Figures"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return super().poll(context) and building.has_character(active_armature(context))

    def draw(self, context: bpy.types.Context) -> None:
        draw_figures(self.layout, active_armature(context).fragmotion.figures)


class FRAGMOTION_PT_coverage(_BuildSubPanel, bpy.types.Panel):
    """Which controls the character performs well."""

    bl_idname = "FRAGMOTION_PT_coverage"
    bl_label = "Coverage"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return super().poll(context) and len(active_armature(context).fragmotion.figures.coverage) > 0

    def draw(self, context: bpy.types.Context) -> None:
        figures = active_armature(context).fragmotion.figures
        if figures.distances:
            draw_pictures(self.layout, figures.distances, context.region.width)
        draw_coverage(self.layout, figures)


class FRAGMOTION_PT_training(_BuildSubPanel, bpy.types.Panel):
    """What the policy learns from, and how."""

    bl_idname = "FRAGMOTION_PT_training"
    bl_label = "Training"

    def draw(self, context: bpy.types.Context) -> None:
        draw_training(self.layout, active_armature(context).fragmotion.build)


class FRAGMOTION_PT_policy(_BuildSubPanel, bpy.types.Panel):
    """Where the policy is kept, and its way to and from other files."""

    bl_idname = "FRAGMOTION_PT_policy"
    bl_label = "Policy File"

    def draw(self, context: bpy.types.Context) -> None:
        obj = active_armature(context)
        if building.has_character(obj):
            draw_keeping(self.layout, obj)
        row = self.layout.row(align=True)
        row.operator("fragmotion.save_policy", text="Save...")
        row.operator("fragmotion.load_policy", text="Load...")


class FRAGMOTION_PT_bake(Sidebar, bpy.types.Panel):
    """From a trace to an Action."""

    bl_idname = "FRAGMOTION_PT_bake"
    bl_label = "Bake"

    def draw(self, context: bpy.types.Context) -> None:
        obj = active_armature(context)
        if obj is not None:
            draw_bake(self.layout, obj.fragmotion.bake)
        self.layout.operator("fragmotion.bake", icon="ACTION_TWEAK")


CLASSES = (
    *control_rig.CLASSES,
    FRAGMOTION_UL_actions,
    FRAGMOTION_PT_mocap,
    *left_out.CLASSES,
    *doctor.CLASSES,
    *bones.CLASSES,
    FRAGMOTION_PT_build,
    *classes.BUILD_PANELS,
    FRAGMOTION_PT_training,
    FRAGMOTION_PT_figures,
    *classes.CLASS_PANELS,
    FRAGMOTION_PT_coverage,
    FRAGMOTION_PT_policy,
    *drive.CLASSES,
    *moves.CLASSES,
    *recordings.CLASSES,
    FRAGMOTION_PT_bake,
    *recordings.BAKE_CLASSES,
)
