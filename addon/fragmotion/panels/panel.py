# SPDX-License-Identifier: GPL-3.0-or-later
"""The Fragmotion tab of the 3D viewport's sidebar, in the order of the work."""

from __future__ import annotations

from collections.abc import Sequence
from typing import ClassVar

import bpy

from ..character import building
from ..character.classes import shown_style
from ..character.control_layout import kept_layout
from ..character.coverage_picture import draw_pictures
from ..character.staleness import is_stale
from ..compat import versions
from ..control_rig.binding import own_armatures
from ..jobs import SteppedJob
from ..mocap.actions import chosen, common_beginning, fits_cached, fitting, is_found, seconds_of
from ..mocap.doctor import worst
from ..operators.base import background
from ..operators.base.context import active_armature
from ..preview.take_preview import TakePreview
from ..rig.bodies import open_doubts
from ..settings import preferences
from ..settings.drawing import (
    aligned,
    draw_bake_buttons,
    draw_baked,
    draw_build,
    draw_build_advanced,
    draw_coverage,
    draw_figures,
    draw_keeping,
    draw_shown_style,
    draw_summary,
    draw_training,
    draw_wrapped,
)
from . import (
    bones,
    classes,
    control_rig,
    doctor,
    drive,
    first_steps,
    game,
    left_out,
    moves,
    path,
    recordings,
    storyboard,
)
from .doctor import LIGHTS
from .sidebar import Sidebar, SubPanel, TakePanel, draw_fold, draw_play, is_folded

_FEWEST_ROWS, _MOST_ROWS = 5, 8  # of the list, unless the user draws it larger
_NAME = 0.76  # of a row's width
_LONG = 10.0  # s of a take whose tenths do not matter
_FEW = 5  # takes among which there is nothing to be searched


class FRAGMOTION_UL_actions(bpy.types.UIList):
    """The file's Actions that fit the active armature, each with a tick and its length."""

    bl_idname = "FRAGMOTION_UL_actions"
    beginning: ClassVar[str] = ""
    """What the names of all takes of the list begin with: it is not said of each."""

    def draw_item(
        self,
        context: bpy.types.Context,
        layout: bpy.types.UILayout,
        _data: object,
        item: bpy.types.Action,
        _icon: int,
        active_data: object,
        active_name: str,
    ) -> None:
        row = layout.row(align=True)
        row.prop(item.fragmotion, "use", text="")
        split = row.split(factor=_NAME)
        actions, chosen = bpy.data.actions, getattr(active_data, active_name)
        if self.beginning and not (0 <= chosen < len(actions) and actions[chosen] == item):
            split.label(text=item.name.removeprefix(self.beginning), translate=False)
        else:
            split.prop(item, "name", text="", emboss=False)  # a double click renames it
        length = split.row()
        length.alignment = "RIGHT"
        length.label(text=_length(seconds_of(item, context.scene)), translate=False)
        severity = worst(item)
        if severity in {"error", "warning"}:
            row.label(text="", icon=LIGHTS[severity])

    def filter_items(self, context: bpy.types.Context, data: object, name: str) -> tuple[list[int], list[int]]:
        actions, obj = getattr(data, name), active_armature(context)
        settings = context.window_manager.fragmotion
        by_name = bpy.types.UI_UL_list.filter_items_by_name(self.filter_name, self.bitflag_filter_item, actions)
        named = by_name or [self.bitflag_filter_item] * len(actions)
        fitting_obj = [obj is not None and fits_cached(action, obj) for action in actions]
        names = [action.name for action, fits in zip(actions, fitting_obj) if fits]
        FRAGMOTION_UL_actions.beginning = common_beginning(names)
        found = [fits and is_found(action, settings.take_search) for action, fits in zip(actions, fitting_obj)]
        order = _order(actions, context.scene, settings.take_order)
        return [flag if fits else 0 for flag, fits in zip(named, found)], order


def _length(seconds: float) -> str:
    return f"{seconds:.1f} s" if seconds < _LONG else f"{seconds:.0f} s"


def _order(actions: Sequence[bpy.types.Action], scene: bpy.types.Scene, order: str) -> list[int]:
    """The place in the list of each of the Actions; none where they stay as they are, by name."""
    if order == "NAME":
        return []
    sign = -1 if order == "LONGEST" else 1
    lengths = [(sign * seconds_of(action, scene), index) for index, action in enumerate(actions)]
    places = [0] * len(lengths)
    for place, (_, index) in enumerate(sorted(lengths)):
        places[index] = place
    return places


def _has_other_armatures(obj: bpy.types.Object) -> bool:
    """Whether the file has armatures beside the object's; quick enough for drawing."""
    own = own_armatures(obj)
    return any(armature.users and armature not in own for armature in bpy.data.armatures)


class FRAGMOTION_PT_mocap(Sidebar, bpy.types.Panel):
    """What the character learns from."""

    bl_idname = "FRAGMOTION_PT_mocap"
    bl_label = "Mocap"

    def draw(self, context: bpy.types.Context) -> None:
        layout, obj = self.layout, active_armature(context)
        actions = fitting(obj) if obj is not None else []
        ticked = sum(action.fragmotion.use for action in actions)
        if obj is not None and building.has_character(obj):
            draw_fold(layout, context, "mocap", f"{ticked} of {len(actions)} takes")
        if is_folded(context, "mocap"):
            return
        layout.operator("fragmotion.import_mocap", text="Import Mocap...", icon="IMPORT")
        if obj is None:
            if not preferences.get(context).first_steps:
                layout.label(text="Click your character, or:", icon="INFO")
                layout.operator("fragmotion.add_sample", icon="OUTLINER_OB_ARMATURE")
            return
        if obj.fragmotion.source or _has_other_armatures(obj):
            row = layout.row(align=True)
            row.prop(obj.fragmotion, "source", text="")
            row.operator("fragmotion.retarget_actions", text="Retarget")
        if obj != context.active_object:
            layout.label(text=obj.name, icon="ARMATURE_DATA", translate=False)
        if not actions:
            draw_wrapped(layout.column(align=True), context, f"No Actions for '{obj.name}'", "INFO")
            return
        _draw_doubts(layout, context, obj)
        _draw_takes(layout, context, obj, len(actions))
        if obj.animation_data is not None and obj.animation_data.nla_tracks:
            layout.operator("fragmotion.take_strips", icon="NLA")


def _draw_doubts(layout: bpy.types.UILayout, context: bpy.types.Context, obj: bpy.types.Object) -> None:
    """The bones that may not be what they are taken for, red until the user says in the panel below what they are."""
    bones = [f"'{doubt.bone}'" for doubt in open_doubts(obj)]
    if bones:
        column = layout.column(align=True)
        column.alert = True
        draw_wrapped(column, context, f"See Bones for {', '.join(bones)}", "ERROR")


def _draw_takes(layout: bpy.types.UILayout, context: bpy.types.Context, obj: bpy.types.Object, count: int) -> None:
    """The list of takes, with what finds, plays and ticks them."""
    settings = context.window_manager.fragmotion
    if count > _FEW:
        row = layout.row(align=True)
        row.prop(settings, "take_search", text="", icon="VIEWZOOM")
        row.prop(settings, "take_order", text="", icon_only=True)
    rows = min(max(count, _FEWEST_ROWS), _MOST_ROWS)
    layout.template_list(
        "FRAGMOTION_UL_actions", "", bpy.data, "actions", settings, "active_action", rows=rows, maxrows=rows
    )
    row = layout.row(align=True)
    draw_play(row, "fragmotion.play_take", "Play", TakePreview)
    for text, use in (("All", True), ("None", False)):
        tick = row.operator("fragmotion.tick_actions", text=text)
        tick.use, tick.search = use, settings.take_search
    beginning = FRAGMOTION_UL_actions.beginning
    if beginning:
        draw_wrapped(layout.column(align=True), context, f"All begin with '{beginning}'", "INFO")


class FRAGMOTION_PT_take_style(TakePanel, bpy.types.Panel):
    """What style the chosen take is of."""

    bl_idname = "FRAGMOTION_PT_take_style"
    bl_label = "Style"

    def draw(self, context: bpy.types.Context) -> None:
        action = chosen(context, active_armature(context))
        if action is None:
            return
        row = self.layout.row(align=True)
        row.prop(action.fragmotion, "style", text="")
        row.operator("fragmotion.set_style", text="", icon="PRESET")


class FRAGMOTION_PT_build(Sidebar, bpy.types.Panel):
    """From takes to a character."""

    bl_idname = "FRAGMOTION_PT_build"
    bl_label = "Build"

    def draw(self, context: bpy.types.Context) -> None:
        layout, obj, job = self.layout, active_armature(context), background.current
        if job is not None:
            draw_wrapped(layout.column(align=True), context, job.label)
            versions.draw_progress(layout, job.fraction, job.stage)
            if isinstance(job, SteppedJob):
                layout.label(text="Esc stops")
            else:
                layout.operator("fragmotion.cancel", text="Cancel", icon="CANCEL")
            return
        if obj is not None and building.has_character(obj):
            column = layout.column(align=True)
            draw_fold(column, context, "build", "Build Again")
            draw_summary(column, context, obj.fragmotion.figures, is_folded(context, "build"))
            if is_stale(obj):
                layout.label(text="Stale: Actions changed", icon="ERROR")
        if is_folded(context, "build"):
            return
        takes = fitting(obj) if obj is not None else []
        if takes and not any(action.fragmotion.use for action in takes):
            draw_wrapped(layout.column(align=True), context, "Tick what it is to learn from, under Mocap", "INFO")
        layout.operator("fragmotion.build", icon="SHADERFX")


class _BuildSubPanel(SubPanel):
    bl_parent_id = "FRAGMOTION_PT_build"
    folds = "build"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return super().poll(context) and background.current is None


class FRAGMOTION_PT_build_options(_BuildSubPanel, bpy.types.Panel):
    """The fields of a build that are changed most."""

    bl_idname = "FRAGMOTION_PT_build_options"
    bl_label = "Build Options"

    def draw(self, context: bpy.types.Context) -> None:
        settings = active_armature(context).fragmotion
        draw_build(self.layout, settings.build)
        column = aligned(self.layout)
        column.prop(settings, "hands")
        if settings.hands == "ACTION":
            column.prop(settings, "hand_action")


class FRAGMOTION_PT_figures(_BuildSubPanel, bpy.types.Panel):
    """What the last build found."""

    bl_idname = "FRAGMOTION_PT_figures"
    bl_label = "Figures"
    bl_parent_id = "FRAGMOTION_PT_build_advanced"

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
        draw_shown_style(self.layout, figures)
        if figures.styles:
            figures = figures.styles[shown_style(figures)]
        if figures.distances:
            draw_pictures(self.layout, figures.distances, kept_layout(figures), context.region.width)
        draw_coverage(self.layout, figures)


class FRAGMOTION_PT_training(_BuildSubPanel, bpy.types.Panel):
    """What the policy learns to perform, and from whom."""

    bl_idname = "FRAGMOTION_PT_training"
    bl_label = "Training"
    bl_parent_id = "FRAGMOTION_PT_build_advanced"

    def draw(self, context: bpy.types.Context) -> None:
        draw_training(self.layout, active_armature(context).fragmotion.build)


class FRAGMOTION_PT_build_advanced(_BuildSubPanel, bpy.types.Panel):
    """What hardly anybody need change: the policy, where takes are cut, and the seed."""

    bl_idname = "FRAGMOTION_PT_build_advanced"
    bl_label = "Advanced"

    def draw(self, context: bpy.types.Context) -> None:
        draw_build_advanced(self.layout, active_armature(context).fragmotion.build)


class FRAGMOTION_PT_policy(_BuildSubPanel, bpy.types.Panel):
    """Where the policy is kept, and its way to and from other files."""

    bl_idname = "FRAGMOTION_PT_policy"
    bl_label = "Policy File"
    bl_parent_id = "FRAGMOTION_PT_build_advanced"

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
            draw_baked(self.layout, obj.fragmotion.bake, obj)
        draw_bake_buttons(self.layout, obj)


CLASSES = (
    *first_steps.CLASSES,
    *control_rig.CLASSES,
    FRAGMOTION_UL_actions,
    FRAGMOTION_PT_mocap,
    FRAGMOTION_PT_take_style,
    *left_out.CLASSES,
    *doctor.CLASSES,
    *bones.CLASSES,
    FRAGMOTION_PT_build,
    FRAGMOTION_PT_build_options,
    *classes.BUILD_PANELS,
    *classes.CLASS_PANELS,
    FRAGMOTION_PT_coverage,
    FRAGMOTION_PT_build_advanced,
    FRAGMOTION_PT_training,
    FRAGMOTION_PT_figures,
    *classes.ADVANCED_PANELS,
    FRAGMOTION_PT_policy,
    *drive.CLASSES,
    *moves.CLASSES,
    *path.CLASSES,
    *storyboard.CLASSES,
    *recordings.CLASSES,
    FRAGMOTION_PT_bake,
    *recordings.BAKE_CLASSES,
    *control_rig.BOUND_CLASSES,
    *game.CLASSES,
)
