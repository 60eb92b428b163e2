# SPDX-License-Identifier: GPL-3.0-or-later
"""Recordings: joystick sessions kept in the .blend with the armature object that they drove.

A recording holds all that its replay needs: the trace, the seed, the policy and where the character stood. It may also
hold what was shown meanwhile, which a bake then writes as it was seen.
"""

from __future__ import annotations

import zlib
from datetime import datetime
from typing import TYPE_CHECKING, Any

import bpy
import numpy as np
from bpy.props import BoolProperty, FloatProperty, FloatVectorProperty, IntProperty, PointerProperty, StringProperty

from ..errors import UserError
from ..rig.motion import Motion
from .asked import Asked, StartedMove, number_moves
from .looks import LookChange, looks_between, read_looks
from .reaches import ReachChange, reaches_between, read_reaches
from .rows import read_rows, write_rows
from .styles import StyleChange, Styled, numbered, read_changes, set_styles, trimmed

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from fragmotion_core import Doubles
    from numpy.typing import NDArray

TRACE_RATE = 10
"""Controls a second of a trace."""

POSE_RATE = 60
"""Poses a second that a drive shows; a recording keeps no more of them."""

NEXT = "Replay or Bake it"
"""What to do with one that was made."""

_COLUMNS = 4
_MOST_TURN = 6.0  # turn rates, as in the core's trace files
_NUMBER, _SMALL = "<f8", "<f4"
_LONGEST = 24 * 3600 * TRACE_RATE  # controls; what claims to be longer than a day is damaged
_MOST_BYTES = 1 << 28  # of what was shown: over an hour of POSE_RATE on 70 bones
_MOST_CLASSES = 1 << 16
_SAME_TIME = 1e-4  # s
_CHECKSUM = 4  # bytes at the end of what zlib compressed, which tell all that is in it
_FARTHEST = 1e9  # m, and rad: where the core's player still stands
_FIELDS = (
    *("name", "date", "seconds", "quality", "policy", "seed", "start", "train"),
    *("controls", "moves", "style", "styles", "looks", "reaches", "shown", "shown_bones"),
)

_BESIDE_BONES = 1 + 3 + 3 + 1  # columns of what was shown: time, root position, character frame, class


class Recording(bpy.types.PropertyGroup):
    """A joystick session, by its `name`: what the user did and how the character that followed was set up."""

    date: StringProperty(  # type: ignore[valid-type]
        name="Date", description="When it was recorded or imported: year-month-day hour:minute"
    )
    seconds: FloatProperty(  # type: ignore[valid-type]
        name="Length", description="Length of the recording in seconds", min=0, unit="TIME_ABSOLUTE"
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
        name="Train on It",
        description="Build learns from the ticked recordings where its trace is Recordings",
        default=False,
    )
    curves: PointerProperty(  # type: ignore[valid-type]
        name="Curves", description="The empty whose curves show the recording", type=bpy.types.Object
    )
    curves_number: IntProperty(options={"HIDDEN"}, min=0)  # type: ignore[valid-type]
    """By which the curves that were made for it are told from all others; 0: none were."""
    curves_first: FloatProperty(options={"HIDDEN"})  # type: ignore[valid-type]
    """The scene frame at which its first control is shown."""
    curves_rate: FloatProperty(options={"HIDDEN"}, min=0)  # type: ignore[valid-type]
    """Scene frames a second of the curves."""
    of_story: BoolProperty(options={"HIDDEN"})  # type: ignore[valid-type]
    """Whether it was made of the storyboard, whose next recording takes its place."""
    baked: PointerProperty(  # type: ignore[valid-type]
        name="Action", description="The Action to which the recording was baked last", type=bpy.types.Action
    )
    baked_digest: StringProperty(options={"HIDDEN"})  # type: ignore[valid-type]
    """Of what was baked: another one where the recording was changed since."""
    controls: StringProperty(subtype="BYTE_STRING", options={"HIDDEN"})  # type: ignore[valid-type]
    moves: StringProperty(options={"HIDDEN"})  # type: ignore[valid-type]
    """JSON of the moves that were started: [control, name, controls for which it was held] each; empty: none."""
    style: StringProperty(  # type: ignore[valid-type]
        name="Style", description="The style in which it begins; empty: the character's first"
    )
    styles: StringProperty(options={"HIDDEN"})  # type: ignore[valid-type]
    """JSON of the styles to which it changes: [control, name] each; empty: none."""
    looks: StringProperty(options={"HIDDEN"})  # type: ignore[valid-type]
    """JSON of where it is asked to look: [control, look, x, y, z] each; empty: as captured."""
    reaches: StringProperty(options={"HIDDEN"})  # type: ignore[valid-type]
    """JSON of what hands reach for: [control, hand, weight, carried, x, y, z] each; empty: nothing."""
    shown: StringProperty(subtype="BYTE_STRING", options={"HIDDEN"})  # type: ignore[valid-type]
    shown_bones: IntProperty(min=0, options={"HIDDEN"})  # type: ignore[valid-type]


def add_recording(
    obj: bpy.types.Object,
    trace: Doubles,
    *,
    name: str | None = None,
    seed: int = 1,
    policy: str = "",
    start: Sequence[float] = (0.0, 0.0, 0.0),
    quality: float = 0.0,
    shown: tuple[Doubles, Motion] | None = None,
    moves: Sequence[StartedMove] = (),
    style: str = "",
    styles: Sequence[StyleChange] = (),
    looks: Sequence[LookChange] = (),
    reaches: Sequence[ReachChange] = (),
) -> Recording:
    """Keep a trace [T,4] (10 controls a second, in the character frame) with the armature, and select it in the list.

    The name (default "Recording") gets a number where another one has it. `start` is the character frame, as
    Player.frame: x, y in metres and the heading in radians. `shown` are the poses that the user saw, where there
    were any, and their times [F] in seconds from the first control on. `moves` are those that were started; `style` is
    the one in which it begins, `styles` are those to which it changes, `looks` where it is asked to look, `reaches`
    what hands reach for. UserError on what is no trace; the file is changed only afterwards.
    """
    data = _packed(trace)
    settings = obj.fragmotion
    name = unique_name(name or "Recording", [recording.name for recording in settings.recordings])
    recording: Recording = settings.recordings.add()
    recording.name, recording.seed, recording.policy = name, seed, policy
    recording.start, recording.quality = start, quality
    recording.date = datetime.now().strftime("%Y-%m-%d %H:%M")
    _store(recording, data, len(trace))
    set_asked(recording, Asked(moves, style, styles, looks, reaches))
    if shown is not None:
        set_shown(recording, *shown)
    settings.active_recording = len(settings.recordings) - 1
    return recording


def trace_of(recording: Recording) -> Doubles:
    """The recording's trace [T,4], to the bit as it was given; UserError where the .blend is damaged."""
    trace = _unpacked(recording, recording.controls, _NUMBER, _COLUMNS, _LONGEST)
    if not _is_trace(trace) or not (np.abs(recording.start) <= _FARTHEST).all():
        raise _damaged(recording)
    return trace.astype(float)


def moves_of(recording: Recording) -> list[StartedMove]:
    """The moves that were started, in order; UserError where the .blend is damaged."""
    if not recording.moves:
        return []
    most = len(trace_of(recording))
    moves = read_rows(recording.moves, StartedMove, lambda move: _is_started(move, most))
    if moves is None:
        raise _damaged(recording)
    return moves


def numbered_moves(recording: Recording, names: Sequence[str]) -> list[list[int]]:
    """The moves that were started as Player.run has them [M,3], numbered as in `names`; UserError where one is not
    there."""
    return number_moves(moves_of(recording), names, lambda _: f"Recording '{recording.name}'")


def styles_of(recording: Recording) -> list[StyleChange]:
    """The styles to which it changes, in order; UserError where the .blend is damaged."""
    changes = read_changes(recording.styles, len(trace_of(recording)))
    if changes is None:
        raise _damaged(recording)
    return changes


def numbered_styles(recording: Recording, names: Sequence[str]) -> Styled:
    """The recording's styles, numbered as in `names`; UserError where the .blend is damaged."""
    return numbered(recording.style, styles_of(recording), names)


def looks_of(recording: Recording) -> list[LookChange]:
    """Where it is asked to look, in order; UserError where the .blend is damaged."""
    looks = read_looks(recording.looks, len(trace_of(recording)))
    if looks is None:
        raise _damaged(recording)
    return looks


def reaches_of(recording: Recording) -> list[ReachChange]:
    """What its hands reach for, in order; UserError where the .blend is damaged."""
    reaches = read_reaches(recording.reaches, len(trace_of(recording)))
    if reaches is None:
        raise _damaged(recording)
    return reaches


def asked_of(recording: Recording) -> Asked:
    """What it asks for beside its trace; UserError where the .blend is damaged."""
    return Asked(moves_of(recording), recording.style, styles_of(recording), looks_of(recording), reaches_of(recording))


def asked_between(recording: Recording, first: int, last: int) -> Asked:
    """What is asked for before its controls `first` .. `last` - 1, seen from the first of them; UserError where the
    .blend is damaged."""
    moves = [
        move._replace(control=move.control - first) for move in moves_of(recording) if first <= move.control < last
    ]
    looks = looks_between(looks_of(recording), first, last)
    reaches = reaches_between(reaches_of(recording), first, last)
    return Asked(moves, *trimmed(recording.style, styles_of(recording), first, last), looks, reaches)


def set_asked(recording: Recording, asked: Asked) -> None:
    """Replace what the recording asks for beside its trace."""
    _set_moves(recording, asked.moves)
    set_styles(recording, asked.style, asked.styles)
    recording.looks = write_rows(asked.looks)
    recording.reaches = write_rows(asked.reaches)


def shown_of(recording: Recording) -> tuple[Doubles, Motion] | None:
    """The times [F] and poses that were shown while it was recorded, if kept; UserError where the .blend is damaged."""
    if not recording.shown:
        return None
    if recording.shown_bones < 1:
        raise _damaged(recording)
    most = len(trace_of(recording)) * POSE_RATE // TRACE_RATE + 1  # the pose before the first control, too
    rows = _unpacked(recording, recording.shown, _SMALL, _BESIDE_BONES + 4 * recording.shown_bones, most)
    times, roots, frames, classes = rows[:, 0], rows[:, 1:4], rows[:, 4:7], rows[:, 7]
    rotations = rows[:, _BESIDE_BONES:].reshape(len(rows), -1, 4)
    if not _is_in_time(times) or not ((classes >= 0) & (classes < _MOST_CLASSES)).all() or not rotations.any(-1).all():
        raise _damaged(recording)
    motion = Motion(roots.astype(float), rotations.astype(float), frames.astype(float), classes.astype(np.int32))
    return times.astype(float), motion


def set_shown(recording: Recording, times: Doubles, motion: Motion) -> None:
    """Keep the poses that were shown at times [F] (s, ascending) meanwhile, if it lasts an hour or so at most; a
    longer recording is played anew."""
    rotations = np.asarray(motion.rotations)
    columns = (times, motion.root_positions, motion.path, motion.classes, rotations.reshape(len(rotations), -1))
    data = np.column_stack(columns).astype(_SMALL).tobytes()
    recording.shown = zlib.compress(data) if len(data) <= _MOST_BYTES else b""
    recording.shown_bones = rotations.shape[1]


def set_trace(recording: Recording, trace: Doubles) -> None:
    """Replace the recording's trace; UserError on what is no trace."""
    _store(recording, _packed(trace), len(trace))


def digest_of(recording: Recording) -> str:
    """By which a recording is known that was changed; quick enough for drawing."""
    number = zlib.crc32(recording.controls)
    number = zlib.crc32(recording.shown[-_CHECKSUM:], number)
    told = (
        recording.moves,
        recording.style,
        recording.styles,
        recording.looks,
        recording.reaches,
        recording.policy,
        recording.seed,
        *recording.start,
    )
    return f"{zlib.crc32(repr(told).encode(), number):08x}"


def tell_baked(recording: Recording, action: bpy.types.Action, digest: str) -> None:
    """Note to which Action the recording was baked, as it was then."""
    recording.baked, recording.baked_digest = action, digest


def is_bake_stale(recording: Recording) -> bool:
    """Whether the recording was changed since it was baked."""
    return recording.baked is not None and recording.baked_digest != digest_of(recording)


def duplicate_recording(obj: bpy.types.Object, index: int) -> Recording:
    """A copy of a recording after it in the list, selected."""
    recordings = obj.fragmotion.recordings
    copy = recordings.add()
    for key in _FIELDS:
        setattr(copy, key, getattr(recordings[index], key))
    copy.name = unique_name(copy.name, [recording.name for recording in recordings[:-1]])
    recordings.move(len(recordings) - 1, index + 1)
    obj.fragmotion.active_recording = index + 1
    moved: Recording = recordings[index + 1]
    return moved


def remove_recording(obj: bpy.types.Object, index: int) -> None:
    """Delete a recording, and select the one that comes into its place, or the last."""
    settings = obj.fragmotion
    settings.recordings.remove(index)
    settings.active_recording = max(min(index, len(settings.recordings) - 1), 0)


def trim_recording(recording: Recording, start: float, end: float) -> None:
    """Keep the seconds from `start` to `end`, to the nearest control; UserError where nothing is left.

    A motion that was shown is cut likewise. Its quality was another stretch's: it is unknown then.
    """
    trace = trace_of(recording)
    first, last = round(max(start, 0) * TRACE_RATE), min(round(end * TRACE_RATE), len(trace))
    if first >= last:
        raise UserError(
            f"Recording '{recording.name}' lasts {recording.seconds:.1f} s: nothing is left between {start:.1f} s and "
            f"{end:.1f} s"
        )
    shown, asked = shown_of(recording), asked_between(recording, first, last)
    _store(recording, _packed(trace[first:last]), last - first)
    set_asked(recording, asked)
    recording.quality = 0
    if shown is not None:
        _trim_shown(recording, *shown, first / TRACE_RATE, last / TRACE_RATE)


def trained_on(obj: bpy.types.Object) -> list[Recording]:
    """The armature's recordings that are ticked to be learned from, in the list's order."""
    return [recording for recording in obj.fragmotion.recordings if recording.train]


def active_recording(obj: bpy.types.Object) -> Recording | None:
    """The recording that is selected in the list, if any."""
    recordings, index = obj.fragmotion.recordings, obj.fragmotion.active_recording
    return recordings[index] if 0 <= index < len(recordings) else None


def baked_source(obj: bpy.types.Object, settings: Any) -> str:
    """What Bake's panel bakes by BakeSettings: while no recording is there to be selected, a simulated player."""
    source: str = settings.trace_source
    return "PLAYER" if source == "RECORDING" and active_recording(obj) is None else source


def unique_name(name: str, others: Iterable[str]) -> str:
    """The name, with the first free number as Blender counts (".001") where another has it."""
    taken, number, unique = set(others), 0, name
    while unique in taken:
        number += 1
        unique = f"{name}.{number:03}"
    return unique


def _trim_shown(recording: Recording, times: Doubles, motion: Motion, start: float, end: float) -> None:
    """Keep what was shown from `start` to `end` (s), where there is anything, and begin the recording there."""
    inside = (times >= start - _SAME_TIME) & (times <= end + _SAME_TIME)
    if not inside.any():
        recording.shown = b""
        return
    roots, rotations, frames, classes = motion
    kept = Motion(roots[inside], rotations[inside], frames[inside], classes[inside])
    set_shown(recording, np.maximum(times[inside] - start, 0), kept)
    recording.start = motion.path[inside][0]


def _set_moves(recording: Any, moves: Sequence[StartedMove]) -> None:
    recording.moves = write_rows(moves)


def _is_started(move: StartedMove, controls: int) -> bool:
    """Whether what a .blend says can be a move that was started in so many controls."""
    numbers = all(type(number) is int for number in (move.control, move.held))
    return numbers and isinstance(move.name, str) and 0 <= move.control < controls and 0 <= move.held <= _LONGEST


def _store(recording: Any, data: bytes, length: int) -> None:
    recording.controls, recording.seconds = data, length / TRACE_RATE


def _packed(trace: Doubles) -> bytes:
    """The trace as compressed little-endian numbers with a checksum; UserError on what is no trace."""
    values = np.asarray(trace, float)
    if values.ndim != 2 or values.shape[1] != _COLUMNS or not 0 < len(values) <= _LONGEST:
        raise UserError("A recording needs between one control and a day of them, of four numbers each")
    if not _is_trace(values):
        raise UserError("A recording's controls must be finite, its turn within -6 and 6, and its jump within 0 and 1")
    return zlib.compress(values.astype(_NUMBER).tobytes())


def _unpacked(recording: Recording, packed: bytes, kind: str, columns: int, most: int) -> NDArray[Any]:
    """Rows of finite numbers of a kind, one at least and at most so many; UserError where they are not there.

    A few bytes may claim to be a thousand times as many: no more is unpacked, or copied, than may be there.
    """
    try:
        unpacker = zlib.decompressobj()
        data = unpacker.decompress(packed, min(most * columns * np.dtype(kind).itemsize, _MOST_BYTES))
        if not unpacker.eof or not data:
            raise ValueError
        rows = np.frombuffer(data, kind).reshape(-1, columns)
        if not np.isfinite(rows).all():
            raise ValueError
    except (zlib.error, ValueError):
        raise _damaged(recording) from None
    return rows


def _damaged(recording: Recording) -> UserError:
    return UserError(f"Recording '{recording.name}' is damaged: delete it, and record or import it again")


def _is_trace(values: NDArray[Any]) -> bool:
    """Whether rows of four numbers can be a trace."""
    turn, jump = values[:, 2], values[:, 3]
    return bool(np.isfinite(values).all() and (np.abs(turn) <= _MOST_TURN).all() and ((jump >= 0) & (jump <= 1)).all())


def _is_in_time(times: NDArray[Any]) -> bool:
    """Whether poses can have been shown then: in order, and more often than there are controls."""
    return bool(times[0] >= 0 and (np.diff(times) >= 0).all() and times[-1] * TRACE_RATE <= len(times))
