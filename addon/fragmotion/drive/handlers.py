# SPDX-License-Identifier: GPL-3.0-or-later
"""What ends a drive or a preview beside its user, and what heals files and undo steps that were made in the middle of
one."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.app.handlers import persistent

from ..preview import previews, suspended_state
from ..recordings.recordings import add_recording
from . import session

_recordings: list[tuple[str, dict[str, Any]]] = []  # with their armatures' names, on their way across an undo or a redo


def _end(*_arguments: Any) -> None:
    """Another file comes: what is driven or shown goes."""
    previews.stop()
    session.stop(push=False)


def _end_before_undo(*_arguments: Any) -> None:
    """Undo ends what is shown, and the drive. What that records is not lost, and a step of its own keeps what was done
    before it."""
    previews.stop()
    if _carry_recording():
        bpy.ops.ed.undo_push(message="Drive")


def _end_before_redo(*_arguments: Any) -> None:
    """Redo ends both, too. What the drive records is not lost; a step now would be in the way of those to be redone."""
    previews.stop()
    _carry_recording()


def _carry_recording() -> bool:
    """End the drive that is under way; whether it was recording."""
    driven = session.current
    if driven is None:
        return False
    recording = driven.end_recording()
    session.stop(push=False)
    driven.farewell = "The drive was ended by undo or redo"
    if recording is not None:
        driven.farewell += "; what was recorded is kept"
        _recordings.append((driven.armature, recording))
    return recording is not None


def _go_on_after_undo(*_arguments: Any) -> None:
    """Heal what the step holds of the middle of a drive, and give the armature what was recorded: a step after it."""
    suspended_state.heal()
    recordings = list(_recordings)
    _recordings.clear()
    for name, recording in recordings:
        obj = bpy.data.objects.get(name)
        if obj is not None:
            add_recording(obj, **recording)
            bpy.ops.ed.undo_push(message="Record")


def _heal(*_arguments: Any) -> None:
    suspended_state.heal()


def _give_back(*_arguments: Any) -> None:
    """The file is saved with the armature as it was; the drive's next update goes on."""
    previews.stop()
    if session.current is not None:
        session.current.give_back()


_HANDLERS = {
    "load_pre": _end,
    "undo_pre": _end_before_undo,
    "redo_pre": _end_before_redo,
    "load_post": _heal,
    "undo_post": _go_on_after_undo,
    "redo_post": _go_on_after_undo,
    "save_pre": _give_back,
}


def register() -> None:
    """Listen to Blender."""
    for name, handler in _HANDLERS.items():
        getattr(bpy.app.handlers, name).append(persistent(handler))


def unregister() -> None:
    """Listen no more, and end what is under way."""
    previews.stop()
    session.stop()
    for name, handler in _HANDLERS.items():
        getattr(bpy.app.handlers, name).remove(handler)
