# SPDX-License-Identifier: GPL-3.0-or-later
"""The fields of the stages, as the panel and the redo panel show them."""

from __future__ import annotations

import bpy

from . import versions
from .properties import BakeFields, BuildFields, BuildFigures


def draw_build(layout: bpy.types.UILayout, settings: BuildFields) -> None:
    """The fields of a build."""
    layout = _aligned(layout)
    layout.prop(settings, "longest")
    layout.prop(settings, "classes")
    layout.prop(settings, "cut")
    column = layout.column(heading="Add")
    column.prop(settings, "mirror")
    column.prop(settings, "synthesize")
    layout.prop(settings, "policy")
    _draw_trace(layout, settings, "Learn from")
    layout.prop(settings, "seed")


def draw_bake(layout: bpy.types.UILayout, settings: BakeFields) -> None:
    """The fields of a bake."""
    layout = _aligned(layout)
    _draw_trace(layout, settings, "Trace")
    layout.prop(settings, "seed")
    layout.prop(settings, "frame_start")
    versions.draw_named(layout, settings, "action", "New Action")


def draw_figures(layout: bpy.types.UILayout, figures: BuildFigures) -> None:
    """What the last build found."""
    box = layout.box().column(align=True)
    lines = [
        ("Fragments", f"{figures.fragments} ({figures.captured} captured)"),
        ("Classes", f"{figures.classes}"),
        ("Policy Table", f"{figures.classes} x {figures.controls}"),
        ("Build Time", f"{figures.seconds:.2f} s"),
        ("Quality", f"{figures.quality:.1f} % of Optimal"),
    ]
    for label, value in [*lines, ("Others", figures.others)] if figures.others else lines:
        row = box.split(factor=0.4)
        row.label(text=label)
        row.label(text=value)


def _draw_trace(layout: bpy.types.UILayout, settings: BuildFields | BakeFields, label: str) -> None:
    layout.prop(settings, "trace_source", text=label)
    if settings.trace_source == "FILE":
        layout.prop(settings, "trace_file", text="File")
    else:
        layout.prop(settings, "player")
        layout.prop(settings, "seconds")


def _aligned(layout: bpy.types.UILayout) -> bpy.types.UILayout:
    column = layout.column()
    column.use_property_split = True
    column.use_property_decorate = False
    return column
