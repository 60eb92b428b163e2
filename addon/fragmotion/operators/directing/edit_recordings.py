# SPDX-License-Identifier: GPL-3.0-or-later
"""Change what was recorded: as curves, by another recording behind it, by looks and holds, and by a pin."""

from __future__ import annotations

from typing import Any, ClassVar

import bpy
from bpy.props import EnumProperty

from ...edits import cutting, pinning
from ...edits.replaying import play_again
from ...errors import UserError, ends_on_error, reported
from ...jobs import Job
from ...recordings.curves import curves_of, read_curves, show_curves
from ...recordings.holding import holds_over_time
from ...recordings.looks import aim_of, look_in_words, looks_from
from ...recordings.reaches import EMPTY, reaches_from
from ...recordings.recordings import TRACE_RATE, Recording, active_recording, asked_of, trace_of
from ...rig.selection import select
from ...settings.pin_fields import PinFields
from ..base.background import Background, poll_idle
from ..base.context import active_armature, first_frame, frame_rate, playhead
from ..base.editors import ensure_editor
from ..base.placing import Placing, is_in_view
from .recordings import OnRecording, selected


class FRAGMOTION_OT_edit_curves(OnRecording, bpy.types.Operator):
    """Show the selected recording's controls as F-curves: of an empty below the armature, which is selected"""

    bl_idname = "fragmotion.edit_curves"
    bl_label = "Edit Curves"
    bl_description = (
        "Show the selected recording's controls as curves in the Graph Editor and the Dope Sheet: velocity to the "
        "right and forward, turn and jump. An empty below the armature has them, and is selected. Play Again uses them"
    )

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        obj, recording = active_armature(context), selected(context)
        empty = curves_of(obj, recording)
        if empty is None or empty.name not in context.view_layer.objects:
            empty = show_curves(context.scene, obj, recording, first_frame(obj, recording))
        if context.mode != "OBJECT":
            bpy.ops.object.mode_set(mode="OBJECT")
        select(context, [empty], empty)
        ensure_editor(context, "FCURVES")
        self.report({"INFO"}, f"The curves of '{recording.name}' are in the Graph Editor; Play Again uses them")
        return {"FINISHED"}


class FRAGMOTION_OT_play_again(OnRecording, bpy.types.Operator):
    """Play the selected recording anew as its curves say. What comes before the first change stays as it was"""

    bl_idname = "fragmotion.play_again"
    bl_label = "Play Again"

    @classmethod
    def poll(cls: Any, context: bpy.types.Context) -> bool:
        if not super().poll(context):
            return False
        obj = active_armature(context)
        has_curves = curves_of(obj, active_recording(obj)) is not None  # type: ignore[arg-type]
        if not has_curves:
            cls.poll_message_set("The recording has no curves: press Edit Curves first")
        return has_curves

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        obj, recording = active_armature(context), selected(context)
        drawn = read_curves(obj, recording)
        for remark in drawn.remarks:
            self.report({"WARNING"}, remark)
        if drawn.first == len(drawn.trace):
            self.report({"INFO"}, f"The curves of '{recording.name}' say what was recorded: nothing has changed")
            return {"FINISHED"}
        play_again(obj, recording, drawn.trace, drawn.first)
        self.report({"INFO"}, f"'{recording.name}' is played anew from {drawn.first / TRACE_RATE:.1f} s on")
        return {"FINISHED"}


class FRAGMOTION_OT_glue_recording(OnRecording, bpy.types.Operator):
    """Let the recording that is next in the list follow the selected one, from where the character is then"""

    bl_idname = "fragmotion.glue_recording"
    bl_label = "Glue Next"

    @classmethod
    def poll(cls: Any, context: bpy.types.Context) -> bool:
        if not super().poll(context):
            return False
        settings = active_armature(context).fragmotion
        has_next: bool = settings.active_recording + 1 < len(settings.recordings)
        if not has_next:
            cls.poll_message_set("No recording comes after it in the list")
        return has_next

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        obj, recording = active_armature(context), selected(context)
        other = obj.fragmotion.recordings[obj.fragmotion.active_recording + 1]
        seam = cutting.append(obj, recording, other)
        self.report(
            {"INFO"},
            f"'{other.name}' follows in '{recording.name}' from {seam.end / TRACE_RATE:.1f} s on"
            f"{cutting.fit_in_words(seam)}",
        )
        return {"FINISHED"}


class FRAGMOTION_OT_look_recording(OnRecording, bpy.types.Operator):
    """Let the character look where the panel says, from the playhead on until the next look of the recording"""

    bl_idname = "fragmotion.look_recording"
    bl_label = "Look From Here"
    bl_description = (
        "From the playhead on head and chest look as Look At says, until the recording looks elsewhere. The way that "
        "the character goes does not change. An object is looked at where it is now"
    )

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        obj, recording = active_armature(context), selected(context)
        control, trace = _control_at_playhead(context, recording), trace_of(recording)
        asked = asked_of(recording)
        later = [look for look in asked.looks if look.control > control]
        looks = [*looks_from(asked.looks, control, aim_of(obj.fragmotion.look)), *later]
        play_again(obj, recording, trace, control, asked._replace(looks=looks))
        words = look_in_words(obj.fragmotion.look)
        self.report({"INFO"}, f"'{recording.name}' looks {words} from {control / TRACE_RATE:.1f} s on")
        return {"FINISHED"}


class FRAGMOTION_OT_reach_recording(OnRecording, bpy.types.Operator):
    """Let hands hold what the panel says, from the playhead to the recording's end"""

    bl_idname = "fragmotion.reach_recording"
    bl_label = "Hold From Here"
    bl_description = (
        "From the playhead to the recording's end hands reach for what the fields above say, as their objects move and "
        "are keyed in this time. The way that the character goes does not change"
    )

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        obj, recording = active_armature(context), selected(context)
        control, trace = _control_at_playhead(context, recording), trace_of(recording)
        first = first_frame(obj, recording) + control * frame_rate(context, recording) / TRACE_RATE
        holds = holds_over_time(context, obj, first, len(trace) - control) or [EMPTY]
        asked = asked_of(recording)
        play_again(obj, recording, trace, control, asked._replace(reaches=reaches_from(asked.reaches, control, holds)))
        hands = (obj.fragmotion.left_hand, obj.fragmotion.right_hand)
        held = " and ".join(f"'{hand.object.name}'" for hand in hands if hand.object is not None) or "nothing"
        self.report({"INFO"}, f"'{recording.name}' holds {held} from {control / TRACE_RATE:.1f} s on")
        return {"FINISHED"}


def _control_at_playhead(context: bpy.types.Context, recording: Recording) -> int:
    """The recording's control at the playhead; UserError where that is not on it."""
    now = playhead(context, recording)
    control = round(now * TRACE_RATE)
    if not 0 <= control < len(trace_of(recording)):
        raise UserError(
            f"The playhead is {now:.1f} s after the beginning of recording '{recording.name}', which lasts "
            f"{recording.seconds:.1f} s: move it onto the recording"
        )
    return control


class FRAGMOTION_OT_pin_recording(PinFields, Placing, OnRecording, Background, bpy.types.Operator):
    """Bend the recording before the playhead, so that the character is at a place at that frame."""

    bl_idname = "fragmotion.pin_recording"
    bl_label = "Pin Here"
    bl_description = (
        "At the playhead's frame the character is to be where you click on the ground (Enter: at the 3D cursor), or at "
        "the object above, facing anywhere or its -Y. The stretch before is played with small changes of its controls "
        "until it gets there. What comes before that stays"
    )
    bl_options: ClassVar[set[str]] = {"UNDO"}
    verb = "Pin"
    settings = "pin"
    patience = 0.5

    place: EnumProperty(  # type: ignore[valid-type]
        name="At",
        description="Where the character is to be",
        items=(
            ("PANEL", "Panel", "At the object that the panel names, or where you click on the ground"),
            ("CURSOR", "3D Cursor", "At the 3D cursor"),
            ("STORY", "Storyboard", "At each place of the storyboard, by its frame"),
        ),
        options={"SKIP_SAVE"},
    )

    @classmethod
    def poll(cls: Any, context: bpy.types.Context) -> bool:
        return super().poll(context) and poll_idle(cls)

    @ends_on_error
    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        asks = self.place == "PANEL" and active_armature(context).fragmotion.pin_at is None
        return self._begin_asking(context) if asks and is_in_view(context) else super().invoke(context, event)

    @ends_on_error
    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if self._asks_in is None:
            return super().modal(context, event)
        asked = self._go_on_asking(context, event)
        return self._start(context) if asked is None else asked

    def cancel(self, context: bpy.types.Context) -> None:
        """Blender ends the operator."""
        self.abandon(context)

    def abandon(self, context: bpy.types.Context) -> None:
        """Ask no more, and give up the job."""
        self._end_asking(context, None)
        super().abandon(context)

    def _prepare(self, context: bpy.types.Context, obj: bpy.types.Object) -> Job:
        recording = selected(context)
        self._goals = self._story_goals(context, obj) if self.place == "STORY" else [self._goal(context, obj)]
        self._recording, self._controls = recording.name, recording.controls
        return Job(f"Pinning '{recording.name}'", pinning.prepare(obj, recording, self._goals))

    def _goal(self, context: bpy.types.Context, obj: bpy.types.Object) -> pinning.Goal:
        """At the playhead."""
        named = obj.fragmotion.pin_at if self.place == "PANEL" else None
        now = playhead(context, selected(context))
        return pinning.Goal(now, now - self.stretch, pinning.frame_of(named or context.scene.cursor), self.any_heading)

    def _story_goals(self, context: bpy.types.Context, obj: bpy.types.Object) -> list[pinning.Goal]:
        """Those of the storyboard, each from the one before on; UserError where none has a place."""
        recording, goals = selected(context), list[pinning.Goal]()
        first, rate = first_frame(obj, recording), frame_rate(context, recording)
        for beat in sorted((beat for beat in obj.fragmotion.story if beat.place), key=lambda beat: beat.frame):
            seconds = (beat.frame - first) / rate
            begin = max(goals[-1].seconds if goals else 0.0, seconds - self.stretch)
            goals.append(pinning.Goal(seconds, begin, pinning.frame_of(beat.place), self.any_heading))
        if not goals:
            raise UserError("No entry of the storyboard has a place: press + there, and click on the ground")
        return goals

    def _keep(self, _context: bpy.types.Context, obj: bpy.types.Object, pinned: pinning.Pinned) -> None:
        recording = obj.fragmotion.recordings.get(self._recording)
        if recording is None or recording.controls != self._controls:
            raise UserError(f"Recording '{self._recording}' was changed meanwhile")
        pinning.keep_pins(obj, recording, self._goals, pinned)
        for goal, pin in zip(self._goals, pinned.pins):
            self.report(
                {"INFO"},
                f"'{recording.name}' is at the pin: it was {pinning.say_off(goal, pin.asked, pin.asked_angle)} away, "
                f"{pin.tries} tries left {pinning.say_off(goal, pin.distance, pin.angle)}, spread over the change",
            )


CLASSES = (
    FRAGMOTION_OT_edit_curves,
    FRAGMOTION_OT_play_again,
    FRAGMOTION_OT_glue_recording,
    FRAGMOTION_OT_look_recording,
    FRAGMOTION_OT_reach_recording,
    FRAGMOTION_OT_pin_recording,
)
