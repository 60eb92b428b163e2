# SPDX-License-Identifier: GPL-3.0-or-later
"""Bones that are scaled: what makes the whole body larger, and what is left out of the rest, in words that name it."""

from __future__ import annotations

from collections.abc import Container, Iterable, Iterator, Sequence
from itertools import chain

import bpy
import numpy as np

from ..compat import versions
from .hanging import least_way
from .rigs import SIZES, bone_path, sizes_of

_UNIFORM = 0.01  # a scale that differs by less is the same: the core's law for an object's
_NOT_PASSED_ON = ("NONE", "NONE_LEGACY")


def keep_sizes(obj: bpy.types.Object, actions: Sequence[bpy.types.Action]) -> None:
    """Keep with the armature by how much bones are scaled that carry half of it or more: one scale along all axes, in
    all these Actions the same, or in the pose where none keys it. So importers of glTF pose a file's root."""
    found = dict(_sizes(obj, actions))
    if found:
        obj[SIZES] = found
    elif SIZES in obj:
        del obj[SIZES]


def _sizes(obj: bpy.types.Object, actions: Sequence[bpy.types.Action]) -> Iterator[tuple[str, float]]:
    keyed = list(_keyed(obj, actions))
    scales: dict[str, list[float]] = {}
    for path, scale in chain(keyed, _posed(obj, {path for path, _ in keyed})):
        scales.setdefault(path, []).append(scale)
    driven = {driver.data_path for driver in (obj.animation_data.drivers if obj.animation_data else ())}
    for bone in obj.data.bones:
        path = bone_path(bone.name, "scale")
        least, most = min(scales[path]), max(scales[path])
        if path in driven or least <= 0 or most - least > _UNIFORM * least or abs(most - 1) <= _UNIFORM:
            continue
        below = bone.children_recursive
        carries = 2 * (len(below) + 1) >= len(obj.data.bones)
        if carries and not any(each.inherit_scale in _NOT_PASSED_ON for each in below):
            yield bone.name, (least + most) / 2


def say_scaled(obj: bpy.types.Object, actions: Sequence[bpy.types.Action]) -> list[str]:
    """Which bones these Actions scale so much that it is seen, or the pose where they do not, and by how much at most;
    nothing where none."""
    least, bones = least_way(obj), {bone_path(bone.name, "scale"): bone for bone in obj.data.bones}
    found, larger = dict[str, float](), sizes_of(obj)
    keyed = list(_keyed(obj, actions))
    for path, scale in [*keyed, *_posed(obj, {path for path, _ in keyed})]:
        bone = bones.get(path)
        if bone is not None and bone.name not in larger and abs(scale - 1) * bone.length > least:
            times = max(scale, 1 / max(abs(scale), 1e-3))
            found[bone.name] = max(found.get(bone.name, 1), times)
    if not found:
        return []
    first, more = max(found, key=found.__getitem__), f" and {len(found) - 1} more" if len(found) > 1 else ""
    return [
        f"Left out: the scale of bone '{first}'{more}, up to {found[first]:.3g} times. The body is learned as large as "
        "it rests"
    ]


def _keyed(obj: bpy.types.Object, actions: Iterable[bpy.types.Action]) -> Iterable[tuple[str, float]]:
    """The path of each curve that scales, and the least and the greatest of its keys."""
    for action in actions:
        for curve in versions.curves_of(action, obj):
            if curve.data_path.endswith(".scale") and len(curve.keyframe_points):
                keys = np.empty(2 * len(curve.keyframe_points), np.float32)
                curve.keyframe_points.foreach_get("co", keys)
                yield curve.data_path, float(keys[1::2].min())
                yield curve.data_path, float(keys[1::2].max())


def _posed(obj: bpy.types.Object, keyed: Container[str]) -> Iterable[tuple[str, float]]:
    """The same of the pose, where no curve scales."""
    for bone in obj.pose.bones:
        path = bone_path(bone.name, "scale")
        if path not in keyed:
            yield from ((path, scale) for scale in bone.scale)
