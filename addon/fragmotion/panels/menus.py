# SPDX-License-Identifier: GPL-3.0-or-later
"""Entries in Blender's own menus, which are what F3 searches."""

from __future__ import annotations

from typing import Any

import bpy

_MENUS = ("VIEW3D_MT_object_animation", "VIEW3D_MT_pose")


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
    self.layout.operator("fragmotion.drive", icon="PLAY")
