# SPDX-License-Identifier: GPL-3.0-or-later
"""The trace that a stage's settings ask for, and trace files."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy

from ..compat.core import core
from ..errors import UserError, core_errors
from ..files import check_regular
from .asked import Asked, StartedMove, number_moves
from .looks import LookChange
from .reaches import ReachChange
from .recordings import trace_of, trained_on
from .styles import StyleChange, Styled, numbered

if TYPE_CHECKING:
    from fragmotion_core import ControlSpace, Doubles

_FIRST_LINE = 2  # of a trace file's controls


def make_traces(obj: bpy.types.Object, settings: Any, space: ControlSpace) -> list[Doubles]:
    """The traces [T,4] that Build learns from, as settings with BuildFields say; a simulated player asks for what the
    space has."""
    if settings.trace_source != "RECORDINGS":
        return [make_trace(settings, space)]
    ticked = trained_on(obj)
    if not ticked:
        raise UserError(
            f"No recording of armature '{obj.name}' is ticked to train on: record or import one and tick it under "
            "Recordings, or choose Simulated as the trace"
        )
    return [trace_of(recording) for recording in ticked]


def make_trace(settings: Any, space: ControlSpace) -> Doubles:
    """The trace [T,4] of settings that have TraceFields, player, seconds and seed."""
    if settings.trace_source == "PLAYER":
        with core_errors("Simulated player"):
            simulated: Doubles = core.simulate_trace(settings.player, settings.seconds, settings.seed, space)
            return simulated
    return read_trace_file(_file_of(settings))[0]


def asked_beside(
    settings: Any, move_names: Sequence[str], style_names: Sequence[str], style: int = 0
) -> tuple[list[list[int]], Styled, Asked]:
    """What the trace of settings as those of make_trace() asks for beside: moves [M,3] and styles, numbered as the
    character's names are, by default beginning in `style`, and all by names. UserError where it does not have a
    move."""
    if settings.trace_source != "FILE":
        return [], Styled(style), Asked()
    path = _file_of(settings)
    _, asked = read_trace_file(path)
    moves = number_moves(asked.moves, move_names, lambda move: f"'{path}', line {move.control + _FIRST_LINE},")
    styled = numbered(asked.style, asked.styles, style_names)
    return moves, styled if asked.style else styled._replace(begin=style), asked


def read_trace_file(path: Path) -> tuple[Doubles, Asked]:
    """The trace [T,4] of a CSV file, and what it asks for beside; UserError with the line on what is none."""
    check_regular(path)
    with core_errors():
        moves, styles, looks, reaches = core.read_asked(path)
        begin = [name for control, name in styles if control == 0]
        changes = [StyleChange(*style) for style in styles[len(begin) :]]
        asked = Asked(
            [StartedMove(*move) for move in moves],
            "".join(begin),
            changes,
            [LookChange(*look) for look in looks],
            [ReachChange(*reach) for reach in reaches],
        )
        return core.read_trace(path), asked


def write_trace_file(path: Path, trace: Doubles, asked: Asked) -> None:
    """Write what read_trace_file() reads; UserError where that cannot be."""
    begins = [StyleChange(0, asked.style)] if asked.style else []
    with core_errors():
        core.write_trace(
            path, trace, list(asked.moves), [*begins, *asked.styles], list(asked.looks), list(asked.reaches)
        )


def _file_of(settings: Any) -> Path:
    if not settings.trace_file:
        raise UserError("No trace file is chosen: choose a CSV file, or Simulated as the trace")
    return Path(bpy.path.abspath(settings.trace_file))
