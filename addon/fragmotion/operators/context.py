# SPDX-License-Identifier: GPL-3.0-or-later
"""What operators ask of the context."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import bpy

from ..drive import session


def active_armature(context: bpy.types.Context) -> Any:
    """The active object where it is an armature, else the armature that deforms or carries it, if any."""
    obj = context.active_object
    while obj is not None and obj.type != "ARMATURE":
        obj = obj.find_armature() or obj.parent
    return obj


def poll_armature(cls: Any, context: bpy.types.Context) -> bool:
    """Whether an armature that can be changed is active; says why not."""
    obj = active_armature(context)
    if session.current is not None:
        cls.poll_message_set(f"'{session.current.armature}' is being driven: stop that first (Esc)")
    elif obj is None:
        cls.poll_message_set("No armature is active: import mocap, or click an armature or its mesh")
    elif not can_change(obj):
        cls.poll_message_set(advise_on_foreign(obj))
    elif context.mode not in {"OBJECT", "POSE"}:
        cls.poll_message_set("Leave this mode first: it works in Object Mode and Pose Mode")
    else:
        return True
    return False


def can_change(obj: Any) -> bool:
    """Whether there is an armature, and it is this file's own."""
    return obj is not None and not _is_foreign(obj) and not _is_foreign(obj.data)


def _is_foreign(data: bpy.types.ID) -> bool:
    """Whether another file has the last word on the data-block: what a build keeps in it would not be saved."""
    return data.library is not None or data.override_library is not None


def advise_on_foreign(obj: bpy.types.Object) -> str:
    """What to do about an armature that is not this file's own."""
    state = "is a library override" if obj.override_library is not None else "is linked from another file"
    in_linked_collection = any(collection.library is not None for collection in obj.users_collection)
    choice = "All" if in_linked_collection else "Selected Objects and Data"
    return (
        f"Armature '{obj.name}' {state}, where no character can be kept: select it and choose, in Object Mode, "
        f"Object > Relations > Make Local > {choice}"
    )


@contextmanager
def progress_shown(context: bpy.types.Context) -> Iterator[Callable[[float], None]]:
    """Shows beside the mouse what share is done, as what this gives is told."""
    manager = context.window_manager
    manager.progress_begin(0, 100)
    try:
        yield lambda fraction: manager.progress_update(100 * fraction)
    finally:
        manager.progress_end()


def adopt_settings(operator: Any, settings: Any) -> None:
    """Give the operator the panel's settings for every field that its caller did not set."""
    names = {name for base in type(settings).__mro__ for name in getattr(base, "__annotations__", {})}
    for name in names:
        if not operator.properties.is_property_set(name):
            setattr(operator, name, getattr(settings, name))
