# SPDX-License-Identifier: GPL-3.0-or-later
"""What operators ask of the context."""

from __future__ import annotations

from typing import Any

import bpy


def active_armature(context: bpy.types.Context) -> Any:
    """The active object where it is an armature."""
    obj = context.active_object
    return obj if obj is not None and obj.type == "ARMATURE" else None


def poll_armature(cls: Any, context: bpy.types.Context) -> bool:
    """Whether an armature that can be changed is active; says why not."""
    obj = active_armature(context)
    if obj is None:
        cls.poll_message_set("No armature is active: import mocap, or click an armature in the viewport")
    elif obj.library is not None or obj.data.library is not None:
        cls.poll_message_set("The armature is linked from another file: make it local first")
    elif context.mode not in {"OBJECT", "POSE"}:
        cls.poll_message_set("Leave this mode first: it works in Object Mode and Pose Mode")
    else:
        return True
    return False


def adopt_settings(operator: Any, settings: Any, fields: type) -> None:
    """Give the operator the panel's settings for every field that its caller did not set."""
    names = {name for base in fields.__mro__ for name in getattr(base, "__annotations__", {})}
    for name in names:
        if not operator.properties.is_property_set(name):
            setattr(operator, name, getattr(settings, name))
