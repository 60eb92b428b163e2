# SPDX-License-Identifier: GPL-3.0-or-later
"""Takes: joystick sessions kept in the .blend with the armature object that they drove, as `obj.fragmotion.takes`.

A take holds all that its replay needs: the trace, the seed, the policy and where the character stood.
"""

from __future__ import annotations

import zlib
from datetime import datetime
from typing import TYPE_CHECKING, Any

import bpy
import numpy as np
from bpy.props import BoolProperty, FloatProperty, FloatVectorProperty, IntProperty, StringProperty

from .errors import UserError

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from fragmotion_core import Doubles

TRACE_RATE = 10
"""Controls a second of a trace."""

_COLUMNS = 4
_NUMBER = "<f8"
_LONGEST = 24 * 3600 * TRACE_RATE  # controls; what claims to be longer than a day is damaged


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


def add_take(
    obj: bpy.types.Object,
    trace: Doubles,
    *,
    name: str | None = None,
    seed: int = 1,
    policy: str = "",
    start: Sequence[float] = (0.0, 0.0, 0.0),
    quality: float = 0.0,
) -> Take:
    """Keep a trace [T,4] (10 controls a second, in the character frame) with the armature, and select it in the list.

    The name (default "Take") gets a number where another take has it. `start` is the character frame, as Player.frame:
    x, y in metres and the heading in radians. UserError on what is no trace; the file is changed only afterwards.
    """
    data = _packed(trace)
    settings = obj.fragmotion
    name = unique_name(name or "Take", [take.name for take in settings.takes])
    take: Take = settings.takes.add()
    take.name, take.seed, take.policy, take.start, take.quality = name, seed, policy, start, quality
    take.date = datetime.now().strftime("%Y-%m-%d %H:%M")
    _store(take, data, len(trace))
    settings.active_take = len(settings.takes) - 1
    return take


def trace_of(take: Take) -> Doubles:
    """The take's trace [T,4], to the bit as it was given; UserError where the .blend is damaged."""
    try:
        unpacker = zlib.decompressobj()
        data = unpacker.decompress(take.controls, _LONGEST * _COLUMNS * np.dtype(_NUMBER).itemsize)
        if not unpacker.eof:
            raise ValueError
        trace: Doubles = np.frombuffer(data, _NUMBER).reshape(-1, _COLUMNS).astype(float)
    except (zlib.error, ValueError):
        raise UserError(f"Take '{take.name}' is damaged: delete it, and record or import it again") from None
    return trace


def set_trace(take: Take, trace: Doubles) -> None:
    """Replace the take's trace; UserError on what is no trace."""
    _store(take, _packed(trace), len(trace))


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


def _store(take: Any, data: bytes, length: int) -> None:
    take.controls, take.seconds = data, length / TRACE_RATE


def _packed(trace: Doubles) -> bytes:
    """The trace as compressed little-endian numbers with a checksum; UserError on what is no trace."""
    values = np.asarray(trace, float)
    if values.ndim != 2 or values.shape[1] != _COLUMNS or not 0 < len(values) <= _LONGEST:
        raise UserError("A take needs between one control and a day of them, of four numbers each")
    if not np.isfinite(values).all() or np.abs(values[:, 2]).max() > 1 or not _within_unit(values[:, 3]):
        raise UserError("A take's controls must be finite, its turn within -1 and 1, and its jump within 0 and 1")
    return zlib.compress(values.astype(_NUMBER).tobytes())


def _within_unit(values: Doubles) -> bool:
    return bool(((values >= 0) & (values <= 1)).all())
