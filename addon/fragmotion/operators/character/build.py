# SPDX-License-Identifier: GPL-3.0-or-later
"""Build the active armature's character from the ticked Actions."""

from __future__ import annotations

from typing import Any, ClassVar

import bpy

from ...character import building
from ...character.abilities import NOTHING, say_acts, say_stand, say_undone
from ...character.control_layout import say_lacking
from ...character.coverage import lacking
from ...jobs import Job
from ...mocap.actions import fitting
from ...settings.build_fields import BuildFields
from ..base.background import Background, poll_idle
from ..base.context import active_armature, poll_armature


class Building(Background):
    """An operator that builds from the ticked Actions."""

    bl_options: ClassVar[set[str]] = {"UNDO"}
    settings = "build"

    @classmethod
    def poll(cls: Any, context: bpy.types.Context) -> bool:
        if not poll_armature(cls, context) or not poll_idle(cls):
            return False
        obj = active_armature(context)
        takes = fitting(obj)
        if takes and not any(action.fragmotion.use for action in takes):
            cls.poll_message_set("No Action is ticked: tick the takes to learn from, under Mocap")
        elif not takes and not any(action.fragmotion.use for action in bpy.data.actions):
            cls.poll_message_set(f"Armature '{obj.name}' has no Actions to learn from: import mocap first")
        else:
            return True
        return False


class FRAGMOTION_OT_build(BuildFields, Building, bpy.types.Operator):
    """Build in the background; to its end at once where there is no window, and when executed."""

    bl_idname = "fragmotion.build"
    bl_label = "Build"
    bl_description = (
        "Cut the ticked Actions into fragments, cluster them and find the policy: what to play next for each control. "
        "Blender stays usable meanwhile; Esc or Cancel stops it"
    )
    verb = "Build"

    def _prepare(self, context: bpy.types.Context, obj: bpy.types.Object) -> Job:
        task, self._warnings = building.prepare(context, obj, self)
        return Job(f"Building '{obj.name}'", task)

    def _keep(self, context: bpy.types.Context, obj: bpy.types.Object, built: building.Built) -> None:
        building.keep(obj, built)
        figures, panels = obj.fragmotion.figures, context.window_manager.fragmotion
        panels.show_mocap = panels.show_build = False
        told = "".join(
            f"; style '{style.name}': {style.classes} classes, {style.quality:.0f} % of what its takes allow, "
            f"does {style.performed} controls"
            for style in figures.styles
        )
        self.report(
            {"INFO"},
            f"{figures.abilities}. {figures.fragments} fragments in {figures.classes} classes, built in "
            f"{figures.seconds:.1f} s; {figures.quality:.0f} % of what its takes allow; "
            f"does {figures.performed} of {figures.controls} controls{told}",
        )
        spare = say_lacking(built.character)
        undone = say_undone(built.done[0], built.character.space)
        stands = say_stand(built.character) or say_acts(built.character)
        remarks = (
            *filter(NOTHING.__eq__, (figures.abilities,)),
            *self._warnings,
            *filter(None, (spare, undone, stands)),
            *lacking(building.coverage_by_style(built)),
        )
        for warning in remarks:
            self.report({"WARNING"}, warning)
