# SPDX-License-Identifier: GPL-3.0-or-later
"""Poses to an Action's F-curves, each bone in its own rotation mode."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ..compat import versions
from .keys import Poses, Track, make_layout, make_tracks

if TYPE_CHECKING:
    from fragmotion_core import Doubles

LINEAR = 1
"""RNA's number of the interpolation 'LINEAR'."""

_OBJECT_GROUP = "Object Transforms"  # as Blender's own keying names it
_SAME_FRAME = 0.01  # keys closer than this to a frame are on it


def write_poses(
    action: bpy.types.Action,
    obj: bpy.types.Object,
    times: Doubles,
    locations: Doubles,
    rotations: Doubles,
    moving: Collection[str],
) -> None:
    """Key all bones' rotations [F,B,4] and the `moving` bones' locations [F,B,3] at the times (scene frames).

    Bones are in the armature's order. The object's former keys in the Action go.
    """
    tracks = make_tracks(make_layout(obj, moving), Poses(locations, rotations))
    write_tracks(action, obj, times, tracks, replace=True)


def write_tracks(
    action: bpy.types.Action, obj: bpy.types.Object, times: Doubles, tracks: Sequence[Track], replace: bool
) -> None:
    """Key the tracks, frame F at times[F]. The object's former keys in the Action go: all of them with `replace`, else
    the tracks' own from the first of the times to the last."""
    holder = versions.holder_for(action, obj)
    if replace:
        holder.fcurves.clear()
    for track in tracks:
        for index, values in enumerate(track.values.T):
            curve = holder.fcurves.find(track.path, index=index)
            if curve is None:
                curve = versions.new_curve(holder, track.path, index, track.group or _OBJECT_GROUP)
            _clear_span(curve, times[0], times[-1])
            _add_keys(curve, times[track.kept], values[track.kept])


def _clear_span(curve: bpy.types.FCurve, first: float, last: float) -> None:
    keys = curve.keyframe_points
    for index in reversed(range(len(keys))):
        if first - _SAME_FRAME < keys[index].co.x < last + _SAME_FRAME:
            keys.remove(keys[index], fast=True)


def _add_keys(curve: bpy.types.FCurve, times: Doubles, values: Doubles) -> None:
    """Linear keys beside those that the curve has."""
    keys = curve.keyframe_points
    former = len(keys)
    keys.add(len(times))
    points = np.empty(2 * len(keys), np.float32)
    keys.foreach_get("co", points)
    points[2 * former :] = np.column_stack((times, values)).ravel()
    keys.foreach_set("co", points)
    kinds = np.empty(len(keys), np.int32)
    keys.foreach_get("interpolation", kinds)
    kinds[former:] = LINEAR
    keys.foreach_set("interpolation", kinds)
    curve.update()


def keep_former(obj: bpy.types.Object, action: bpy.types.Action) -> None:
    """Save the Action that the armature played so far from being lost when nothing else uses it."""
    former, _ = versions.assignment(obj)
    if former not in (None, action) and former.users == 1 and former.library is None:
        former.use_fake_user = True
