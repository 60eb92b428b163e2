# SPDX-License-Identifier: GPL-3.0-or-later
"""All that the add-on adds to Blender, where its core can be loaded."""

from __future__ import annotations

import atexit

import bpy

from . import command_line, operators
from .character import building, coverage_picture, inspector, staleness, storing
from .compat import icons
from .drive import handlers
from .games import serving
from .mocap import actions
from .operators.base import background
from .panels import menus, panel
from .preview import waking
from .settings import keymaps, mending, preferences, properties

_CLASSES = (
    preferences.FragmotionPreferences,
    *properties.CLASSES,
    *operators.CLASSES,
    *operators.DROP_HANDLERS,
    *panel.CLASSES,
    *menus.CLASSES,
)


def register() -> None:
    """Add the add-on's classes and properties to Blender."""
    for cls in _CLASSES:
        bpy.utils.register_class(cls)
    properties.register()
    for part in (icons, mending, staleness, storing, keymaps, menus, handlers, command_line):
        part.register()
    if getattr(bpy.app, "module", False):
        # A script that ends without unregistering: Blender waits for timers for ever, and frees a command by a Python
        # that is no more.
        atexit.register(unregister)


def unregister() -> None:
    """Remove all that `register` added; a build or a drive that runs is stopped."""
    atexit.unregister(unregister)
    background.stop()
    serving.stop()
    waking.unregister()
    for part in (command_line, handlers, menus, keymaps, storing, staleness, mending, icons):
        part.unregister()
    properties.unregister()
    for cls in reversed(_CLASSES):
        bpy.utils.unregister_class(cls)
    building.forget()
    inspector.forget()
    coverage_picture.free()
    actions.forget()
