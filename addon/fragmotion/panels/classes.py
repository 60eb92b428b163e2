# SPDX-License-Identifier: GPL-3.0-or-later
"""The sub-panels of the classes: which there are, why one is chosen, and how many to build."""

from __future__ import annotations

from typing import Any, ClassVar

import bpy

from ..character import classes, inspector
from ..character.control_layout import ControlLayout, kept_layout
from ..errors import UserError
from ..operators.base import background
from ..operators.base.context import active_armature
from ..preview.class_preview import ClassPreview
from ..settings.drawing import draw_shown_style, draw_wrapped
from ..words import counted
from .sidebar import SubPanel, draw_play

_ROWS = 7
_WIDE = 260  # pixels of a sidebar that has room for more than a name beside it


class _SubPanel(SubPanel):
    bl_parent_id = "FRAGMOTION_PT_build"
    folds = "build"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return super().poll(context) and background.current is None


class _ClassPanel(_SubPanel):
    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return super().poll(context) and len(active_armature(context).fragmotion.classes) > 0


def _is_wide(context: bpy.types.Context) -> bool:
    return bool(context.region.width > _WIDE * context.preferences.system.ui_scale)


class FRAGMOTION_UL_classes(bpy.types.UIList):
    """The classes: name, whether each is left out and, where there is room, its control and number of fragments."""

    bl_idname = "FRAGMOTION_UL_classes"

    def draw_item(
        self,
        context: bpy.types.Context,
        layout: bpy.types.UILayout,
        _data: object,
        item: Any,
        _icon: int,
        _active_data: object,
        _active_name: str,
        _index: int,
    ) -> None:
        row = layout.row(align=True)
        shown = row.split(factor=0.6, align=True) if _is_wide(context) else row.row(align=True)
        shown.active = not item.excluded
        shown.prop(item, "name", text="", emboss=False)
        if _is_wide(context):
            _draw_beside(shown.split(factor=0.7, align=True), item)
        row.prop(item, "excluded", text="", icon="HIDE_ON" if item.excluded else "HIDE_OFF", emboss=False)


def _draw_beside(layout: bpy.types.UILayout, item: Any) -> None:
    layout.label(text=item.sketch, translate=False)
    count = layout.row()
    count.alignment = "RIGHT"
    count.label(text=str(item.fragments))


class FRAGMOTION_PT_classes(_ClassPanel, bpy.types.Panel):
    """What the character can do, class by class."""

    bl_idname = "FRAGMOTION_PT_classes"
    bl_label = "Classes"

    def draw(self, context: bpy.types.Context) -> None:
        layout, obj = self.layout, active_armature(context)
        settings, figures = context.window_manager.fragmotion, obj.fragmotion.figures
        draw_shown_style(layout, figures)
        style = classes.shown_style(figures)
        rows, left_out = classes.rows_of(obj, style), len(classes.excluded(obj, style))
        if not rows:
            draw_wrapped(layout.column(align=True), context, "Build again to list the classes of this style", "INFO")
            return
        listed = (figures.styles[style], "rows") if style else (obj.fragmotion, "classes")
        layout.template_list("FRAGMOTION_UL_classes", "", *listed, settings, "active_class", rows=_ROWS)
        if left_out:
            layout.label(text=f"{left_out} of {len(rows)} left out", icon="HIDE_ON")
        if settings.active_class < len(rows):
            _draw_class(layout, context, settings.active_class, rows[settings.active_class])
        row = layout.row(align=True)
        draw_play(row, "fragmotion.solo_class", "Preview", ClassPreview)
        row.operator("fragmotion.force_class", icon="FORWARD").number = -1


def _draw_class(layout: bpy.types.UILayout, context: bpy.types.Context, number: int, row: Any) -> None:
    column = layout.column(align=True)
    draw_wrapped(column, context, row.name)
    column.label(text=f"Class {number}: {counted(row.fragments, 'fragment')}")
    for part in row.described.split(", "):
        column.label(text=part, icon="BLANK1")


class FRAGMOTION_PT_inspector(_ClassPanel, bpy.types.Panel):
    """Why the policy plays what it plays."""

    bl_idname = "FRAGMOTION_PT_inspector"
    bl_label = "Inspector"
    bl_parent_id = "FRAGMOTION_PT_build_advanced"

    def draw(self, context: bpy.types.Context) -> None:
        layout, obj = self.layout, active_armature(context)
        manager = context.window_manager.fragmotion
        figures = obj.fragmotion.figures
        try:
            what = inspector.decision(obj, manager.inspector, manager.active_class)
            lines = inspector.explain(obj, what)
        except UserError as error:
            draw_wrapped(layout.column(align=True), context, str(error), "ERROR")
            return
        if classes.driven(obj) is not None:
            layout.prop(manager.inspector, "follow")
        if not what.live:
            draw_shown_style(layout, figures)
            styled = figures.styles[what.style] if figures.styles else figures
            _draw_control(layout, manager.inspector, kept_layout(styled) or ControlLayout())
        elif figures.styles:
            layout.label(text=f"Style: {figures.styles[what.style].name}", translate=False)
        name = classes.name_of(obj, what.style, what.playing)
        draw_wrapped(layout.column(align=True), context, f"After '{name}':")
        _draw_heads(layout)
        for index, line in enumerate(lines):
            _draw_alternative(layout, context, index, line)


def _draw_control(layout: bpy.types.UILayout, settings: Any, controls: ControlLayout) -> None:
    column = layout.column()
    column.use_property_split = True
    column.use_property_decorate = False
    column.prop(settings, "gait")
    if settings.gait != "stand":
        column.prop(settings, "direction")
    if controls.turn:
        column.row().prop(settings, "turn", expand=True)
    if controls.jump:
        column.prop(settings, "jump")


def _draw_heads(layout: bpy.types.UILayout) -> None:
    row = layout.row(align=True)
    for head in ("Smooth", "Match", "To come"):
        row.label(text=head)


def _draw_alternative(layout: bpy.types.UILayout, context: bpy.types.Context, index: int, line: inspector.Line) -> None:
    """A class that might come next: its name, what its value is made of, and its nearest fragments; where there is
    room, the value."""
    column = layout.box().column(align=True)
    wide, share = _is_wide(context), 0.82
    head = column.split(factor=share) if wide else column
    icon = "RADIOBUT_ON" if line.chosen else "RADIOBUT_OFF"
    draw_wrapped(head.column(align=True), context, line.name, icon, share if wide else 1.0)
    if wide:
        value = head.row()
        value.alignment = "RIGHT"
        value.label(text=f"{line.value:.2f}")
    bars = column.row(align=True)
    for name in ("smoothness", "match", "future_value"):
        bars.prop(context.window_manager.fragmotion.inspector, name, index=index, text="", slider=True)
    for fragment in line.fragments if line.chosen else line.fragments[:1]:
        _draw_fragment(column, fragment)


def _draw_fragment(layout: bpy.types.UILayout, fragment: inspector.FragmentShown) -> None:
    if not fragment.action:
        layout.label(text=fragment.text, icon="BLANK1", translate=False)
        return
    row = layout.row()
    row.alignment = "LEFT"
    icon = "MOD_MIRROR" if fragment.mirrored else "ACTION"
    show = row.operator("fragmotion.show_fragment", text=fragment.text, icon=icon, emboss=False, translate=False)
    show.action, show.frame = fragment.action, fragment.frame


class FRAGMOTION_PT_tried(_SubPanel, bpy.types.Panel):
    """What the numbers of classes that Suggest tried were good for."""

    bl_idname = "FRAGMOTION_PT_tried"
    bl_label = "Numbers Tried"
    bl_options: ClassVar[set[str]] = set()

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return super().poll(context) and len(active_armature(context).fragmotion.tried) > 0

    def draw(self, context: bpy.types.Context) -> None:
        settings = active_armature(context).fragmotion
        column = self.layout.column(align=True)
        column.label(text="Velocity error, of speed:")
        _draw_tried(column, "Classes", "Error", "Quality", True)
        for row in settings.tried:
            error = f"{100 * row.velocity_error:.1f} %"
            _draw_tried(column, str(row.classes), error, f"{row.quality:.3f}", row.classes == settings.build.classes)


def _draw_tried(layout: bpy.types.UILayout, number: str, error: str, quality: str, bright: bool) -> None:
    row = layout.row(align=True)
    row.active = bright
    for text in (number, error, quality):
        row.label(text=text)


BUILD_PANELS = (FRAGMOTION_PT_tried,)
CLASS_PANELS = (FRAGMOTION_UL_classes, FRAGMOTION_PT_classes)
ADVANCED_PANELS = (FRAGMOTION_PT_inspector,)
