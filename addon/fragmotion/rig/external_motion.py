# SPDX-License-Identifier: GPL-3.0-or-later
"""What moves an armature beside the keys of its Action, in words that name it."""

from __future__ import annotations

import bpy

_CHANNELS = ("location", "rotation_euler", "rotation_quaternion", "rotation_axis_angle", "scale", "rotation_mode")


def external_motion(obj: bpy.types.Object) -> list[str]:
    """The constraints, drivers and moving parents that act on the armature whatever Action it plays."""
    of_bones = [f"'{c.name}' of bone '{bone.name}'" for bone in obj.pose.bones for c in bone.constraints if _acts(c)]
    return [
        *_first("constraint", of_bones),
        *_first("object constraint", [f"'{c.name}'" for c in obj.constraints if _acts(c)]),
        *_first("driver of", [driver.data_path for driver in _drivers(obj)]),
        *_first("moving parent", [f"'{parent.name}'" for parent in _ancestors(obj) if _moves(parent)]),
    ]


def animated(obj: bpy.types.Object) -> bool:
    """Whether keys, drivers, constraints or parents may move an object that is no armature, or change its shape."""
    shapes = getattr(obj.data, "shape_keys", None)
    return any(_moves(each) for each in (obj, *_ancestors(obj))) or bool(shapes and shapes.animation_data)


def _first(kind: str, names: list[str]) -> list[str]:
    """The first of the names with its kind, and how many more there are; nothing where there is none."""
    names = list(dict.fromkeys(names))
    more = f" and {len(names) - 1} more" if len(names) > 1 else ""
    return [f"{kind} {names[0]}{more}"] if names else []


def _acts(constraint: bpy.types.Constraint) -> bool:
    return not constraint.mute and constraint.influence > 0


def _drivers(obj: bpy.types.Object) -> list[bpy.types.FCurve]:
    """The drivers of the place or the pose, or of a constraint."""
    drivers = obj.animation_data.drivers if obj.animation_data else ()
    return [driver for driver in drivers if not driver.mute and _is_motion(driver.data_path)]


def _is_motion(path: str) -> bool:
    return path.rpartition(".")[2].replace("delta_", "") in _CHANNELS or "constraints[" in path


def _ancestors(obj: bpy.types.Object) -> list[bpy.types.Object]:
    return [] if obj.parent is None else [obj.parent, *_ancestors(obj.parent)]


def _moves(obj: bpy.types.Object) -> bool:
    """Whether keys, drivers or constraints may move an object, or the bones of an armature."""
    data = obj.animation_data
    animated = data is not None and (data.action is not None or bool(data.nla_tracks) or bool(data.drivers))
    bones = obj.pose.bones if obj.pose else ()
    return animated or any(_acts(c) for owner in (obj, *bones) for c in owner.constraints)
