# SPDX-License-Identifier: GPL-3.0-or-later
"""The Recordings panel of the sidebar, and what belongs to Bake below it."""

from __future__ import annotations

from typing import Any

import bpy

from ..operators.base.context import active_armature
from ..recordings.recordings import active_recording
from ..settings.drawing import (
    aligned,
    draw_bake,
    draw_bake_advanced,
    draw_bake_options,
    draw_hands,
    draw_look,
    draw_populate,
    draw_wrapped,
    plays_anew,
)
from .sidebar import Sidebar, SubPanel

_FEWEST_ROWS, _MOST_ROWS = 2, 6  # of the list, unless the user draws it larger
_INSIDE = 0.9  # of the sidebar's width: a box


class FRAGMOTION_UL_recordings(bpy.types.UIList):
    """The armature's recordings, each with a tick to train on it, its name and its length."""

    bl_idname = "FRAGMOTION_UL_recordings"

    def draw_item(
        self,
        _context: bpy.types.Context,
        layout: bpy.types.UILayout,
        _data: object,
        item: Any,
        _icon: int,
        _active_data: object,
        _active_name: str,
    ) -> None:
        row = layout.row(align=True)
        row.prop(item, "train", text="")
        split = row.split(factor=0.7)
        split.prop(item, "name", text="", emboss=False)
        length = split.row()
        length.alignment = "RIGHT"
        length.label(text=f"{item.seconds:.1f} s")


class FRAGMOTION_PT_recordings(Sidebar, bpy.types.Panel):
    """What was recorded or imported, to be replayed, baked (what is selected is what Bake bakes) or learned from."""

    bl_idname = "FRAGMOTION_PT_recordings"
    bl_label = "Recordings"

    def draw(self, context: bpy.types.Context) -> None:
        layout, obj = self.layout, active_armature(context)
        if obj is None:
            layout.label(text="No armature is active", icon="INFO")
            return
        settings = obj.fragmotion
        if not len(settings.recordings):
            layout.label(text="Record while you drive, or", icon="INFO")
            layout.operator("fragmotion.import_recordings", text="Import...", icon="IMPORT")
            return
        rows = min(max(len(settings.recordings), _FEWEST_ROWS), _MOST_ROWS)
        layout.template_list(
            "FRAGMOTION_UL_recordings", "", settings, "recordings", settings, "active_recording", rows=rows
        )
        row = layout.row(align=True)
        if active_recording(obj) is not None:
            draw_replay(row, settings)
        _draw_buttons(row)


class _RecordingPanel(SubPanel):
    """One about the selected recording."""

    bl_parent_id = "FRAGMOTION_PT_recordings"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        obj = active_armature(context)
        return obj is not None and active_recording(obj) is not None


class FRAGMOTION_PT_replay_options(_RecordingPanel, bpy.types.Panel):
    """How the selected recording is replayed, and how good it is."""

    bl_idname = "FRAGMOTION_PT_replay_options"
    bl_label = "Replay Options"

    def draw(self, context: bpy.types.Context) -> None:
        obj = active_armature(context)
        drive, column = obj.fragmotion.drive, aligned(self.layout)
        column.prop(drive, "replay", text="Replay")
        if drive.replay != "RECORDED":
            column.prop(drive, "seed")
        _draw_figures(self.layout, active_recording(obj))


class FRAGMOTION_PT_change(_RecordingPanel, bpy.types.Panel):
    """What changes the selected recording."""

    bl_idname = "FRAGMOTION_PT_change"
    bl_label = "Change"

    def draw(self, context: bpy.types.Context) -> None:
        layout, settings = self.layout, active_armature(context).fragmotion
        group = _group(layout, context, "Edit what was asked for as curves; play it again")
        group.operator("fragmotion.edit_curves", icon="GRAPH")
        group.operator("fragmotion.play_again", icon="FILE_REFRESH")
        row = _group(layout, context, "Leave out a stretch, or let the next one follow").row(align=True)
        row.operator("fragmotion.cut_recording", icon="UNLINKED")
        row.operator("fragmotion.glue_recording", icon="LINKED")
        group = _group(layout, context, "Drive anew from the playhead on")
        aligned(group).prop(settings.drive, "over_seconds", text="For")
        over = group.operator("fragmotion.drive", text="Record Over", icon="REC")
        over.source, over.recording = "OVER", settings.active_recording
        group = _group(layout, context, "Look somewhere from the playhead on")
        draw_look(aligned(group), settings.look)
        group.operator("fragmotion.look_recording", icon="HIDE_OFF")
        group = _group(layout, context, "Hold something from the playhead on")
        draw_hands(aligned(group), active_armature(context))
        group.operator("fragmotion.reach_recording", icon="VIEW_PAN")
        group = _group(layout, context, "Be at a place at the playhead: where you click, or at an object")
        column = aligned(group)
        column.prop(settings, "pin_at", text="Object")
        column.prop(settings.pin, "any_heading")
        column.prop(settings.pin, "stretch", text="Over")
        group.operator("fragmotion.pin_recording", icon="PINNED")
        if len(settings.story):
            group.operator("fragmotion.pin_recording", text="Pin to Storyboard", icon="PINNED").place = "STORY"


def _group(layout: bpy.types.UILayout, context: bpy.types.Context, text: str) -> bpy.types.UILayout:
    """A box that begins with what is in it for."""
    box = layout.box().column()
    draw_wrapped(box.column(align=True), context, text, share=_INSIDE)
    return box


class FRAGMOTION_PT_bake_options(SubPanel, bpy.types.Panel):
    """What is baked, and how."""

    bl_idname = "FRAGMOTION_PT_bake_options"
    bl_label = "Bake Options"
    bl_parent_id = "FRAGMOTION_PT_bake"

    def draw(self, context: bpy.types.Context) -> None:
        obj = active_armature(context)
        draw_bake(self.layout, obj.fragmotion.bake, obj, is_named=True)
        draw_bake_options(self.layout, obj.fragmotion.bake)


class FRAGMOTION_PT_bake_advanced(SubPanel, bpy.types.Panel):
    """What hardly anybody need change of a bake that is played anew."""

    bl_idname = "FRAGMOTION_PT_bake_advanced"
    bl_label = "Advanced"
    bl_parent_id = "FRAGMOTION_PT_bake_options"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        obj = active_armature(context)
        return obj is not None and plays_anew(obj.fragmotion.bake, obj)

    def draw(self, context: bpy.types.Context) -> None:
        draw_bake_advanced(self.layout, active_armature(context).fragmotion.bake)


class FRAGMOTION_PT_populate(SubPanel, bpy.types.Panel):
    """A crowd of the armature's copies."""

    bl_idname = "FRAGMOTION_PT_populate"
    bl_label = "Populate"
    bl_parent_id = "FRAGMOTION_PT_bake"

    def draw(self, context: bpy.types.Context) -> None:
        settings = active_armature(context).fragmotion
        draw_populate(self.layout, settings.populate, settings.crowd, bool(len(settings.figures.styles)))
        self.layout.operator("fragmotion.populate", icon="COMMUNITY")


def _draw_buttons(row: bpy.types.UILayout) -> None:
    for name, icon in (
        ("import_recordings", "IMPORT"),
        ("export_recording", "EXPORT"),
        ("duplicate_recording", "DUPLICATE"),
        ("trim_recording", "DRIVER_DISTANCE"),
        ("delete_recording", "TRASH"),
    ):
        row.operator(f"fragmotion.{name}", text="", icon=icon)


def _draw_figures(layout: bpy.types.UILayout, recording: Any) -> None:
    column = layout.column(align=True)
    for label, value in (
        ("Recorded", recording.date),
        ("Quality", f"{recording.quality:.2f} of 1" if recording.quality > 0 else "not measured"),
    ):
        row = column.split(factor=0.36)
        row.label(text=label)
        row.label(text=value, translate=False)


def draw_replay(layout: bpy.types.UILayout, settings: Any) -> None:
    """The button that replays the selected recording as the panel says."""
    drive, index = settings.drive, settings.active_recording
    replay = layout.operator("fragmotion.drive", text="Replay", icon="PLAY")
    replay.source, replay.recording = "RECORDING", index
    if drive.replay != "RECORDED":
        replay.policy, replay.seed = drive.replay, drive.seed


CLASSES = (
    FRAGMOTION_UL_recordings,
    FRAGMOTION_PT_recordings,
    FRAGMOTION_PT_change,
    FRAGMOTION_PT_replay_options,
)
BAKE_CLASSES = (FRAGMOTION_PT_bake_options, FRAGMOTION_PT_bake_advanced, FRAGMOTION_PT_populate)
