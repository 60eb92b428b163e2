# SPDX-License-Identifier: GPL-3.0-or-later
"""What operators ask of the context."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any, ClassVar

import bpy

from ...control_rig.binding import motion_of, rig_of
from ...control_rig.detecting import is_control_rig
from ...drive import session
from ...errors import UserError
from ...mocap.actions import chosen
from ...preview import previews
from ...recordings.curves import curves_of
from ...recordings.recordings import Recording


def active_armature(context: bpy.types.Context) -> Any:
    """The active armature as takes and characters see it: in place of a control rig that has one, its motion skeleton.
    None where no armature is active."""
    rig = active_rig(context)
    return rig and (motion_of(rig) or rig)


def active_rig(context: bpy.types.Context) -> Any:
    """The active object where it is an armature, else the armature that deforms or carries it, if any, else the only
    one that hangs on what it hangs on, as on the Empty of a file from a store; the rig in place of its motion
    skeleton."""
    obj = context.active_object
    while obj is not None and obj.type != "ARMATURE":
        obj = obj.find_armature() or obj.parent or _only_armature_below(obj)
    return obj and rig_of(obj)


def _only_armature_below(top: bpy.types.Object) -> bpy.types.Object | None:
    below = [child for child in top.children_recursive if child.type == "ARMATURE"]
    return below[0] if len(below) == 1 else None


def poll_idle(cls: Any) -> bool:
    """Whether nothing is being driven or previewed; says what is."""
    if session.current is not None:
        cls.poll_message_set(f"'{session.current.armature}' is being driven: stop that first (Esc)")
    elif previews.current is not None:
        cls.poll_message_set(f"{previews.current.name} is being played: stop that first (Esc)")
    return session.current is None and previews.current is None


def poll_armature(cls: Any, context: bpy.types.Context) -> bool:
    """Whether an armature that can be changed is active; says why not."""
    return _poll(cls, context, active_armature(context))


def poll_rig(cls: Any, context: bpy.types.Context) -> bool:
    """The same of the rig itself, where it has a motion skeleton."""
    return _poll(cls, context, active_rig(context))


def _poll(cls: Any, context: bpy.types.Context, obj: Any) -> bool:
    if not poll_idle(cls):
        return False
    if obj is None:
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


def check_plain(obj: bpy.types.Object) -> None:
    """UserError where keys on the armature's bones would move nothing."""
    if is_control_rig(obj):
        raise UserError(
            f"Armature '{obj.name}' is a control rig: keys on its bones move nothing, as its controls do. Press Make "
            "Motion Skeleton first, under Control Rig"
        )


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


def first_frame(obj: bpy.types.Object, recording: Recording) -> float:
    """The scene frame at which a recording begins: as its curves show it, or where Bake puts it."""
    if curves_of(obj, recording) is not None:
        return float(recording.curves_first)
    return float(obj.fragmotion.bake.frame_start)


def playhead(context: bpy.types.Context, recording: Recording) -> float:
    """Where the playhead is in the recording, in seconds from its beginning."""
    begin = first_frame(active_armature(context), recording)
    return float(context.scene.frame_current_final - begin) / frame_rate(context, recording)


def frame_rate(context: bpy.types.Context, recording: Recording) -> float:
    """The scene's frames in a second of a recording: as its curves show it, or as Bake makes them."""
    render = context.scene.render
    shows_curves = curves_of(active_armature(context), recording) is not None
    return float(recording.curves_rate if shows_curves else render.fps / render.fps_base)


class OnTake:
    """An operator on the take that is chosen in the panel's list."""

    bl_options: ClassVar[set[str]] = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls: Any, context: bpy.types.Context) -> bool:
        if not poll_armature(cls, context):
            return False
        action = chosen(context, active_armature(context))
        if action is None:
            cls.poll_message_set("No take is chosen in the list under Mocap")
        elif action.library is not None:
            cls.poll_message_set(f"Action '{action.name}' is linked from another file")
        return action is not None and action.library is None
