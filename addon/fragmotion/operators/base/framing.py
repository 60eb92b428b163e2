# SPDX-License-Identifier: GPL-3.0-or-later
"""Views that show what was added."""

from __future__ import annotations

import bpy

from ...drive.hud import views


def frame_selected(context: bpy.types.Context) -> None:
    """Have a 3D view show what is selected: that in which the button was pressed, else the window's first, if any."""
    if bpy.app.background or context.window is None:
        return
    areas = [context.area] if context.area is not None else []
    area = next((each for each in [*areas, *views.areas_of(context.window)] if each.type == "VIEW_3D"), None)
    if area is not None:
        with context.temp_override(area=area, region=views.window_region(area)):
            bpy.ops.view3d.view_selected()
