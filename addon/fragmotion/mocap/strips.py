# SPDX-License-Identifier: GPL-3.0-or-later
"""NLA strips as takes: Actions that hold what strips make of theirs by scale, repeats, reversal and cutting."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ..rig.rigs import carriers
from ..rig.writing import write_poses
from .actions import RATE, SCENE_RATE, fits_cached, rate_of
from .retargeting import key_times, make_action, take_after
from .sampling import rig_as_posed, sample_at, scene_rate

if TYPE_CHECKING:
    from fragmotion_core import Doubles

_SAME = 1e-3  # frames


def strips_of(obj: bpy.types.Object) -> list[bpy.types.NlaStrip]:
    """The armature's strips of Actions, but muted ones, such as are in meta strips, and transitions."""
    data = obj.animation_data
    tracks = [track for track in data.nla_tracks if not track.mute] if data is not None else []
    return [
        strip
        for track in tracks
        for strip in track.strips
        if strip.type == "CLIP" and not strip.mute and strip.action is not None and fits_cached(strip.action, obj)
    ]


def actions_of_strips(context: bpy.types.Context, obj: bpy.types.Object) -> list[bpy.types.Action]:
    """New Actions, ticked in place of the strips' own: each does in its own time what a strip does alone and whole."""
    rig, strips = rig_as_posed(obj), strips_of(obj)
    clips, shown = [], []
    for strip in strips:
        rate, frames = _samples(context.scene, strip)
        clips.append(sample_at(context, obj, strip.action, rig, rate, frames))
        shown.append(frames)
    moving, made = carriers(obj, rig), []
    for strip, clip, frames in zip(strips, clips, shown):
        strip.action.fragmotion.use = False
        action = make_action(context.scene, strip.name, clip.rate)
        channels = rig.channels(clip.root_positions, clip.rotations)
        times = key_times(action, len(channels[1]))
        write_poses(action, obj, times, *channels, moving)
        take_after(strip.action, frames, action, times)
        made.append(action)
    return made


def _samples(scene: bpy.types.Scene, strip: bpy.types.NlaStrip) -> tuple[float, Doubles]:
    """Samples a second as many as the Action has, and the frames of the Action that the strip shows at them."""
    now = scene_rate(scene)
    step = rate_of(strip.action, SCENE_RATE, now) / rate_of(strip.action, RATE, now)
    count = math.floor((strip.frame_end - strip.frame_start) / step + _SAME) + 1
    return now / step, action_frames(strip, strip.frame_start + step * np.arange(count))


def action_frames(strip: bpy.types.NlaStrip, frames: Doubles) -> Doubles:
    """The frames of its Action that a strip shows at frames of the scene within it, as the NLA reckons."""
    curve = strip.fcurves.find("strip_time") if strip.use_animated_time else None
    if curve is not None:
        return np.array([curve.evaluate(frame) for frame in frames])
    first, last = strip.action_frame_start, strip.action_frame_end
    length = max(last - first, _SAME) if last > first else 1.0
    run = np.mod(frames - strip.frame_start, length * strip.scale) / strip.scale
    ends = np.abs(frames - strip.frame_end) < _SAME
    if abs(strip.repeat - round(strip.repeat)) < _SAME:  # the last frame is no new beginning
        run[ends] = length
    shown: Doubles = last - run if strip.use_reverse else first + run
    return shown
