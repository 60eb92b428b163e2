# SPDX-License-Identifier: GPL-3.0-or-later
"""How many of the 102 controls a character performs well, by kinds that people have words for."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..compat.core import core

if TYPE_CHECKING:
    from fragmotion_core import Character, Doubles

WELL = 0.3
"""ControlDis within which a fragment performs a control, as in the core's synthesis."""

_JUMPS = 0.75  # evident jump of what the core calls one

# Numbers of the velocities, counter-clockwise from forward.
_ROWS = {
    "Stand": [0],
    "Walk ahead": [8, 1, 2],
    "Walk aside": [3, 7],
    "Walk back": [4, 5, 6],
    "Run ahead": [16, 9, 10],
    "Run aside": [11, 15],
    "Run back": [12, 13, 14],
}
# Turns (right, none, left) and jumps (no, yes).
_COLUMNS = {"Go": (slice(1, 2), 0), "Turn": (slice(0, 3, 2), 0), "Jump": (slice(0, 3), 1)}
COLUMNS = tuple(_COLUMNS)
"""The kinds in each row: without a turn or jump, turning, and jumping."""


class Row(NamedTuple):
    """Controls of similar velocities: how many are performed well, and how many there are, for each of COLUMNS."""

    name: str
    performed: list[int]
    total: list[int]


def makes_its_jumps(character: Character) -> bool:
    """Whether it jumps, but no take does: its jumps were all synthesized."""
    jumping = character.evident[:, 3] > _JUMPS
    captured = np.isin(character.fragment_origins, ("captured", "mirrored"))
    return bool(jumping.any() and not (jumping & captured).any())


def measure_coverage(distances: Doubles) -> list[Row]:
    """A table of all controls, from each control's ControlDis [102] to the nearest fragment."""
    well = (np.asarray(distances) <= WELL).reshape(core.ControlSpace.SHAPE)
    table = []
    for name, velocities in _ROWS.items():
        cells = [well[velocities][:, turns, jump] for turns, jump in _COLUMNS.values()]
        table.append(Row(name, [int(cell.sum()) for cell in cells], [cell.size for cell in cells]))
    return table
