# SPDX-License-Identifier: GPL-3.0-or-later
"""What is shown on an armature, beside a drive, ends before the armature must have been given back."""

from __future__ import annotations

import bpy
from bpy.app.handlers import persistent

from .character import solo_class
from .mocap import play_take

_EVENTS = ("save_pre", "load_pre", "undo_pre", "redo_pre")


def register() -> None:
    """Listen to Blender."""
    for name in _EVENTS:
        getattr(bpy.app.handlers, name).append(_end)


def unregister() -> None:
    """End what is shown, and listen no more."""
    _end()
    for name in _EVENTS:
        getattr(bpy.app.handlers, name).remove(_end)


@persistent  # type: ignore[untyped-decorator]
def _end(*_: object) -> None:
    solo_class.stop()
    play_take.stop()
