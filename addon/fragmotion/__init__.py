# SPDX-License-Identifier: GPL-3.0-or-later
"""Fragmotion: turns motion capture into a character that you can drive."""

from __future__ import annotations

import bpy

from . import operators
from .character import building, coverage_picture, inspector, staleness, storing
from .drive import handlers, session
from .mocap import actions
from .operators import background, solo_class
from .panels import menus, panel
from .settings import keymaps, mending, preferences, properties

bl_info = {
    "name": "Fragmotion",
    "author": "Fragmotion contributors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D Viewport > Sidebar > Fragmotion",
    "description": "Turns motion capture into a character that you can drive",
    "category": "Animation",
}

_CLASSES = (preferences.FragmotionPreferences, *properties.CLASSES, *operators.CLASSES, *panel.CLASSES)


def register() -> None:
    """Add the add-on's classes and properties to Blender."""
    for cls in _CLASSES:
        bpy.utils.register_class(cls)
    properties.register()
    for part in (mending, staleness, storing, keymaps, menus, handlers):
        part.register()


def unregister() -> None:
    """Remove all that `register` added; a build or a drive that runs is stopped."""
    background.stop()
    solo_class.stop()
    session.unregister()
    for part in (handlers, menus, keymaps, storing, staleness, mending):
        part.unregister()
    properties.unregister()
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
    building.forget()
    inspector.forget()
    coverage_picture.free()
    actions.forget()
