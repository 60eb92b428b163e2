# SPDX-License-Identifier: GPL-3.0-or-later
"""The sub-panel that says which bone is which part of the body."""

from __future__ import annotations

import bpy

from ..operators.base.context import active_armature
from ..rig.bodies import DoubtfulBone, open_doubts
from ..settings.drawing import draw_wrapped
from .sidebar import SubPanel

_ICONS = {True: "CHECKMARK", False: "QUESTION"}
_LABELS = 0.45  # of the width


class FRAGMOTION_PT_bones(SubPanel, bpy.types.Panel):
    """Which bone is which: takes of other skeletons are brought onto the armature by it."""

    bl_idname = "FRAGMOTION_PT_bones"
    bl_label = "Bones"
    bl_parent_id = "FRAGMOTION_PT_mocap"
    folds = "mocap"

    def draw(self, context: bpy.types.Context) -> None:
        layout, obj = self.layout, active_armature(context)
        roles = obj.fragmotion.roles
        row = layout.row(align=True)
        row.operator("fragmotion.find_bones", icon="VIEWZOOM")
        row.operator("fragmotion.load_bones", text="", icon="FILE_FOLDER")
        row.operator("fragmotion.save_bones", text="", icon="FILE_TICK")
        doubts = {doubt.name: doubt for doubt in open_doubts(obj)}
        column = layout.column(align=True)
        if not len(roles):
            column.label(text="Found at the import", icon="INFO")
            for doubt in doubts.values():
                _draw_doubt(column, context, doubt)
        for role in roles:
            row = column.split(factor=_LABELS, align=True)
            row.alert = role.name in doubts
            row.label(text=_label(role.name))
            row.prop_search(role, "bone", obj.data, "bones", text="", icon=_ICONS[role.bone in obj.data.bones])
            if role.name in doubts:
                _draw_doubt(column, context, doubts[role.name])


def _draw_doubt(layout: bpy.types.UILayout, context: bpy.types.Context, doubt: DoubtfulBone) -> None:
    """Why it may not be the bone, in red, and what shows the bone and says that it is."""
    box = layout.box().column(align=True)
    red = box.column(align=True)
    red.alert = True
    red.label(text=_label(doubt.name), icon="ERROR")
    draw_wrapped(red, context, doubt.text)
    row = box.row(align=True)
    row.operator("fragmotion.confirm_bone", icon="CHECKMARK").role = doubt.name
    row.operator("fragmotion.show_bone", text="", icon="RESTRICT_SELECT_OFF").role = doubt.name


def _label(role: str) -> str:
    """As short as a sidebar needs: "left_upper_arm" is "L Upper Arm"."""
    side, _, part = role.partition("_")
    name = f"{side[0]} {part}" if side in {"left", "right"} else role
    return name.replace("_", " ").title()


CLASSES = (FRAGMOTION_PT_bones,)
