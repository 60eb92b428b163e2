# SPDX-License-Identifier: GPL-3.0-or-later
"""Bake a trace to an Action."""

from __future__ import annotations

from typing import Any, ClassVar

import bpy
from bpy.props import BoolProperty

from ...bake.baking import Baked, hindrances, prepare
from ...bake.performing import chosen_recording
from ...bake.targets import find_target, strips_of, write
from ...errors import UserError
from ...jobs import Job
from ...recordings.recordings import baked_source, digest_of, tell_baked
from ...settings.bake_fields import BakeFields
from ...settings.drawing import draw_bake, draw_bake_advanced, draw_bake_options, plays_anew
from ..base.background import Background, poll_character
from ..base.context import active_armature

_UPDATES = "Write the recording as it is now into the Action to which it was baked before, in place of what was there"


class Baking(Background):
    """An operator that bakes the active armature's character, a short motion at once."""

    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}
    patience = 0.5

    @classmethod
    def poll(cls: Any, context: bpy.types.Context) -> bool:
        return poll_character(cls, context)


class FRAGMOTION_OT_bake(BakeFields, Baking, bpy.types.Operator):
    """Bake a trace to an Action of the active armature; a short one at once."""

    bl_idname = "fragmotion.bake"
    bl_label = "Bake"
    bl_description = (
        "Write the recording that is selected, or what else is chosen as the source, played by the armature's "
        "character, to an Action at the scene's frame rate"
    )
    verb = "Bake"
    settings = "bake"

    update: BoolProperty(  # type: ignore[valid-type]
        name="Update",
        description="Write into the Action to which the recording was baked before",
        default=False,
        options={"SKIP_SAVE"},
    )

    @classmethod
    def description(cls, _context: bpy.types.Context, properties: Any) -> str:
        """The tip of the button."""
        return _UPDATES if properties.update else cls.bl_description

    def _make_job(self, context: bpy.types.Context) -> Job:
        if not self.properties.is_property_set("trace_source"):
            obj = active_armature(context)
            self.trace_source = baked_source(obj, obj.fragmotion.bake)
        return super()._make_job(context)

    def _prepare(self, context: bpy.types.Context, obj: bpy.types.Object) -> Job:
        recording = chosen_recording(obj, self)
        if self.update:
            if recording is None or recording.baked is None:
                raise UserError("No Action is known to which this was baked: press Bake")
            self.target = "NLA" if strips_of(obj, recording.baked) else "NEW"
            self.action = recording.baked.name
        # Blender may replace an Action while the bake runs: only names stay valid.
        self._recording = recording.name if recording is not None else ""
        self._digest = digest_of(recording) if recording is not None else ""
        prepared = prepare(context, obj, self)
        self._first = prepared.target.first
        if self.update and recording is not None and self.target == "NLA":
            self._first = round(recording.baked.frame_range[0])
        return Job(f"Baking '{obj.name}'", prepared.task)

    def _keep(self, context: bpy.types.Context, obj: bpy.types.Object, baked: Baked) -> None:
        target = find_target(context, obj, self, self._recording)._replace(first=self._first)
        if self.update and target.kind == "NLA":
            target = target._replace(kind="STRIPS")
        action = write(context, obj, target, baked.tracks, baked.classes, self)
        recording = obj.fragmotion.recordings.get(self._recording)
        if recording is not None and self.target != "CURRENT":
            tell_baked(recording, action, self._digest)
        first, frames = target.first, len(baked.classes)
        self.report(
            {"INFO"},
            f"Baked {frames} frames ({first}-{first + frames - 1}) to Action '{action.name}'; {baked.remark}",
        )
        if baked.warning:
            self.report({"WARNING"}, baked.warning)
        others = hindrances(obj, own_strip=self.target == "NLA")
        if others:
            self.report({"WARNING"}, f"The pose will differ from the bake because of {'; '.join(others)}")

    def draw(self, context: bpy.types.Context) -> None:
        obj = active_armature(context)
        draw_bake(self.layout, self, obj)
        draw_bake_options(self.layout, self)
        if plays_anew(self, obj):
            draw_bake_advanced(self.layout, self)
