# SPDX-License-Identifier: MIT
"""Performances in which only some of what begins is looked at."""

from __future__ import annotations

from typing import Any

import fragmotion_core as core
import numpy as np

RATE = 60.0
"""Frames a second of the performances."""

TRACE_RATE = 10
"""Controls a second."""


def marked(character: core.Character, performance: core.Performance, begins: Any) -> core.Performance:
    """The performance, in which what begins at these frames [F-1], from the second on, is all that is begun."""
    begun = np.concatenate(([0], np.cumsum(begins)))
    clip = core.Clip(character.skeleton, "played", RATE, performance.root_positions, np.array(performance.rotations))
    controls = round((len(begun) - 1) / RATE * TRACE_RATE)
    return core.judge_clip(character, np.zeros((controls, 4)), clip, begun.tolist())
