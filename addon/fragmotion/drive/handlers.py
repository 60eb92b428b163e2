# SPDX-License-Identifier: GPL-3.0-or-later
"""What ends a drive beside its user, and what heals files and undo steps that were made in the middle of one."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.app.handlers import persistent

from . import aside, session


def _end(*_arguments: Any) -> None:
    """Another file, or another state of this one, comes: what is driven goes."""
    session.stop(push=False)


def _heal(*_arguments: Any) -> None:
    aside.heal()


def _give_back(*_arguments: Any) -> None:
    """The file is saved with the armature as it was; the next update goes on."""
    if session.current is not None:
        session.current.give_back()


_HANDLERS = {
    "load_pre": _end,
    "undo_pre": _end,
    "redo_pre": _end,
    "load_post": _heal,
    "undo_post": _heal,
    "redo_post": _heal,
    "save_pre": _give_back,
}


def register() -> None:
    """Listen to Blender."""
    for name, handler in _HANDLERS.items():
        getattr(bpy.app.handlers, name).append(persistent(handler))


def unregister() -> None:
    """Listen no more."""
    for name, handler in _HANDLERS.items():
        getattr(bpy.app.handlers, name).remove(handler)
