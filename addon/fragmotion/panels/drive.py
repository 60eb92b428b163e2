# SPDX-License-Identifier: GPL-3.0-or-later
"""The Drive panel of the sidebar, with its sub-panels."""

from __future__ import annotations

from typing import Any

import bpy

from ..compat import versions
from ..drive import session
from ..input.pads import PadState
from ..operators.base.context import active_armature
from ..operators.directing import drive as drive_operator
from ..settings.drawing import aligned, draw_hands, draw_look, draw_trace, draw_wrapped
from .sidebar import Sidebar, SubPanel


def _armature(context: bpy.types.Context) -> Any:
    """The armature that is driven, else the active one, if any."""
    driven = session.current
    return active_armature(context) if driven is None or driven.trouble() else driven.obj


class _DriveSubPanel(SubPanel):
    bl_parent_id = "FRAGMOTION_PT_drive"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return _armature(context) is not None


class FRAGMOTION_PT_drive(Sidebar, bpy.types.Panel):
    """One large button, and what drives."""

    bl_idname = "FRAGMOTION_PT_drive"
    bl_label = "Drive"

    def draw(self, context: bpy.types.Context) -> None:
        layout, driven, obj = self.layout, session.current, _armature(context)
        row = layout.row()
        row.scale_y = 1.6
        draw_drive(row, driven)
        if driven is not None:
            draw_record(layout, driven)
            _draw_input(layout, context, driven)
            _draw_styles(layout, driven)
        if obj is not None:
            layout.row().prop(obj.fragmotion.drive, "relative", expand=True)


class FRAGMOTION_PT_drive_options(_DriveSubPanel, bpy.types.Panel):
    """What is set once for all drives."""

    bl_idname = "FRAGMOTION_PT_drive_options"
    bl_label = "Drive Options"

    def draw(self, context: bpy.types.Context) -> None:
        settings, look = _armature(context).fragmotion.drive, _armature(context).fragmotion.look
        column = aligned(self.layout)
        column.prop(settings, "start")
        column.prop(settings, "follow")
        column.prop(settings, "click_to_walk")
        draw_look(column, look)
        draw_hands(column, _armature(context))


class _OptionsPanel(_DriveSubPanel):
    bl_parent_id = "FRAGMOTION_PT_drive_options"


class FRAGMOTION_PT_drive_pads(_OptionsPanel, bpy.types.Panel):
    """The gamepads that are connected, and how their sticks stand."""

    bl_idname = "FRAGMOTION_PT_drive_pads"
    bl_label = "Gamepads"

    def draw(self, _context: bpy.types.Context) -> None:
        layout, driven = self.layout, session.current
        if driven is None:
            for name in drive_operator.seen_pads:
                layout.label(text=name, icon="CHECKMARK", translate=False)
            if not drive_operator.seen_pads:
                layout.label(text="None found yet", icon="INFO")
            layout.operator("fragmotion.find_pads", icon="FILE_REFRESH")
            return
        for pad in driven.inputs.pads:
            _draw_pad(layout.box().column(align=True), pad.label, pad.state)
        if not driven.inputs.pads:
            layout.label(text="None connected", icon="INFO")


class FRAGMOTION_PT_drive_overlays(_OptionsPanel, bpy.types.Panel):
    """What is drawn over the view."""

    bl_idname = "FRAGMOTION_PT_drive_overlays"
    bl_label = "Overlays"

    def draw(self, context: bpy.types.Context) -> None:
        settings = _armature(context).fragmotion.drive
        grid = self.layout.grid_flow(row_major=True, columns=2, even_columns=True, align=True)
        for name in ("show_velocity", "show_path", "show_ideal", "show_feet", "show_stick", "show_figures"):
            grid.prop(settings, name)
        row = grid.row()
        row.active = settings.show_figures
        row.prop(settings, "show_details")


class FRAGMOTION_PT_drive_trace(_OptionsPanel, bpy.types.Panel):
    """A trace as an input."""

    bl_idname = "FRAGMOTION_PT_drive_trace"
    bl_label = "Trace"

    def draw(self, context: bpy.types.Context) -> None:
        settings = _armature(context).fragmotion.drive
        column = aligned(self.layout)
        draw_trace(column, settings, "Trace")
        column.prop(settings, "seed")
        self.layout.operator("fragmotion.play_trace", icon="PLAY")


class FRAGMOTION_PT_drive_feel(_OptionsPanel, bpy.types.Panel):
    """How the character moves; Bake and Populate go by it, too."""

    bl_idname = "FRAGMOTION_PT_drive_feel"
    bl_label = "Feel"

    def draw(self, context: bpy.types.Context) -> None:
        settings = _armature(context).fragmotion.feel
        column = self.layout.column()
        column.active = session.current is None
        for name in ("responsiveness", "root_adjustment", "lock_feet"):
            column.prop(settings, name)


class FRAGMOTION_PT_drive_ground(_OptionsPanel, bpy.types.Panel):
    """What the character goes on; Bake and Populate go by it, too."""

    bl_idname = "FRAGMOTION_PT_drive_ground"
    bl_label = "Ground"

    def draw(self, context: bpy.types.Context) -> None:
        settings = _armature(context).fragmotion.ground
        column = aligned(self.layout)
        column.active = session.current is None
        column.prop(settings, "kind")
        if settings.kind == "OBJECT":
            column.prop(settings, "object")
        elif settings.kind == "COLLECTION":
            column.prop(settings, "collection")


def draw_drive(layout: bpy.types.UILayout, driven: session.Session | None) -> None:
    """The button that begins a drive, or ends it."""
    text, icon = ("Drive", "PLAY") if driven is None else ("Stop", "SNAP_FACE")
    layout.operator("fragmotion.drive", text=text, icon=icon)


def draw_record(layout: bpy.types.UILayout, driven: session.Session | None) -> None:
    """The button that begins a recording, or ends it."""
    recording = driven.recording if driven is not None else None
    layout.operator(
        "fragmotion.record",
        text="Record" if recording is None else f"End Recording ({recording.seconds:.0f} s)",
        icon="REC" if recording is None else "CHECKMARK",
        depress=recording is not None,
    )


def _draw_input(layout: bpy.types.UILayout, context: bpy.types.Context, driven: session.Session) -> None:
    """What drives, and how far it is where it has an end."""
    trace = driven.inputs.trace
    if trace.playing:
        versions.draw_progress(layout, trace.elapsed / trace.seconds, driven.playing)
    else:
        draw_wrapped(layout.column(align=True), context, f"Input: {driven.inputs.label or 'none yet'}")


def _draw_styles(layout: bpy.types.UILayout, driven: session.Session) -> None:
    """A button for each style."""
    column = layout.column(align=True)
    for style, name in enumerate(driven.styling.names):
        button = column.operator("fragmotion.change_style", text=name, depress=style == driven.styling.wanted)
        button.style = style


def _draw_pad(layout: bpy.types.UILayout, label: str, state: PadState) -> None:
    """A pad's name, its sticks and its buttons."""
    layout.label(text=label, translate=False)
    for name, (x, y) in (("Left", state.left), ("Right", state.right)):
        row = layout.split(factor=0.2, align=True)
        row.label(text=name)
        values = row.row(align=True)
        versions.draw_deflection(values, x)
        versions.draw_deflection(values, y)
    turn = {1: "left", -1: "right"}.get(state.shoulders, "")
    pressed = [word for word in (turn, "jump" if state.jump else "", "record" if state.record else "") if word]
    layout.label(text=f"Buttons: {', '.join(pressed) or 'none'}")


CLASSES = (
    FRAGMOTION_PT_drive,
    FRAGMOTION_PT_drive_options,
    FRAGMOTION_PT_drive_feel,
    FRAGMOTION_PT_drive_ground,
    FRAGMOTION_PT_drive_pads,
    FRAGMOTION_PT_drive_overlays,
    FRAGMOTION_PT_drive_trace,
)
