# SPDX-License-Identifier: GPL-3.0-or-later
"""What a character can do, in words."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ..compat.core import core
from .control_layout import ControlLayout, layout_of

if TYPE_CHECKING:
    from fragmotion_core import ControlSpace
    from numpy.typing import NDArray

NOTHING = "Hardly moves: none of its takes goes anywhere, as far as can be told"
_VERBS = {"stroll": "strolls", "walk": "walks", "jog": "jogs", "run": "runs", "sprint": "sprints"}
_MOST = 3 / 4  # of so many: as good as all


def say_abilities(done: Sequence[bool], layout: ControlLayout) -> str:
    """A sentence of what is done of the controls [controls]; NOTHING where it goes nowhere."""
    table = np.asarray(done, bool).reshape(layout.shape)
    middle = layout.shape[1] // 2  # of the turns: none
    going = {
        gait: table[1 + i * layout.directions : 1 + (i + 1) * layout.directions] for i, gait in enumerate(layout.gaits)
    }
    ways = {gait: _ways(some[:, middle, 0], layout) for gait, some in going.items()}
    if not any(ways.values()):
        return NOTHING
    clauses = [" and ".join(_phrases(ways))]
    if layout.turn:
        clauses += _turns({gait: np.delete(some, middle, 1)[:, :, 0] for gait, some in going.items() if ways[gait]})
    clauses += [f"no {gait}" for gait in layout.gaits if not ways[gait]]
    if layout.jump:
        clauses.append("jumps" if table[:, :, 1].any() else "no jumps")
    told = "; ".join(clauses)
    return told[0].upper() + told[1:]


def say_undone(done: Sequence[bool], space: ControlSpace) -> str:
    """Which ways to go are not done as they are asked for, and what is done instead; empty where all are, or none."""
    undone = core.undone_controls(space, done)
    if not undone or say_abilities(done, layout_of(space)) == NOTHING:
        return ""
    return (
        f"Cannot {', '.join(undone)} as it is asked to: no take shows how, and none could be made that does. "
        "What comes nearest is done instead"
    )


def _phrases(ways: dict[str, str]) -> list[str]:
    """As 'walks and runs in all directions': what goes the same ways is said together."""
    phrases = []
    for way in dict.fromkeys(filter(None, ways.values())):
        phrases.append(f"{' and '.join(_VERBS[gait] for gait in ways if ways[gait] == way)} {way}")
    return phrases


def _ways(done: NDArray[np.bool_], layout: ControlLayout) -> str:
    if done.all():
        return "in all directions"
    if done.sum() >= _MOST * len(done):
        lacking = [name for name, is_done in zip(layout.direction_names, done) if not is_done]
        return f"in all directions but {' and '.join(lacking)}"
    return ", ".join(name for name, is_done in zip(layout.direction_names, done) if is_done)


def _turns(done: dict[str, NDArray[np.bool_]]) -> list[str]:
    """What is lacking of the turns of each gait."""
    none = [gait for gait, some in done.items() if not some.any()]
    few = [gait for gait, some in done.items() if some.any() and some.mean() < _MOST]
    return [f"{much} turns at a {' or a '.join(gaits)}" for much, gaits in (("no", none), ("few", few)) if gaits]
