# SPDX-License-Identifier: GPL-3.0-or-later
"""Make a control rig follow a motion skeleton, and make keys of what it does."""

from __future__ import annotations

from typing import Any, ClassVar

import bpy

from ...control_rig import baking, binding
from ...control_rig.detecting import is_control_rig
from ...errors import reported
from ...jobs import Job, SteppedJob
from ...rig.posing import check_free
from ..base.background import Exclusive, poll_idle
from ..base.context import active_rig, poll_rig


class FRAGMOTION_OT_bind_rig(Exclusive, bpy.types.Operator):
    """Make plain bones through the joints of the active control rig, and let its controls follow them."""

    bl_idname = "fragmotion.bind_rig"
    bl_label = "Make Motion Skeleton"
    bl_description = (
        "Make a hidden skeleton of plain bones through the rig's joints. Takes, Build, Drive and Bake work on it, and "
        "the rig's controls follow it. Go on with the rig selected; Unbind takes all of it away again. Esc stops it"
    )
    bl_options: ClassVar[set[str]] = {"UNDO"}
    verb = "Make Motion Skeleton"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if not poll_rig(cls, context) or not poll_idle(cls):
            return False
        rig = active_rig(context)
        if binding.is_bound(rig):
            cls.poll_message_set(f"'{rig.name}' has a motion skeleton")
        elif not is_control_rig(rig):
            cls.poll_message_set(f"'{rig.name}' is no control rig: its own bones can be keyed")
        else:
            return True
        return False

    def _make_job(self, context: bpy.types.Context) -> Job:
        rig = active_rig(context)
        self._armature = rig.name
        return SteppedJob(f"Trying the controls of '{rig.name}'", "switches", binding.bind(context, rig))

    def _keep(self, _context: bpy.types.Context, obj: bpy.types.Object, result: list[str]) -> None:
        self.report({"INFO"}, f"'{obj.name}' follows a motion skeleton: go on with Import Mocap")
        if result:
            told = ", ".join(role.replace("_", " ") for role in result)
            self.report({"WARNING"}, f"No control was found for {told}: they do not follow")


class _Bound:
    """An operator for a rig that has a motion skeleton."""

    @classmethod
    def poll(cls: Any, context: bpy.types.Context) -> bool:
        if not poll_rig(cls, context) or not poll_idle(cls):
            return False
        rig = active_rig(context)
        if not binding.is_bound(rig):
            cls.poll_message_set(f"'{rig.name}' has no motion skeleton")
        return binding.is_bound(rig)


class FRAGMOTION_OT_follow_motion(_Bound, bpy.types.Operator):
    """Let the rig follow its motion skeleton, or play its own Action"""

    bl_idname = "fragmotion.follow_motion"
    bl_label = "Follow"
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        rig = active_rig(context)
        binding.set_following(rig, not binding.follows(rig))
        return {"FINISHED"}


class FRAGMOTION_OT_bake_to_controls(_Bound, Exclusive, bpy.types.Operator):
    """Make keys on the rig's controls of what it does while it follows."""

    bl_idname = "fragmotion.bake_to_controls"
    bl_label = "Bake to Controls"
    bl_description = (
        "Make keys on the rig's controls of what it does on the frames of the motion skeleton's Action. The rig then "
        "plays them and follows no more, until you press Follow. Esc stops it"
    )
    bl_options: ClassVar[set[str]] = {"UNDO"}
    verb = "Bake to Controls"

    def _make_job(self, context: bpy.types.Context) -> Job:
        rig = active_rig(context)
        self._armature = rig.name
        return self._prepare(context, rig)

    def _prepare(self, context: bpy.types.Context, obj: bpy.types.Object) -> Job:
        check_free(obj)
        self._frames = baking.span(obj)
        steps = baking.step(context, obj, self._frames)
        return SteppedJob(f"Baking '{obj.name}'", f"{len(self._frames)} frames", steps)

    def _keep(self, context: bpy.types.Context, obj: bpy.types.Object, result: baking.Keyed) -> None:
        action = baking.keep(context, obj, self._frames, result)
        count, first, last = result.poses.rotations.shape[1], self._frames[0], self._frames[-1]
        self.report({"INFO"}, f"Baked {count} controls, frames {first}-{last}, to Action '{action.name}'")


class FRAGMOTION_OT_unbind_rig(_Bound, bpy.types.Operator):
    """Take the motion skeleton away."""

    bl_idname = "fragmotion.unbind_rig"
    bl_label = "Unbind"
    bl_description = (
        "Take the motion skeleton away, with the character that was built on it, and all that makes the rig follow: "
        "the rig is as it was before. Keys that Bake to Controls made stay, and so do the takes"
    )
    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @reported
    def execute(self, context: bpy.types.Context) -> set[str]:
        rig = active_rig(context)
        check_free(rig)
        binding.unbind(context, rig)
        self.report({"INFO"}, f"'{rig.name}' is as it was")
        return {"FINISHED"}


CLASSES = (
    FRAGMOTION_OT_bind_rig,
    FRAGMOTION_OT_follow_motion,
    FRAGMOTION_OT_bake_to_controls,
    FRAGMOTION_OT_unbind_rig,
)
