# SPDX-License-Identifier: GPL-3.0-or-later
"""Takes: joystick sessions kept in the .blend with the armature object that they drove, as `obj.fragmotion.takes`.

A take holds all that its replay needs: the trace, the seed, the policy and where the character stood. It may also hold
what was shown while it was recorded, which a bake then writes as it was seen.
"""

from __future__ import annotations

import zlib
from datetime import datetime
from typing import TYPE_CHECKING, Any

import bpy
import numpy as np
from bpy.props import BoolProperty, FloatProperty, FloatVectorProperty, IntProperty, StringProperty

from ..errors import UserError
from ..rig.motion import Motion

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from fragmotion_core import Doubles

TRACE_RATE = 10
"""Controls a second of a trace."""

_COLUMNS = 4
_NUMBER, _SMALL = "<f8", "<f4"
_LONGEST = 24 * 3600 * TRACE_RATE  # controls; what claims to be longer than a day is damaged
_MOST_BYTES = 1 << 28  # of what was shown: over an hour of 60 poses a second on 70 bones
_MOST_CLASSES = 1 << 16
_SAME_TIME = 1e-4  # s
_FARTHEST = 1e9  # m, and rad: where the core's player still stands
_FIELDS = ("name", "date", "seconds", "quality", "policy", "seed", "start", "train", "controls", "shown", "shown_bones")
_BESIDE_BONES = 1 + 3 + 3 + 1  # columns of what was shown: time, root position, character frame, class


class Take(bpy.types.PropertyGroup):
    """A joystick session, by its `name`: what the user did and how the character that followed was set up."""

    date: StringProperty(  # type: ignore[valid-type]
        name="Date", description="When the take was recorded or imported: year-month-day hour:minute"
    )
    seconds: FloatProperty(  # type: ignore[valid-type]
        name="Length", description="Length of the take in seconds", min=0, unit="TIME_ABSOLUTE"
    )
    quality: FloatProperty(  # type: ignore[valid-type]
        name="Quality",
        description="How smoothly and exactly the character followed, from 0 to 1 (Eq. 2); 0 before it was measured",
        min=0,
        max=1,
    )
    policy: StringProperty(  # type: ignore[valid-type]
        name="Policy", description="The policy that drove while it was recorded; empty where none did"
    )
    seed: IntProperty(  # type: ignore[valid-type]
        name="Seed",
        description="Draws which fragment of a class plays: the same seed, the same motion",
        default=1,
        min=0,
    )
    start: FloatVectorProperty(  # type: ignore[valid-type]
        name="Start",
        description="Where the character stood: x and y (m), and its heading (radians, counter-clockwise from +Y)",
        size=3,
    )
    train: BoolProperty(  # type: ignore[valid-type]
        name="Train on It", description="Build learns from the ticked takes where its trace is Takes", default=False
    )
    controls: StringProperty(subtype="BYTE_STRING", options={"HIDDEN"})  # type: ignore[valid-type]
    shown: StringProperty(subtype="BYTE_STRING", options={"HIDDEN"})  # type: ignore[valid-type]
    shown_bones: IntProperty(min=0, options={"HIDDEN"})  # type: ignore[valid-type]


def add_take(
    obj: bpy.types.Object,
    trace: Doubles,
    *,
    name: str | None = None,
    seed: int = 1,
    policy: str = "",
    start: Sequence[float] = (0.0, 0.0, 0.0),
    quality: float = 0.0,
    shown: tuple[Doubles, Motion] | None = None,
) -> Take:
    """Keep a trace [T,4] (10 controls a second, in the character frame) with the armature, and select it in the list.

    The name (default "Take") gets a number where another take has it. `start` is the character frame, as Player.frame:
    x, y in metres and the heading in radians. `shown` are the poses that the user saw, where there were any, and their
    times [F] in seconds from the first control on. UserError on what is no trace; the file is changed only afterwards.
    """
    data = _packed(trace)
    settings = obj.fragmotion
    name = unique_name(name or "Take", [take.name for take in settings.takes])
    take: Take = settings.takes.add()
    take.name, take.seed, take.policy, take.start, take.quality = name, seed, policy, start, quality
    take.date = datetime.now().strftime("%Y-%m-%d %H:%M")
    _store(take, data, len(trace))
    if shown is not None:
        set_shown(take, *shown)
    settings.active_take = len(settings.takes) - 1
    return take


def trace_of(take: Take) -> Doubles:
    """The take's trace [T,4], to the bit as it was given; UserError where the .blend is damaged."""
    trace: Doubles = _unpacked(take, take.controls, _NUMBER, _COLUMNS, _LONGEST * _COLUMNS * 8)
    if not _is_trace(trace) or not (np.abs(take.start) <= _FARTHEST).all():
        raise _damaged(take)
    return trace


def shown_of(take: Take) -> tuple[Doubles, Motion] | None:
    """The times [F] and poses that were shown while it was recorded, if kept; UserError where the .blend is damaged."""
    if not take.shown:
        return None
    if take.shown_bones < 1:
        raise _damaged(take)
    rows = _unpacked(take, take.shown, _SMALL, _BESIDE_BONES + 4 * take.shown_bones, _MOST_BYTES)
    times, roots, frames, classes = rows[:, 0], rows[:, 1:4], rows[:, 4:7], rows[:, 7]
    rotations = rows[:, _BESIDE_BONES:].reshape(len(rows), -1, 4)
    if not _is_in_time(times) or not ((classes >= 0) & (classes < _MOST_CLASSES)).all() or not rotations.any(-1).all():
        raise _damaged(take)
    return times, Motion(roots, rotations, frames, classes.astype(np.int32))


def set_shown(take: Take, times: Doubles, motion: Motion) -> None:
    """Keep the poses that were shown at times [F] (s, ascending) while the take was recorded, if it lasts an hour or so
    at most; a longer one is played anew."""
    rotations = np.asarray(motion.rotations)
    columns = (times, motion.root_positions, motion.frames, motion.classes, rotations.reshape(len(rotations), -1))
    data = np.column_stack(columns).astype(_SMALL).tobytes()
    take.shown = zlib.compress(data) if len(data) <= _MOST_BYTES else b""
    take.shown_bones = rotations.shape[1]


def set_trace(take: Take, trace: Doubles) -> None:
    """Replace the take's trace; UserError on what is no trace."""
    _store(take, _packed(trace), len(trace))


def duplicate_take(obj: bpy.types.Object, index: int) -> Take:
    """A copy of a take after it in the list, selected."""
    takes = obj.fragmotion.takes
    copy = takes.add()
    for key in _FIELDS:
        setattr(copy, key, getattr(takes[index], key))
    copy.name = unique_name(copy.name, [take.name for take in takes[:-1]])
    takes.move(len(takes) - 1, index + 1)
    obj.fragmotion.active_take = index + 1
    moved: Take = takes[index + 1]
    return moved


def remove_take(obj: bpy.types.Object, index: int) -> None:
    """Delete a take, and select the one that comes into its place, or the last."""
    settings = obj.fragmotion
    settings.takes.remove(index)
    settings.active_take = max(min(index, len(settings.takes) - 1), 0)


def trim_take(take: Take, start: float, end: float) -> None:
    """Keep the seconds from `start` to `end`, to the nearest control; UserError where nothing is left.

    A motion that was shown is cut likewise. Its quality was another stretch's: it is unknown then.
    """
    trace = trace_of(take)
    first, last = round(max(start, 0) * TRACE_RATE), min(round(end * TRACE_RATE), len(trace))
    if first >= last:
        raise UserError(
            f"Take '{take.name}' lasts {take.seconds:.1f} s: nothing is left between {start:.1f} s and {end:.1f} s"
        )
    shown = shown_of(take)
    _store(take, _packed(trace[first:last]), last - first)
    take.quality = 0
    if shown is not None:
        _trim_shown(take, *shown, first / TRACE_RATE, last / TRACE_RATE)


def trained_on(obj: bpy.types.Object) -> list[Take]:
    """The armature's takes that are ticked to be learned from, in the list's order."""
    return [take for take in obj.fragmotion.takes if take.train]


def active_take(obj: bpy.types.Object) -> Take | None:
    """The take that is selected in the list, if any."""
    takes, index = obj.fragmotion.takes, obj.fragmotion.active_take
    return takes[index] if 0 <= index < len(takes) else None


def unique_name(name: str, others: Iterable[str]) -> str:
    """The name, with the first free number as Blender counts (".001") where another has it."""
    taken, number, unique = set(others), 0, name
    while unique in taken:
        number += 1
        unique = f"{name}.{number:03}"
    return unique


def _trim_shown(take: Take, times: Doubles, motion: Motion, start: float, end: float) -> None:
    """Keep what was shown from `start` to `end` (s), where there is anything, and begin the take there."""
    inside = (times >= start - _SAME_TIME) & (times <= end + _SAME_TIME)
    if not inside.any():
        take.shown = b""
        return
    roots, rotations, frames, classes = motion
    kept = Motion(roots[inside], rotations[inside], frames[inside], classes[inside])
    set_shown(take, np.maximum(times[inside] - start, 0), kept)
    take.start = motion.frames[inside][0]


def _store(take: Any, data: bytes, length: int) -> None:
    take.controls, take.seconds = data, length / TRACE_RATE


def _packed(trace: Doubles) -> bytes:
    """The trace as compressed little-endian numbers with a checksum; UserError on what is no trace."""
    values = np.asarray(trace, float)
    if values.ndim != 2 or values.shape[1] != _COLUMNS or not 0 < len(values) <= _LONGEST:
        raise UserError("A take needs between one control and a day of them, of four numbers each")
    if not _is_trace(values):
        raise UserError("A take's controls must be finite, its turn within -1 and 1, and its jump within 0 and 1")
    return zlib.compress(values.astype(_NUMBER).tobytes())


def _unpacked(take: Take, packed: bytes, kind: str, columns: int, most: int) -> Doubles:
    """Rows of finite numbers of a kind, one at least and at most so many bytes; UserError where they are not there."""
    try:
        unpacker = zlib.decompressobj()
        data = unpacker.decompress(packed, most)
        if not unpacker.eof or not data:
            raise ValueError
        rows: Doubles = np.frombuffer(data, kind).reshape(-1, columns).astype(float)
        if not np.isfinite(rows).all():
            raise ValueError
    except (zlib.error, ValueError):
        raise _damaged(take) from None
    return rows


def _damaged(take: Take) -> UserError:
    return UserError(f"Take '{take.name}' is damaged: delete it, and record or import it again")


def _is_trace(values: Doubles) -> bool:
    """Whether rows of four numbers can be a trace."""
    turn, jump = values[:, 2], values[:, 3]
    return bool(np.isfinite(values).all() and (np.abs(turn) <= 1).all() and ((jump >= 0) & (jump <= 1)).all())


def _is_in_time(times: Doubles) -> bool:
    """Whether poses can have been shown then: in order, and more often than there are controls."""
    return bool(times[0] >= 0 and (np.diff(times) >= 0).all() and times[-1] * TRACE_RATE <= len(times))
