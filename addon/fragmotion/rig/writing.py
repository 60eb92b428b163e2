# SPDX-License-Identifier: GPL-3.0-or-later
"""Poses to an Action's F-curves, each bone in its own rotation mode."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import bpy
import numpy as np

from ..compat import versions
from .keys import Poses, Track, make_layout, make_tracks

if TYPE_CHECKING:
    from fragmotion_core import Doubles, Ints
    from numpy.typing import NDArray

    Floats = NDArray[np.float32]

LINEAR, _BEZIER = 1, 2
"""RNA's numbers of the interpolations 'LINEAR' and 'BEZIER'."""

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
        points = _points(times, track)
        for index in range(len(points)):
            curve = holder.fcurves.find(track.path, index=index)
            if curve is None:
                curve = versions.new_curve(holder, track.path, index, track.group or _OBJECT_GROUP)
            _clear_span(curve, times[0], times[-1])
            slopes = None if track.slopes is None else track.slopes[:, index]
            _add_keys(curve, points[index], _handles(times, track.kept, slopes))


def _points(times: Doubles, track: Track) -> Floats:
    """Where the keys are of each of a track's curves [N,K,2]: scene frames and values."""
    points = np.empty((track.values.shape[1], len(track.kept), 2), np.float32)
    points[:, :, 0] = times[track.kept]
    points[:, :, 1] = track.values[track.kept].T
    return points


def _clear_span(curve: bpy.types.FCurve, first: float, last: float) -> None:
    keys = curve.keyframe_points
    for index in reversed(range(len(keys))):
        if first - _SAME_FRAME < keys[index].co.x < last + _SAME_FRAME:
            keys.remove(keys[index], fast=True)


class _Handles(NamedTuple):
    """Where handles are from their keys [K,2]: scene frames and values."""

    left: Doubles
    right: Doubles


def _handles(times: Doubles, kept: Ints, slopes: Doubles | None) -> _Handles | None:
    """The handles of a Bezier curve that is a cubic Hermite one: a third of the way to the keys beside."""
    if slopes is None or len(kept) < 2:
        return None
    ways, frames = np.diff(times[kept]) / 3, np.diff(kept) / 3
    before, after = np.r_[ways[0], ways], np.r_[ways, ways[-1]]
    rise_before, rise_after = slopes * np.r_[frames[0], frames], slopes * np.r_[frames, frames[-1]]
    return _Handles(np.column_stack((-before, -rise_before)), np.column_stack((after, rise_after)))


def _add_keys(curve: bpy.types.FCurve, points: Floats, handles: _Handles | None) -> None:
    """Keys [K,2] beside those that the curve has: Bezier ones with handles, linear ones without."""
    keys = curve.keyframe_points
    former = len(keys)
    keys.add(len(points))
    _set_last(keys, "co", former, points.ravel(), np.float32)
    _set_last(keys, "interpolation", former, LINEAR if handles is None else _BEZIER, np.int32)
    if handles is not None:
        for key in keys[former:]:  # Blender 3.4 sets no handle types all at once
            key.handle_left_type = key.handle_right_type = "ALIGNED"
        for side, offsets in handles._asdict().items():
            _set_last(keys, f"handle_{side}", former, (points + offsets).ravel(), np.float32)
    curve.update()


def _set_last(keys: Any, name: str, former: int, values: NDArray[Any] | int, kind: type) -> None:
    """A property of the keys from the number `former` on."""
    width = 2 if isinstance(values, np.ndarray) else 1
    every: NDArray[Any] = np.empty(width * len(keys), kind)
    if former > 0:
        keys.foreach_get(name, every)
    every[width * former :] = values
    keys.foreach_set(name, every)


def keep_former(obj: bpy.types.Object, action: bpy.types.Action) -> None:
    """Save the Action that the armature played so far from being lost when nothing else uses it."""
    former, _ = versions.assignment(obj)
    if former not in (None, action) and former.users == 1 and former.library is None:
        former.use_fake_user = True
