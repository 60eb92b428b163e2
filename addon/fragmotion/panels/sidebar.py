# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panels of the Fragmotion tab have in common."""

from __future__ import annotations

from typing import ClassVar

import bpy

from ..character.building import has_character
from ..mocap.actions import chosen
from ..operators.base.context import active_armature
from ..preview import previews


class Sidebar:
    """A panel of the tab in the 3D viewport's sidebar."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Fragmotion"


def is_folded(context: bpy.types.Context, name: str) -> bool:
    """Whether what leads to a character, "mocap" or "build", is folded away: once there is one, until it is asked for.

    Blender has no way to close a panel.
    """
    obj = active_armature(context)
    shown: bool = getattr(context.window_manager.fragmotion, f"show_{name}")
    return obj is not None and has_character(obj) and not shown


def draw_fold(layout: bpy.types.UILayout, context: bpy.types.Context, name: str, text: str) -> None:
    """The line that folds that away and shows it again."""
    icon = "DISCLOSURE_TRI_RIGHT" if is_folded(context, name) else "DISCLOSURE_TRI_DOWN"
    row = layout.row()
    row.alignment = "LEFT"
    row.prop(context.window_manager.fragmotion, f"show_{name}", text=text, icon=icon, emboss=False)


def draw_play(layout: bpy.types.UILayout, operator: str, text: str, kind: type[previews.Preview]) -> None:
    """The button that begins such a preview, and stops it."""
    playing = isinstance(previews.current, kind)
    text, icon = ("Stop", "SNAP_FACE") if playing else (text, "PLAY")
    layout.operator(operator, text=text, icon=icon, depress=playing)


class SubPanel(Sidebar):
    """A panel below another, closed at first, for an armature."""

    bl_options: ClassVar[set[str]] = {"DEFAULT_CLOSED"}
    folds: ClassVar[str] = ""
    """With what it is folded away, "mocap" or "build"; empty where it never is."""

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return active_armature(context) is not None and not (cls.folds and is_folded(context, cls.folds))


class TakePanel(SubPanel):
    """One that is about the take that is chosen in the list."""

    bl_parent_id = "FRAGMOTION_PT_mocap"
    folds = "mocap"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return super().poll(context) and chosen(context, active_armature(context)) is not None
