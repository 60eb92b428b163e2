# SPDX-License-Identifier: GPL-3.0-or-later
"""Fragmotion: turns motion capture into a character that you can drive."""

from __future__ import annotations

from .compat import missing

_cause: missing.CoreMissing | None = None
try:
    from . import registering
except missing.CoreMissing as error:
    _cause = error

bl_info = {
    "name": "Fragmotion",
    "author": "Fragmotion contributors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D Viewport > Sidebar > Fragmotion",
    "description": "Turns motion capture into a character that you can drive",
    "category": "Animation",
}


def register() -> None:
    """Add the add-on's classes and properties to Blender; without its core, one panel that says why."""
    if _cause:
        missing.register(_cause)
    else:
        registering.register()


def unregister() -> None:
    """Remove all that `register` added; a build or a drive that runs is stopped."""
    if _cause:
        missing.unregister()
    else:
        registering.unregister()
