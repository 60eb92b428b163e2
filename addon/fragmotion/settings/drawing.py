# SPDX-License-Identifier: GPL-3.0-or-later
"""The fields of the stages, as the panel and the redo panel show them."""

from __future__ import annotations

import os
import textwrap
from typing import Any

import bpy

from ..character.abilities import NOTHING
from ..character.coverage import COLUMNS
from ..character.storing import BESIDE, troubles
from ..compat import versions
from ..recordings.recordings import active_recording, baked_source, is_bake_stale
from .armature import BuildFigures, CrowdSettings, DriveSettings
from .bake_fields import BakeFields, PopulateFields
from .build_fields import BuildFields
from .common import POLICY_NAMES
from .look_fields import LookSettings
from .reach_fields import ReachSettings

# pixels of a sidebar at the scale 1: what no text can use, an icon with the room around it, and a letter on average
_FRAME, _ICON, _LETTER = 30, 30, 6.3


def draw_build(layout: bpy.types.UILayout, settings: BuildFields) -> None:
    """The fields of a build that are changed most."""
    layout = aligned(layout)
    layout.prop(settings, "longest", text="Longest")
    row = layout.row(align=True)
    row.prop(settings, "classes")
    row.operator("fragmotion.suggest_classes", text="", icon="VIEWZOOM")
    column = layout.column(heading="Add")
    column.prop(settings, "mirror")
    column.prop(settings, "synthesize")


def draw_training(layout: bpy.types.UILayout, settings: BuildFields) -> None:
    """What a build learns to perform, and from whom."""
    layout = aligned(layout)
    _draw_controls(layout, settings)
    draw_trace(layout, settings, "Learn from")


def draw_build_advanced(layout: bpy.types.UILayout, settings: BuildFields) -> None:
    """The fields of a build that hardly anybody need change."""
    layout = aligned(layout)
    for name in ("policy", "cut", "seed"):
        layout.prop(settings, name)


def _draw_controls(layout: bpy.types.UILayout, settings: BuildFields) -> None:
    """Which controls the character is to have."""
    layout.prop(settings, "controls")
    if settings.controls != "TOLD":
        return
    layout.prop(settings, "speeds")
    layout.row().prop(settings, "directions", expand=True)
    row = layout.row(heading="With", align=True)
    row.prop(settings, "turn", toggle=True)
    row.prop(settings, "jump", toggle=True)


def draw_bake(layout: bpy.types.UILayout, settings: BakeFields, obj: bpy.types.Object, is_named: bool = False) -> None:
    """What a bake is of, and what it goes to; `is_named`: the recording's name stands elsewhere."""
    layout = aligned(layout)
    source = baked_source(obj, settings)
    if source == settings.trace_source:
        draw_trace(layout, settings, "Source")
    else:
        layout.prop(settings, "trace_source", text="Source")
        layout.label(text="None yet: simulated", icon="INFO")
        _draw_player(layout, settings)
    if source == "RECORDING":
        if not is_named:
            _draw_recording(layout, obj, settings)
        layout.prop(settings, "as_recorded")
    if plays_anew(settings, obj):
        layout.prop(settings, "place")
    if source != "RECORDING" and obj.fragmotion.figures.styles:
        layout.prop(settings, "style")
    if source != "RECORDING":
        draw_look(layout, obj.fragmotion.look)
        draw_hands(layout, obj)
    layout.prop(settings, "target")


def plays_anew(settings: BakeFields, obj: bpy.types.Object) -> bool:
    """Whether what is baked is played anew, and not as it was recorded."""
    return baked_source(obj, settings) != "RECORDING" or not settings.as_recorded


def draw_bake_advanced(layout: bpy.types.UILayout, settings: BakeFields) -> None:
    """What plays, where it is played anew."""
    layout = aligned(layout)
    layout.prop(settings, "policy")
    layout.prop(settings, "seed")


def draw_baked(layout: bpy.types.UILayout, settings: BakeFields, obj: bpy.types.Object) -> None:
    """What a bake is of, in words."""
    source = baked_source(obj, settings)
    if source == "RECORDING":
        _draw_recording(layout, obj, settings)
        _draw_action(layout, active_recording(obj))
    elif source == "FILE":
        layout.label(text=os.path.basename(settings.trace_file) or "Choose a CSV file", icon="FILE", translate=False)
    else:
        layout.label(text=f"{settings.seconds:.0f} s of a simulated {settings.player}", icon="INFO")


def draw_bake_buttons(layout: bpy.types.UILayout, obj: bpy.types.Object | None) -> None:
    """What bakes, and what bakes anew into the same Action."""
    row = layout.row(align=True)
    recording = None if obj is None else active_recording(obj)
    is_baked = recording is not None and recording.baked is not None
    if obj is not None and is_baked and baked_source(obj, obj.fragmotion.bake) == "RECORDING":
        row.operator("fragmotion.bake", text="Update Bake").update = True
    row.operator("fragmotion.bake", icon="ACTION_TWEAK")


def _draw_action(layout: bpy.types.UILayout, recording: Any) -> None:
    """The Action to which it was baked, and whether that is what it was before a change."""
    if recording is None or recording.baked is None:
        return
    stale = is_bake_stale(recording)
    text = f"Changed since '{recording.baked.name}'" if stale else f"As in '{recording.baked.name}'"
    layout.label(text=text, icon="ERROR" if stale else "CHECKMARK", translate=False)


def _draw_recording(layout: bpy.types.UILayout, obj: bpy.types.Object, settings: BakeFields) -> None:
    """The name of the recording that is baked."""
    recordings, index = obj.fragmotion.recordings, settings.recording
    recording = active_recording(obj) if index < 0 else recordings[index] if index < len(recordings) else None
    if recording is not None:
        layout.label(text=recording.name, icon="REC", translate=False)


def draw_bake_options(layout: bpy.types.UILayout, settings: BakeFields) -> None:
    """The other fields of a bake."""
    layout = aligned(layout)
    if settings.target != "CURRENT":
        versions.draw_named(layout, settings, "action", "New Action")
        layout.prop(settings, "frame_start")
    layout.prop(settings, "fit_end")
    layout.prop(settings, "root", text="Root")
    layout.separator()
    layout.prop(settings, "loop")
    if settings.loop:
        layout.prop(settings, "loop_seconds")
    layout.prop(settings, "reduce")
    if settings.reduce:
        layout.prop(settings, "reduce_distance", text="Within")
        layout.prop(settings, "reduce_angle", text="and")
    layout.prop(settings, "markers")


def draw_populate(
    layout: bpy.types.UILayout, settings: PopulateFields, crowd: CrowdSettings | None = None, has_styles: bool = True
) -> None:
    """The fields of a crowd, those of the objects that it needs among them where they can be chosen."""
    layout = aligned(layout)
    layout.prop(settings, "count")
    layout.prop(settings, "layout")
    if crowd is not None and settings.layout in {"AREA", "PATH"}:
        layout.prop(crowd, "area" if settings.layout == "AREA" else "paths")
    layout.prop(settings, "spacing")
    is_driven = settings.layout in {"SQUARE", "RING"}
    if is_driven:
        layout.prop(settings, "traces")
    simulated = is_driven and settings.traces == "PLAYERS"
    if simulated:
        layout.prop(settings, "player")
    if simulated or settings.layout == "AREA":
        layout.prop(settings, "seconds")
    if simulated or not is_driven:
        if has_styles:
            layout.prop(settings, "mix_styles")
        layout.prop(settings, "clear")
        if crowd is not None and settings.clear:
            layout.prop(crowd, "obstacles")
    layout.prop(settings, "sizes")
    layout.prop(settings, "seed")


def draw_summary(layout: bpy.types.UILayout, context: bpy.types.Context, figures: BuildFigures, in_short: bool) -> None:
    """How good the last build is: what it can do, the quality of Optimal's, and, where there is room, how many of the
    controls it does."""
    if figures.abilities:
        draw_wrapped(layout, context, figures.abilities, "ERROR" if figures.abilities == NOTHING else "CHECKMARK")
    layout.label(text=f"{figures.quality:.0f} % of the possible", icon="CHECKMARK")
    if figures.coverage and not in_short:
        icon = "CHECKMARK" if figures.performed == figures.controls else "INFO"
        layout.label(text=f"{figures.performed} of {figures.controls} controls", icon=icon)


def draw_figures(layout: bpy.types.UILayout, figures: BuildFigures) -> None:
    """What the last build found."""
    box = layout.box().column(align=True)
    _draw_row(box, "Fragments", str(figures.fragments))
    _draw_row(box, "from takes", str(figures.captured))
    _draw_row(box, "Classes", str(figures.classes))
    if figures.coverage:
        _draw_row(box, "Controls done", f"{figures.performed} of {figures.controls}")
    if figures.seconds > 0:
        _draw_row(box, "Built in", f"{figures.seconds:.2f} s")
    if figures.stature > 0:
        _draw_row(box, "Stature, by its legs", f"{figures.stature:.2f} m")
    box.separator()
    for style in figures.styles:
        _draw_row(box, style.name, f"{style.classes} classes, {style.quality:.1f} %")
    box.label(text="Quality, of Optimal:")
    for policy in figures.policies:
        _draw_row(box, POLICY_NAMES.get(policy.name, policy.name), f"{policy.quality:.1f} %")
    _draw_row(box, "Measured on", figures.examiner.title())


def draw_look(layout: bpy.types.UILayout, settings: LookSettings) -> None:
    """The fields of LookSettings."""
    layout.prop(settings, "kind")
    if settings.kind == "OBJECT":
        layout.prop(settings, "object")


def draw_reach(layout: bpy.types.UILayout, settings: ReachSettings, label: str) -> None:
    """The fields of ReachSettings, and the weight of its object, which can be keyed."""
    layout.prop(settings, "object", text=label)
    if settings.object is not None:
        row = layout.row()
        row.use_property_decorate = True
        row.prop(settings.object.fragmotion, "held")
        layout.prop(settings, "carried")


def draw_hands(layout: bpy.types.UILayout, obj: bpy.types.Object) -> None:
    """What both hands of an armature reach for."""
    draw_reach(layout, obj.fragmotion.left_hand, "Left Hand")
    draw_reach(layout, obj.fragmotion.right_hand, "Right Hand")


def draw_shown_style(layout: bpy.types.UILayout, figures: BuildFigures) -> None:
    """The style that panels show, where there are any."""
    if figures.styles:
        layout.prop(figures, "shown_style", text="")


def draw_keeping(layout: bpy.types.UILayout, obj: bpy.types.Object) -> None:
    """Where the policy is kept."""
    settings = obj.fragmotion
    column = aligned(layout)
    column.prop(settings, "keep_policy", text="Keep")
    if obj.name in troubles:
        column.label(text="See the console", icon="ERROR")
    elif settings.keep_policy == BESIDE and settings.policy:
        column.label(text="Written when you save", icon="INFO")
    elif settings.policy_digest and not settings.policy:
        column.label(text=settings.policy_file, icon="FILE", translate=False)


def draw_coverage(layout: bpy.types.UILayout, figures: BuildFigures) -> None:
    """How many controls of each kind are done; greyed where not all are."""
    column = layout.column(align=True)
    column.label(text="Controls done:")
    _draw_cells(column, "", [(name, True) for name in COLUMNS])
    for row in figures.coverage:
        counts = zip(row.performed, row.total)
        cells = [(f"{performed}/{total}" if total else "-", performed == total) for performed, total in counts]
        _draw_cells(column, row.name, cells)
    if figures.makes_jumps:
        column.label(text="Jumps are synthesized", icon="INFO")


def _draw_cells(layout: bpy.types.UILayout, label: str, cells: list[tuple[str, bool]]) -> None:
    """A row of a table: a label, and cells of text that are bright or greyed."""
    split = layout.split(factor=0.42, align=True)
    split.label(text=label)
    row = split.row(align=True)
    for text, bright in cells:
        cell = row.row()
        cell.active = bright
        cell.label(text=text)


def _draw_row(layout: bpy.types.UILayout, label: str, value: str) -> None:
    row = layout.split(factor=0.6)
    row.label(text=label)
    row.label(text=value)


def draw_trace(layout: bpy.types.UILayout, settings: BuildFields | BakeFields | DriveSettings, label: str) -> None:
    """Where a trace comes from."""
    layout.prop(settings, "trace_source", text=label)
    if settings.trace_source == "FILE":
        layout.prop(settings, "trace_file", text="File")
    elif settings.trace_source == "PLAYER":
        _draw_player(layout, settings)


def _draw_player(layout: bpy.types.UILayout, settings: BuildFields | BakeFields | DriveSettings) -> None:
    layout.prop(settings, "player")
    layout.prop(settings, "seconds")


def draw_wrapped(
    layout: bpy.types.UILayout, context: bpy.types.Context, text: str, icon: str = "NONE", share: float = 1.0
) -> None:
    """A text in as many lines as it takes in this share of the sidebar's width, the first with the icon."""
    width = context.region.width / context.preferences.system.ui_scale - _FRAME
    room = share * width - (_ICON if icon != "NONE" else 0)
    for line in textwrap.wrap(text, max(int(room / _LETTER), 10)):
        layout.label(text=line, icon=icon, translate=False)
        icon = "BLANK1" if icon != "NONE" else icon


def aligned(layout: bpy.types.UILayout) -> bpy.types.UILayout:
    """A column of fields whose names stand in a column of their own."""
    column = layout.column()
    column.use_property_split = True
    column.use_property_decorate = False
    return column
