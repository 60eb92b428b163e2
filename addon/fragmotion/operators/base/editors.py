# SPDX-License-Identifier: GPL-3.0-or-later
"""Editors in which something is shown."""

from __future__ import annotations

import bpy


def ensure_editor(context: bpy.types.Context, kind: str) -> bpy.types.Area | None:
    """An editor of that `ui_type`: one that is open, or in a window of its own, as Blender's of drivers. None where
    Blender runs without a window."""
    manager = context.window_manager
    areas = [area for window in manager.windows for area in window.screen.areas if area.ui_type == kind]
    if areas or bpy.app.background:
        return areas[0] if areas else None
    bpy.ops.wm.window_new()
    area = manager.windows[-1].screen.areas[0]
    area.ui_type = kind
    return area
