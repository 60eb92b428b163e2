# SPDX-License-Identifier: GPL-3.0-or-later
"""Entries in Blender's own menus, which are what F3 searches, and a pie menu at the mouse."""

from __future__ import annotations

from typing import Any

import bpy

from ..compat.icons import own_icon
from ..drive import session
from ..operators.base.context import active_armature
from ..recordings.recordings import active_recording
from .drive import draw_drive, draw_record
from .recordings import draw_replay

_MENUS = ("VIEW3D_MT_object_animation", "VIEW3D_MT_pose")


class FRAGMOTION_MT_pie(bpy.types.Menu):
    """Drive, record, replay and bake."""

    bl_idname = "FRAGMOTION_MT_pie"
    bl_label = "Fragmotion"

    def draw(self, context: bpy.types.Context) -> None:
        pie, obj, driven = self.layout.menu_pie(), active_armature(context), session.current
        pie.operator("fragmotion.bake", icon="ACTION_TWEAK")
        draw_record(pie, driven)
        if obj is not None and active_recording(obj) is not None:
            draw_replay(pie, obj.fragmotion)
        else:
            pie.separator()
        draw_drive(pie, driven)


CLASSES = (FRAGMOTION_MT_pie,)


def register() -> None:
    """Add the entries."""
    for name in _MENUS:
        getattr(bpy.types, name).append(_draw)


def unregister() -> None:
    """Take them away again."""
    for name in _MENUS:
        getattr(bpy.types, name).remove(_draw)


def _draw(self: Any, _context: bpy.types.Context) -> None:
    self.layout.separator()
    self.layout.operator("fragmotion.drive", icon_value=own_icon())
