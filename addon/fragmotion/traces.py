# SPDX-License-Identifier: GPL-3.0-or-later
"""The trace that a stage's settings ask for."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import bpy

from .core import core
from .errors import UserError, core_errors

if TYPE_CHECKING:
    from fragmotion_core import ControlSpace, Doubles


def make_trace(settings: Any, space: ControlSpace | None = None) -> Doubles:
    """The trace [T,4] of settings that have TraceFields, player, seconds and seed."""
    if settings.trace_source == "PLAYER":
        with core_errors("Simulated player"):
            simulated: Doubles = core.simulate_trace(settings.player, settings.seconds, settings.seed, space)
            return simulated
    if not settings.trace_file:
        raise UserError("No trace file is chosen: choose a CSV file, or Simulated as the trace")
    with core_errors():
        trace: Doubles = core.read_trace(bpy.path.abspath(settings.trace_file))
        return trace
