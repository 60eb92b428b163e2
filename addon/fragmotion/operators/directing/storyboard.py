# SPDX-License-Identifier: GPL-3.0-or-later
"""Write a storyboard, and record it."""

from __future__ import annotations

import math
from typing import Any, ClassVar

import bpy

from ...edits.storyboard import record, seconds_to
from ...errors import UserError, ends_on_error, reported
from ...recordings.recordings import NEXT
from ...rig.selection import select
from ..base.background import poll_character
from ..base.context import active_armature, poll_armature
from ..base.placing import Placing, is_in_view

_APART = 2.0  # s between an entry and the next at first, at least
_SIZE = 0.15  # m, of the empty that an entry is at


class _OnStory:
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls: Any, context: bpy.types.Context) -> bool:
        return poll_armature(cls, context)


class FRAGMOTION_OT_add_beat(Placing, _OnStory, bpy.types.Operator):
    """Add an entry to the storyboard, at a new empty where you click on the ground, by when the character can walk
    there"""

    bl_idname = "fragmotion.add_beat"
    bl_label = "Add Entry"
    bl_description = (
        "Click on the ground: an entry is added to the storyboard, at a new empty there, by when the character can "
        "walk there. Enter puts it at the 3D cursor"
    )

    @ends_on_error
    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        return self._begin_asking(context) if is_in_view(context) else self.execute(context)

    @ends_on_error
    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        asked = self._go_on_asking(context, event)
        return self.execute(context) if asked is None else asked

    def cancel(self, context: bpy.types.Context) -> None:
        """Blender ends the operator."""
        self.abandon(context)

    def abandon(self, context: bpy.types.Context) -> None:
        """Add nothing."""
        self._end_asking(context, None)

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        settings, render = active_armature(context).fragmotion, context.scene.render
        former = settings.story[-1].frame if len(settings.story) else settings.bake.frame_start
        seconds = max(seconds_to(active_armature(context), context.scene.cursor.location), _APART)
        beat = settings.story.add()
        empty = bpy.data.objects.new(f"Place {len(settings.story)}", None)
        empty.location = context.scene.cursor.location
        empty.empty_display_type, empty.empty_display_size = "SPHERE", _SIZE
        context.scene.collection.objects.link(empty)
        beat.name, beat.place = empty.name, empty
        beat.frame = former + math.ceil(seconds * render.fps / render.fps_base)
        settings.active_beat = len(settings.story) - 1
        selected = context.mode == "OBJECT"
        if selected:
            select(context, [empty], context.view_layer.objects.active)
        how = "G moves it" if selected else "select and move it as you like"
        self.report({"INFO"}, f"Added '{beat.name}', by frame {beat.frame}: {how}")
        return {"FINISHED"}


class FRAGMOTION_OT_remove_beat(_OnStory, bpy.types.Operator):
    """Remove the selected entry from the storyboard; the object that it is at stays"""

    bl_idname = "fragmotion.remove_beat"
    bl_label = "Remove Entry"

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        settings = active_armature(context).fragmotion
        if not 0 <= settings.active_beat < len(settings.story):
            raise UserError("No entry is selected in the storyboard")
        settings.story.remove(settings.active_beat)
        settings.active_beat = max(min(settings.active_beat, len(settings.story) - 1), 0)
        return {"FINISHED"}


class FRAGMOTION_OT_record_story(bpy.types.Operator):
    """Play the storyboard, and keep that as a recording."""

    bl_idname = "fragmotion.record_story"
    bl_label = "Record Storyboard"
    bl_description = (
        "Play the entries one after another from the armature's origin on, and keep that as a recording, in the "
        "place of the one that was made of them before; Update Bake bakes it anew"
    )
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls: Any, context: bpy.types.Context) -> bool:
        return poll_character(cls, context)

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        recording, told = record(context, active_armature(context))
        self.report({"INFO"}, f"Recorded '{recording.name}' ({recording.seconds:.1f} s): {NEXT}")
        for late in told:
            self.report({"WARNING"}, late)
        return {"FINISHED"}


CLASSES = (FRAGMOTION_OT_add_beat, FRAGMOTION_OT_remove_beat, FRAGMOTION_OT_record_story)
