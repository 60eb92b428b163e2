# SPDX-License-Identifier: GPL-3.0-or-later
"""A recording's controls as F-curves: custom properties of an empty below the armature, with an Action of its own."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import bpy
import numpy as np

from ..compat import versions
from ..compat.data_blocks import is_alive
from ..errors import UserError
from ..made import is_made, mark, remove_object
from .recordings import TRACE_RATE, Recording, trace_of

if TYPE_CHECKING:
    from fragmotion_core import Doubles

CHANNELS = ("velocity_right", "velocity_forward", "turn", "jump")
"""The custom properties, in the order of a trace's columns."""

_TURN, _JUMP = 2, 3
_DESCRIPTIONS = (
    "Velocity to the character's right, in metres a second",
    "Velocity forward, in metres a second",
    "Turn: 1 is left, -1 is right; more to face about",
    "Jump: a jump begins where it goes over a half",
)
_MOST = (100.0, 100.0, 6.0, 1.0)  # that a curve may ask for
_GROUP = "Recording"
_LINEAR, _CONSTANT = 1, 0  # RNA's numbers of these interpolations
_SAME = 1e-5  # of a number: F-curves hold less digits than a trace
_LOOKS = 6  # at the jump within a control: one may be pressed for a moment
_OUTSIDE = 0.5  # frames


class Drawn(NamedTuple):
    """What curves say: a trace [T,4], its first control that differs from the recording's (T where none does), and
    what was done otherwise than the curves say, in words."""

    trace: Doubles
    first: int
    remarks: list[str]


def curves_of(obj: bpy.types.Object, recording: Recording) -> bpy.types.Object | None:
    """The empty that shows the armature's recording, if there is one in a scene."""
    empty = recording.curves
    if empty is None or not is_alive(empty) or empty.type != "EMPTY":
        return None
    if empty.parent != obj or not empty.users_scene:
        return None
    return empty if versions.assignment(empty)[0] is not None else None


def show_curves(scene: bpy.types.Scene, obj: bpy.types.Object, recording: Recording, first: float) -> bpy.types.Object:
    """Make the empty and its curves, whose first key is on scene frame `first`; what another one holds is lost."""
    trace = trace_of(recording)
    remove_curves(obj, recording)
    number = 1 + max(each.curves_number for each in obj.fragmotion.recordings)
    name = f"{recording.name} Curves"
    empty = bpy.data.objects.new(name, None)
    empty.parent, empty.empty_display_type, empty.empty_display_size = obj, "SINGLE_ARROW", 0.3
    empty.hide_render = True
    (obj.users_collection[0] if obj.users_collection else scene.collection).objects.link(empty)
    action = bpy.data.actions.new(name)
    for made in (empty, action):
        mark(made, number)
    recording.curves, recording.curves_number, recording.curves_first = empty, number, first
    recording.curves_rate = scene.render.fps / scene.render.fps_base
    _write(action, empty, trace, _times(recording, len(trace)))
    versions.assign(empty, action)
    return empty


def renew_curves(obj: bpy.types.Object, recording: Recording) -> None:
    """Let the curves, where there are any, show what the recording has become; those that were not made for it, or that
    something else plays as well, stay as they are and are its curves no more."""
    empty = curves_of(obj, recording)
    if empty is None:
        return
    trace, (action, _) = trace_of(recording), versions.assignment(empty)
    if _is_own(obj, recording, empty) and _is_alone(action, recording):
        _write(action, empty, trace, _times(recording, len(trace)))
    else:
        recording.curves = None


def remove_curves(obj: bpy.types.Object, recording: Recording) -> None:
    """Delete the empty that was made for the armature's recording, and its Action where nothing else uses that."""
    empty = recording.curves
    recording.curves = None
    if _is_own(obj, recording, empty):
        remove_object(empty)


def read_curves(obj: bpy.types.Object, recording: Recording) -> Drawn:
    """The controls that the curves say, 10 a second; to the bit the recording's own where the curves are still there.

    UserError where there are no curves or they say what is not a number.
    """
    empty = curves_of(obj, recording)
    if empty is None:
        raise UserError(f"Recording '{recording.name}' has no curves: press Edit Curves first")
    own = trace_of(recording)
    drawn, remarks = own.copy(), []
    curves = {curve.data_path: curve for curve in versions.curves_of(versions.assignment(empty)[0], empty)}
    times = _times(recording, len(own))
    for channel, name in enumerate(CHANNELS):
        curve = curves.get(_path(name))
        if curve is None:
            drawn[:, channel] = 0
            remarks.append(f"there is no curve '{name}': it is 0")
        elif versions.is_muted(curve):
            remarks.append(f"curve '{name}' is muted: it stays as recorded")
        else:
            drawn[:, channel] = _sample(curve, channel, own[:, channel], times, recording.curves_rate)
            remarks += _check(curve, name, drawn[:, channel], times, _MOST[channel])
    drawn = np.clip(drawn, np.negative(_MOST), _MOST)
    changed = np.flatnonzero((drawn != own).any(1))
    return Drawn(drawn, int(changed[0]) if len(changed) else len(own), remarks)


def _is_own(obj: bpy.types.Object, recording: Recording, empty: Any) -> bool:
    """Whether an object is the empty that was made for this very recording, and not for one that it is a copy of."""
    return is_made(empty, recording.curves_number) and empty.type == "EMPTY" and empty.parent == obj


def _is_alone(action: Any, recording: Recording) -> bool:
    """Whether an Action was made for the recording, and only its own empty plays it."""
    return is_made(action, recording.curves_number) and action.users - action.use_fake_user == 1


def _sample(curve: bpy.types.FCurve, channel: int, own: Doubles, times: Doubles, rate: float) -> Doubles:
    """A channel's controls: the recording's own where the curve is within rounding of them."""
    if channel == _JUMP:
        looks = np.arange(_LOOKS) * rate / TRACE_RATE / _LOOKS
        jumps = np.array([max(curve.evaluate(time + look) for look in looks) for time in times])
        seen = np.where(np.isnan(jumps), jumps, jumps > 0.5)
        return np.where(seen == (own > 0.5), own, seen)
    values = np.array([curve.evaluate(time) for time in times])
    return np.where(np.abs(values - own) <= _SAME * np.maximum(1, np.abs(own)), own, values)


def _check(curve: bpy.types.FCurve, name: str, values: Doubles, times: Doubles, most: float) -> list[str]:
    """What is to be said of a curve; UserError where it is not a number."""
    wrong = np.flatnonzero(~np.isfinite(values))
    if len(wrong):
        raise UserError(
            f"Curve '{name}' is not a number at frame {times[wrong[0]]:.0f}: delete or mend the keys there, then press "
            "Play Again; the recording has not changed"
        )
    remarks = []
    outside = [
        key
        for key in curve.keyframe_points
        if not times[0] - _OUTSIDE <= key.co.x <= times[-1] + (times[-1] - times[0]) / max(len(times) - 1, 1) + _OUTSIDE
    ]
    if outside:
        remarks.append(
            f"{len(outside)} keys of '{name}' are outside the recording, frames {times[0]:.0f} to {times[-1]:.0f}, and "
            "count only for the way to them"
        )
    if (np.abs(values) > most).any():
        remarks.append(f"'{name}' is held within {most:g}")
    return remarks


def _times(recording: Recording, length: int) -> Doubles:
    """The scene frames [T] at which the controls begin."""
    times: Doubles = recording.curves_first + np.arange(length) * (recording.curves_rate / TRACE_RATE)
    return times


def _path(name: str) -> str:
    return f'["{name}"]'


def _write(action: bpy.types.Action, empty: bpy.types.Object, trace: Doubles, times: Doubles) -> None:
    """Key the trace: only where a value begins or ends to be the same."""
    holder = versions.holder_for(action, empty)
    holder.fcurves.clear()
    for channel, name in enumerate(CHANNELS):
        empty[name] = 0.0
        most = _MOST[channel]
        empty.id_properties_ui(name).update(description=_DESCRIPTIONS[channel], min=-most, max=most)
        curve = versions.new_curve(holder, _path(name), 0, _GROUP)
        curve.group.show_expanded = curve.group.show_expanded_graph = True
        kept = _ends_of_runs(trace[:, channel])
        keys = curve.keyframe_points
        keys.add(len(kept))
        keys.foreach_set("co", np.column_stack((times[kept], trace[kept, channel])).astype(np.float32).ravel())
        kind = _CONSTANT if channel == _JUMP else _LINEAR
        keys.foreach_set("interpolation", np.full(len(kept), kind, np.int32))
        curve.update()


def _ends_of_runs(values: Doubles) -> Any:
    """Indices of the values that the one before or the one after differs from."""
    differs = values[1:] != values[:-1]
    return np.flatnonzero(np.concatenate(([True], differs)) | np.concatenate((differs, [True])))
