# SPDX-License-Identifier: GPL-3.0-or-later
"""Bones that are scaled, of which nothing is learned, in words that name them."""

from __future__ import annotations

from collections.abc import Container, Iterable, Sequence

import bpy
import numpy as np

from ..compat import versions
from .hanging import least_way
from .rigs import bone_path


def say_scaled(obj: bpy.types.Object, actions: Sequence[bpy.types.Action]) -> list[str]:
    """Which bones these Actions scale so much that it is seen, or the pose where they do not, and by how much at most;
    nothing where none."""
    least, bones = least_way(obj), {bone_path(bone.name, "scale"): bone for bone in obj.data.bones}
    found: dict[str, float] = {}
    keyed = list(_keyed(obj, actions))
    for path, scale in [*keyed, *_posed(obj, {path for path, _ in keyed})]:
        bone = bones.get(path)
        if bone is not None and abs(scale - 1) * bone.length > least:
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
