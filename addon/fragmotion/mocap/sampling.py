# SPDX-License-Identifier: GPL-3.0-or-later
"""An Action as a Clip: read from its F-curves, or from Blender's evaluated pose where they are not all that moves."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import bpy
import numpy as np
from mathutils import Matrix, Quaternion, Vector

from ..compat import versions
from ..errors import SinglePose, UserError, core_errors
from ..rig import posing
from ..rig.hanging import find_hanging, moves_beside
from ..rig.held import keep_held
from ..rig.keys import from_quaternions, to_quaternions
from ..rig.rigs import FEET, bone_path, held_of, is_tied, make_rig
from . import left_out
from .actions import RATE, SCENE_RATE, animated_bones, fitting, rate_of, with_own_bones
from .curve_points import points_of, points_of_alike
from .markers import markers_of
from .other_bodies import times_longer

if TYPE_CHECKING:
    from fragmotion_core import Clip, Doubles, Rig
    from numpy.typing import NDArray

Curves = dict[tuple[str, int], bpy.types.FCurve]

_FEWEST_FRAMES = 2
_MOST_FRAMES = 2_000_000  # of an Action: more than four hours at 120 frames a second
_SAME_FRAME = 0.01  # keys closer than this to a frame are on it
_KEYED = (23.9, 60.1)  # keys a second of files for games: each is a pose of the motion
_ROTATIONS: dict[str, tuple[str, tuple[float, ...]]] = {
    "QUATERNION": ("rotation_quaternion", (1, 0, 0, 0)),
    "AXIS_ANGLE": ("rotation_axis_angle", (0, 0, 1, 0)),
}
_EULER: tuple[str, tuple[float, ...]] = ("rotation_euler", (0, 0, 0))
_OBJECT_CHANNELS = ("location", "rotation_euler", "rotation_quaternion", "rotation_axis_angle", "scale")


def rig_as_posed(obj: bpy.types.Object) -> Rig:
    """The armature as `make_rig` has it, whose bones that no Action of the file keys are held as they are posed now."""
    keep_held(obj, with_own_bones(obj))
    return make_rig(obj)


def rig_with_feet(context: bpy.types.Context, obj: bpy.types.Object) -> Rig:
    """As `rig_as_posed`, to bring motion onto: where a leg's foot hangs elsewhere, as baked targets of IK do, the
    armature's own Actions show that it moves with the leg."""
    rig = rig_as_posed(obj)
    own = fitting(obj) if obj.library is None else []
    if not own or rig.skeleton.role_map().keys() >= set(FEET):
        return rig
    find_hanging(context, obj, [action for action in own if moves_beside(obj, rig, action)])
    return make_rig(obj)


def sample(context: bpy.types.Context, obj: bpy.types.Object, action: bpy.types.Action, rig: Rig) -> Clip:
    """The Action on the armature at its own rate; SinglePose where it lasts one frame.

    A channel without keys or muted is as the armature's bone is held, else at rest; the file is as before.
    """
    curves = _checked_curves(obj, action)
    return _sample_curves(context, obj, action, rig, curves, *frame_times(context.scene, action, curves))


def sample_at(
    context: bpy.types.Context,
    obj: bpy.types.Object,
    action: bpy.types.Action,
    rig: Rig,
    rate: float,
    times: Doubles,
) -> Clip:
    """The Action at any of its frames, as a clip of so many samples a second; SinglePose where there is one alone."""
    return _sample_curves(context, obj, action, rig, _checked_curves(obj, action), rate, times)


def _sample_curves(
    context: bpy.types.Context,
    obj: bpy.types.Object,
    action: bpy.types.Action,
    rig: Rig,
    curves: Curves,
    rate: float,
    times: Doubles,
) -> Clip:
    place = f"Action '{action.name}'"
    if len(times) < _FEWEST_FRAMES:
        raise SinglePose(f"{place} holds a single pose (frame {times[0]:g}), no motion to learn from: untick it")
    with core_errors(place):
        longer = times_longer(obj, action, rig)
        if posing.is_needed(obj, curves):
            matrices, worlds = posing.sample_poses(context, obj, action, times, longer)
            clip = rig.clip_from_matrices(action.name, rate, matrices, worlds)
        else:
            sampled = _Sampled(curves, times)
            clip = rig.clip(action.name, rate, *_sample_bones(obj, sampled, longer), _sample_object(obj, sampled))
        return clip.with_markers(markers_of(action, times))


def sample_parts(context: bpy.types.Context, obj: bpy.types.Object, action: bpy.types.Action, rig: Rig) -> list[Clip]:
    """As `sample`, cut into parts around the frames that are left out of the Action."""
    clip, spans = sample(context, obj, action, rig), left_out.spans_of(action)
    if not spans:
        return [clip]
    return left_out.cut(clip, rig.skeleton, sample_times(context.scene, obj, action), spans)


def scene_rate(scene: bpy.types.Scene) -> float:
    """The scene's frames a second."""
    return float(scene.render.fps / scene.render.fps_base)


def frame_times(scene: bpy.types.Scene, action: bpy.types.Action, curves: Curves) -> tuple[float, Doubles]:
    """The rate at which to sample (an imported take's own, else the scene's), and the scene frames of the samples.

    An imported take keeps its own time when the scene's rate is changed after the import, as it remembers the rate for
    which its keys were laid. Any other Action lasts as long as the scene plays it now, and is sampled from its first
    key to its last, which are the same pose in a loop, however many frames of this scene lie between them.
    """
    rate = rate_of(action, RATE, scene_rate(scene))
    step = rate_of(action, SCENE_RATE, scene_rate(scene)) / rate
    if action.use_frame_range:
        first, last = action.frame_range
    else:
        ranges = [curve.range() for curve in curves.values()]
        first, last = min(r[0] for r in ranges), max(r[1] for r in ranges)
    frames = max((last - first) / step, 0)
    if not frames < _MOST_FRAMES:
        raise UserError(
            f"Action '{action.name}' goes from frame {first:g} to {last:g}, more than {_MOST_FRAMES:,} samples: "
            "delete the stray key, or untick it"
        )
    steps = math.floor(frames + _SAME_FRAME) if RATE in action else _steps_to_the_end(curves, first, last, frames, rate)
    if abs(frames - steps) > _SAME_FRAME and RATE not in action:
        rate, step = rate * steps / frames, (last - first) / max(steps, 1)
    return rate, first + step * np.arange(steps + 1)


def _steps_to_the_end(curves: Curves, first: float, last: float, frames: float, rate: float) -> int:
    """From a sample to the next, from the first frame to the last: from key to key where a channel has them evenly, as
    files for games do whatever the scene's frame rate is, for what is between two keys nobody has drawn. `frames` are
    how many of the scene it lasts, of which there are `rate` a second."""
    points = points_of(max(curves.values(), key=lambda curve: len(curve.keyframe_points)))[:, 0]
    even = np.abs(points - np.linspace(first, last, len(points))).max() < _SAME_FRAME
    gaps = len(points) - 1
    if not even or gaps == 0:
        return round(frames)
    if _KEYED[0] * frames <= gaps * rate <= _KEYED[1] * frames:
        return gaps
    keyed = gaps * max(round(frames / gaps), 1)
    return keyed if frames <= 2 * keyed <= 3 * frames else round(frames)


def sample_times(scene: bpy.types.Scene, obj: bpy.types.Object, action: bpy.types.Action) -> Doubles:
    """The scene frames of the samples that `sample` makes."""
    return frame_times(scene, action, _playing_curves(obj, action))[1]


def _checked_curves(obj: bpy.types.Object, action: bpy.types.Action) -> Curves:
    """What the Action plays on the armature; UserError where that is nothing."""
    if not any(name in obj.data.bones for name in animated_bones(action, obj)):
        raise UserError(f"Action '{action.name}' animates no bone of armature '{obj.name}': it belongs to another rig")
    curves = _playing_curves(obj, action)
    if not curves:
        raise UserError(f"Action '{action.name}': all of its channels are muted: unmute them, or untick it")
    return curves


def _playing_curves(obj: bpy.types.Object, action: bpy.types.Action) -> Curves:
    return {(c.data_path, c.array_index): c for c in versions.curves_of(action, obj) if not versions.is_muted(c)}


class _Sampled:
    """F-curves at the times: all at once where their keys are those times, as in what was captured."""

    def __init__(self, curves: Curves, times: Doubles) -> None:
        self.times = times
        self._curves = curves
        alike = [
            key for key, curve in curves.items() if len(curve.keyframe_points) == len(times) and not curve.modifiers
        ]
        points = points_of_alike([curves[key] for key in alike], len(times))
        on_times = np.abs(points[:, :, 0] - times).max(axis=1) < _SAME_FRAME
        self._read: dict[tuple[str, int], NDArray[np.float32]] = {
            key: values for key, on, values in zip(alike, on_times, points[:, :, 1]) if on
        }

    def has(self, path: str) -> bool:
        """Whether any curve is of this vector channel."""
        return any((path, index) in self._curves for index in range(4))

    def channel(self, path: str, rest: Sequence[float]) -> Doubles:
        """A vector channel [F, len(rest)]: at rest where there is no curve."""
        values = np.empty((len(self.times), len(rest)))
        for index, default in enumerate(rest):
            values[:, index] = self._values((path, index), default)
        return values

    def _values(self, key: tuple[str, int], default: float) -> Doubles | NDArray[np.float32] | float:
        if key in self._read:
            return self._read[key]
        curve = self._curves.get(key)
        return default if curve is None else _read_curve(curve, self.times)


def _read_curve(curve: bpy.types.FCurve, times: Doubles) -> Doubles | NDArray[np.float32]:
    """An F-curve's values at the times: its keys where some of them sit on these, else evaluated."""
    if len(curve.keyframe_points) > len(times) and not curve.modifiers:
        points = points_of(curve)
        first = int(np.searchsorted(points[:, 0], times[0] - _SAME_FRAME))
        near = points[first : first + len(times)]
        if len(near) == len(times) and np.abs(near[:, 0] - times).max() < _SAME_FRAME:
            return near[:, 1]
    return np.fromiter((curve.evaluate(time) for time in times), float, len(times))


def _sample_bones(obj: bpy.types.Object, sampled: _Sampled, longer: float) -> tuple[Doubles, Doubles]:
    """Locations [F,B,3], so many times as long as they are keyed, and quaternions [F,B,4] of all bones, in the
    armature's order."""
    bones, held, frames = obj.data.bones, held_of(obj), len(sampled.times)
    locations = np.zeros((frames, len(bones), 3))
    rotations = np.zeros((frames, len(bones), 4))
    for index, bone in enumerate(bones):
        mode = obj.pose.bones[bone.name].rotation_mode
        place: Sequence[float] = (0, 0, 0)
        channel, rest = _ROTATIONS.get(mode, _EULER)
        if bone.name in held:
            place, rest = held[bone.name][:3], tuple(from_quaternions(mode, np.array([held[bone.name][3:]]))[1][0])
        if not is_tied(bone):
            path = bone_path(bone.name, "location")
            locations[:, index] = sampled.channel(path, place) * (longer if sampled.has(path) else 1)
        rotations[:, index] = to_quaternions(mode, sampled.channel(bone_path(bone.name, channel), rest))
    return locations, rotations


def _sample_object(obj: bpy.types.Object, sampled: _Sampled) -> Doubles | None:
    """World matrices [F,4,4] of an object that its own F-curves move, else None."""
    if not any(sampled.has(channel) for channel in _OBJECT_CHANNELS):
        return None
    channel, _ = _ROTATIONS.get(obj.rotation_mode, _EULER)
    locations = sampled.channel("location", obj.location)
    scales = sampled.channel("scale", obj.scale)
    rotations = to_quaternions(obj.rotation_mode, sampled.channel(channel, getattr(obj, channel)))
    return np.array(
        [
            Matrix.LocRotScale(Vector(location), Quaternion(rotation).normalized(), Vector(scale))
            for location, rotation, scale in zip(locations, rotations, scales)
        ]
    )
