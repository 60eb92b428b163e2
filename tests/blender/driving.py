# SPDX-License-Identifier: MIT
"""Steps and views of a drive without its window, for the tests."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from types import ModuleType
from typing import Any

import bpy
import making
import numpy as np

RATE = 60


def recorded(session: ModuleType) -> ModuleType:
    """The add-on's drives by a recording."""
    return import_module(f"{session.__package__}.recorded")


def start(session: ModuleType, obj: bpy.types.Object) -> Any:
    """Drive the armature by itself: the stick is as the character sees it."""
    obj.fragmotion.drive.relative = "CHARACTER"
    return session.start(bpy.context, obj)


def go_on(driven: Any, seconds: float, rate: float = RATE) -> None:
    """Let time pass, an update at a time."""
    for _ in range(round(seconds * rate)):
        driven.update(1 / rate)


def hips(obj: bpy.types.Object) -> np.ndarray:
    """Where Blender shows the hips' head, m."""
    posed = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return np.array(posed.matrix_world @ posed.pose.bones["hips" if "hips" in obj.pose.bones else "Hips"].head)


def way(places: Sequence[Sequence[float]]) -> float:
    """How long the way is that goes through these places (x and y come first), m."""
    return float(np.linalg.norm(np.diff(np.array(places)[:, :2], axis=0), axis=1).sum())


def everything(obj: bpy.types.Object) -> dict[str, Any]:
    """All of the armature and its scene that a drive touches, or its user may."""
    data, scene = obj.animation_data, bpy.context.scene
    bpy.context.view_layer.update()
    channels = ("location", "rotation_quaternion", "rotation_euler", "rotation_axis_angle", "scale")
    return {
        **making.contents(),
        "bones": {bone.name: [tuple(getattr(bone, name)) for name in channels] for bone in obj.pose.bones},
        "matrices": [tuple(map(tuple, bone.matrix)) for bone in obj.pose.bones],
        "modes": [bone.rotation_mode for bone in obj.pose.bones],
        "place": [tuple(getattr(obj, name)) for name in channels],
        "data": data and (data.action, data.use_nla, getattr(data, "action_slot", None)),
        "position": obj.data.pose_position,
        "properties": sorted(obj.keys()),
        "time": (scene.frame_current, scene.frame_subframe),
    }
