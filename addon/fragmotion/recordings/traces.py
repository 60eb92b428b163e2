# SPDX-License-Identifier: GPL-3.0-or-later
"""The trace that a stage's settings ask for."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import bpy

from ..compat.core import core
from ..errors import UserError, core_errors
from ..files import check_regular
from .recordings import trace_of, trained_on

if TYPE_CHECKING:
    from fragmotion_core import ControlSpace, Doubles


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


def make_trace(settings: Any, space: ControlSpace | None = None) -> Doubles:
    """The trace [T,4] of settings that have TraceFields, player, seconds and seed."""
    if settings.trace_source == "PLAYER":
        with core_errors("Simulated player"):
            simulated: Doubles = core.simulate_trace(settings.player, settings.seconds, settings.seed, space)
            return simulated
    if not settings.trace_file:
        raise UserError("No trace file is chosen: choose a CSV file, or Simulated as the trace")
    path = Path(bpy.path.abspath(settings.trace_file))
    check_regular(path)
    with core_errors():
        trace: Doubles = core.read_trace(path)
        return trace
