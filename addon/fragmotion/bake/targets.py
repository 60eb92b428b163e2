# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a bake goes: a new Action, the Action that plays, or an NLA strip; whole, or not at all."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, NamedTuple

import bpy
import numpy as np

from ..character.classes import name_of
from ..compat import versions
from ..errors import UserError
from ..mocap.actions import BAKED, RATE
from ..rig.keys import Track
from ..rig.posing import CHANNELS, pose_of, reset_pose, set_pose
from ..rig.writing import keep_former, write_tracks

if TYPE_CHECKING:
    from fragmotion_core import Ints


class Target(NamedTuple):
    """Where a bake goes: the kind of BakeFields.target, or STRIPS, which play the Action already; the Action to write
    to where there is one, else the name of the new one, and the scene frame of the first key."""

    kind: str
    action: bpy.types.Action | None
    name: str
    first: int


def find_target(context: bpy.types.Context, obj: bpy.types.Object, settings: Any, recording: str) -> Target:
    """Where settings with BakeFields want the bake of a recording of that name; UserError where keys would be lost."""
    if settings.target == "CURRENT":
        return Target("CURRENT", _current_action(obj), "", context.scene.frame_current)
    name = settings.action or f"{recording or obj.name} Bake"
    return Target(settings.target, _replaceable(settings.action), name, settings.frame_start)


def write(
    context: bpy.types.Context,
    obj: bpy.types.Object,
    target: Target,
    tracks: Sequence[Track],
    classes: Ints,
    settings: Any,
) -> bpy.types.Action:
    """Write the tracks and let the armature play them; on an error the file is as before."""
    times = np.asarray(target.first + np.arange(len(classes)), dtype=float)
    with _whole_or_not_at_all(context, obj, target.action):
        action = target.action or bpy.data.actions.new(target.name)
        if target.kind != "CURRENT":
            action[BAKED] = True
        write_tracks(action, obj, times, tracks, replace=target.kind != "CURRENT")
        reset_pose(obj, ("location", "scale"))
        if target.kind == "NLA":
            _add_strip(obj, action, target.first)
        elif target.kind != "STRIPS":
            keep_former(obj, action)
            versions.assign(obj, action)
        _mark(context.scene, obj, action, target, classes, settings.markers)
        for strip in strips_of(obj, action) if target.kind == "STRIPS" else ():
            strip.action_frame_start, strip.action_frame_end = action.frame_range
        if settings.fit_end:
            context.scene.frame_end = max(context.scene.frame_end, int(times[-1]))
        context.view_layer.update()
    return action


def _current_action(obj: bpy.types.Object) -> bpy.types.Action:
    action, _ = versions.assignment(obj)
    if action is None:
        raise UserError(f"Armature '{obj.name}' plays no Action to bake into: bake to a new Action")
    _check_writable(action)
    return action


def _replaceable(name: str) -> bpy.types.Action | None:
    """The Action of that name to write to, or None for a new one."""
    action = bpy.data.actions.get(name) if name else None
    if action is None:
        return None
    _check_writable(action)
    if BAKED not in action and versions.count_curves(action) > 0:
        raise UserError(f"Action '{name}' holds keys that no bake made, which would be lost: choose another name")
    return action


def _check_writable(action: bpy.types.Action) -> None:
    if action.library is not None:
        raise UserError(f"Action '{action.name}' is linked from '{action.library.filepath}': choose another name")
    if RATE in action or action.fragmotion.use:
        raise UserError(f"Action '{action.name}' is a take that Build learns from: choose another name, or untick it")


def places_object(obj: bpy.types.Object) -> bool:
    """Whether keys that would go on below a new NLA strip say where the armature object itself is."""
    data = obj.animation_data
    tracks = [track for track in data.nla_tracks if not track.mute] if data is not None else []
    below = [strip.action for track in tracks for strip in track.strips if not strip.mute]
    actions = [action for action in (versions.assignment(obj)[0], *below) if action is not None]
    return any(curve.data_path in CHANNELS for action in actions for curve in versions.curves_of(action, obj))


def strips_of(obj: bpy.types.Object, action: bpy.types.Action) -> list[bpy.types.NlaStrip]:
    """The armature's NLA strips that play an Action."""
    tracks = obj.animation_data.nla_tracks if obj.animation_data is not None else ()
    return [strip for track in tracks for strip in track.strips if strip.action == action]


def _add_strip(obj: bpy.types.Object, action: bpy.types.Action, first: int) -> None:
    """A strip on a new track on top; the Action that played until now is pushed down onto a track below it."""
    data = obj.animation_data or obj.animation_data_create()
    former, _ = versions.assignment(obj)
    if former not in (None, action) and versions.curves_of(former, obj):
        _add_track(obj, former, round(former.frame_range[0]))
    data.action = None
    strip = _add_track(obj, action, first)
    strip.extrapolation = "NOTHING"
    data.use_nla = True


def _add_track(obj: bpy.types.Object, action: bpy.types.Action, first: int) -> bpy.types.NlaStrip:
    track = obj.animation_data.nla_tracks.new()
    track.name = action.name
    strip = track.strips.new(action.name, first, action)
    versions.assign_strip(strip, action, obj)
    return strip


def _mark(
    scene: bpy.types.Scene,
    obj: bpy.types.Object,
    action: bpy.types.Action,
    target: Target,
    classes: Ints,
    markers: str,
) -> None:
    """Markers named after the classes where these change; an Action's own former ones on these frames go."""
    last = target.first + len(classes) - 1
    for marker in list(action.pose_markers):
        if target.kind != "CURRENT" or target.first <= marker.frame <= last:
            action.pose_markers.remove(marker)
    changes = np.flatnonzero(np.diff(classes, prepend=-1))
    for index in changes if markers != "NONE" else ():
        name, frame = name_of(obj, 0, int(classes[index])), target.first + int(index)
        if markers == "SCENE":
            scene.timeline_markers.new(name, frame=frame)
        else:
            action.pose_markers.new(name).frame = frame


@contextmanager
def _whole_or_not_at_all(
    context: bpy.types.Context, obj: bpy.types.Object, target: bpy.types.Action | None
) -> Iterator[None]:
    """On an error all that a bake changes is put back."""
    before = _Before(context.scene, obj, target)
    try:
        yield
    except BaseException:
        before.put_back()
        context.view_layer.update()
        raise
    before.forget()


class _Before:
    """What a bake may change, as it was."""

    def __init__(self, scene: bpy.types.Scene, obj: bpy.types.Object, target: bpy.types.Action | None) -> None:
        self._scene, self._obj, self._target = scene, obj, target
        self._backup = target.copy() if target is not None else None
        self._actions = set(bpy.data.actions)
        self._markers, self._end = set(scene.timeline_markers), scene.frame_end
        self._pose, self._played = pose_of(obj), versions.assignment(obj)
        former = self._played[0]
        self._fake_user = former is not None and former.use_fake_user
        data = obj.animation_data
        self._had_data = data is not None
        self._tracks = set(data.nla_tracks) if data is not None else set()
        self._use_nla = data is not None and data.use_nla

    def forget(self) -> None:
        """All went well."""
        if self._backup is not None:
            bpy.data.actions.remove(self._backup)

    def put_back(self) -> None:
        """Undo what was done since."""
        self._put_back_animation()
        for marker in set(self._scene.timeline_markers) - self._markers:
            self._scene.timeline_markers.remove(marker)
        self._scene.frame_end = self._end
        for action in set(bpy.data.actions) - self._actions:
            bpy.data.actions.remove(action)
        self._put_back_target()
        set_pose(self._obj, self._pose)

    def _put_back_animation(self) -> None:
        data = self._obj.animation_data
        if data is None:
            return
        for track in set(data.nla_tracks) - self._tracks:
            data.nla_tracks.remove(track)
        data.use_nla = self._use_nla
        versions.restore(self._obj, self._played)
        if self._played[0] is not None:
            self._played[0].use_fake_user = self._fake_user
        if not self._had_data:
            self._obj.animation_data_clear()

    def _put_back_target(self) -> None:
        """The copy takes the place of the Action that was written to."""
        target, backup = self._target, self._backup
        if target is None or backup is None:
            return
        name, backup.use_fake_user = target.name, target.use_fake_user
        target.user_remap(backup)
        bpy.data.actions.remove(target)
        backup.name = name
