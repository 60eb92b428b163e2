# SPDX-License-Identifier: MIT
"""What there is of the add-on in Blender."""

from __future__ import annotations

import bpy


def registered() -> set[str]:
    """Classes, operators, handlers, menu entries and properties of the add-on."""
    classes = {name for name in dir(bpy.types) if "fragmotion" in name.lower()}
    operators = {name for name in dir(bpy.ops.fragmotion)}
    owners = (bpy.types.Object, bpy.types.Action, bpy.types.WindowManager, bpy.types.Scene)
    handlers = {
        f"{name}: {handler.__module__}"
        for name in dir(bpy.app.handlers)
        if isinstance(listeners := getattr(bpy.app.handlers, name), list)
        for handler in listeners
        if "fragmotion" in handler.__module__
    }
    menus = {
        f"{name}: {draw.__module__}"
        for name in ("VIEW3D_MT_object_animation", "VIEW3D_MT_pose")
        for draw in getattr(bpy.types, name)._dyn_ui_initialize()
        if "fragmotion" in draw.__module__
    }
    return classes | operators | handlers | menus | {o.__name__ for o in owners if hasattr(o, "fragmotion")}
