# SPDX-License-Identifier: GPL-3.0-or-later
"""How many of its controls a character does, by kinds that people have words for."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from .control_layout import ControlLayout

if TYPE_CHECKING:
    from fragmotion_core import Character

WELL = 0.3
"""ControlDis within which a fragment performs a control well, as in the core's synthesis."""

_JUMPS = 0.75  # evident jump of what the core calls one

_AHEAD, _BACK = 60, 120  # degrees from forward
COLUMNS = ("Go", "Turn", "Jump")
"""The kinds in each row: without a turn or jump, turning, and jumping."""


class Row(NamedTuple):
    """Controls of similar velocities: how many are done, and how many there are, for each of COLUMNS."""

    name: str
    performed: list[int]
    total: list[int]


def makes_its_jumps(character: Character) -> bool:
    """Whether it jumps, but no take does: its jumps were all synthesized."""
    jumping = character.evident[:, 3] > _JUMPS
    captured = np.isin(character.fragment_origins, ("captured", "mirrored"))
    return bool(jumping.any() and not (jumping & captured).any())


def measure_coverage(done: Sequence[bool], layout: ControlLayout) -> list[Row]:
    """A table of all controls, from which of them are done, as core.abilities() tells."""
    table_of_done = np.asarray(done, bool).reshape(layout.shape)
    middle = layout.shape[1] // 2  # of the turns: none
    table = []
    for name, velocities in _rows(layout).items():
        some = table_of_done[velocities]
        cells = [some[:, middle, 0], np.delete(some, middle, 1)[:, :, 0], some[:, :, 1:]]
        table.append(Row(name, [int(cell.sum()) for cell in cells], [cell.size for cell in cells]))
    return table


def _rows(layout: ControlLayout) -> dict[str, list[int]]:
    """Numbers of velocities, by what they are called."""
    rows: dict[str, list[int]] = {"Stand": [0]}
    for speed, gait in enumerate(layout.gaits):
        for kind in ("ahead", "aside", "back"):
            rows[f"{gait.title()} {kind}"] = []
        for direction in range(layout.directions):
            off = 360 / layout.directions * min(direction, layout.directions - direction)
            kind = "ahead" if off < _AHEAD else "aside" if off < _BACK else "back"
            rows[f"{gait.title()} {kind}"].append(1 + speed * layout.directions + direction)
    return rows


def lacking(tables: Mapping[str, Sequence[Row]]) -> list[str]:
    """What to warn of: what none of the controls of a kind is done of in a style, and some are in another;
    from each style's table."""
    kinds = {style: _performed(table) for style, table in tables.items()}
    known = dict.fromkeys(kind for performed in kinds.values() for kind in performed)
    warnings = []
    for style, performed in kinds.items():
        missing = [kind for kind in known if kind not in performed]
        if missing:
            warnings.append(
                f"Style '{style}' has no takes to make these of, and does what comes nearest: {', '.join(missing)}"
            )
    return warnings


def _performed(table: Sequence[Row]) -> list[str]:
    """The kinds of which any control is done: the rows without turn and jump, and jumps at all."""
    jump = COLUMNS.index("Jump")
    jumps = ["Jump"] if any(row.performed[jump] for row in table) else []
    return [row.name for row in table if row.performed[0]] + jumps
