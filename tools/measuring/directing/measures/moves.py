# SPDX-License-Identifier: MIT
"""How long moves wait for their moment, and how smoothly they begin and end."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import fragmotion_core as core
import numpy as np

from tools.measuring import blend
from tools.measuring.directing.measures.seams import RATE, TRACE_RATE, marked

_PRESSES = range(20, 40, 3)  # controls before which a move is started, so that it meets every phase of a gait
_AFTER = 20  # controls that are played after a move's longest time
_PEDAL = 1e-6  # m


def listed_moves(mocap: Sequence[Path]) -> list[core.Move]:
    """The moves that a .blend lists; none of other motion capture."""
    return blend.read_moves(mocap[0]) if mocap[0].suffix.lower() == ".blend" else []


def moves(character: core.Character) -> list[dict[str, Any]]:
    """A row for each move, over standing, walking, running and turning: the longest time from its key to its
    beginning, s, and the furthest that a joint goes in a frame within a quarter of a second after it begins, loops or
    ends, over what joints do in the takes (99.9th percentile) or, where that is more, in the move itself."""
    metrics = core.MotionMetrics(character)
    takes = metrics.takes.positions.p999
    rows = []
    for number, move in enumerate(character.moves):
        played = list(_performances(character, number, move))
        usual = max(takes, _own_step(character, move), _PEDAL)
        rows.append(
            {
                "name": move.name,
                "wait_s": max(_waited(p, number, press) for press, p in played),
                "joint_step_ratio": max(
                    metrics.of(marked(character, p, _changes(p))).positions.worst for _, p in played
                )
                / usual,
            }
        )
    return rows


def _performances(character: core.Character, number: int, move: core.Move) -> Iterator[tuple[int, core.Performance]]:
    space = character.space
    lasts = round((len(move.clip.root_positions) / move.clip.rate + move.wait) * TRACE_RATE) + _AFTER
    for control in ((0, 0, 0, 0), (0, space.walk, 0, 0), (0, space.run, 0, 0), (0, space.walk, 1, 0)):
        for press in _PRESSES:
            trace = np.tile(np.array(control, float), (press + lasts, 1))
            yield press, core.Player(character).run(trace, RATE, moves=[[press, number, 1]])


def _waited(performance: core.Performance, number: int, press: int) -> float:
    """Seconds from the press to the first frame that shows the move."""
    plays = np.flatnonzero((np.asarray(performance.moves) == number).any(1))
    return float(max(plays[0] / RATE - press / TRACE_RATE, 0.0)) if len(plays) else float("inf")


def _changes(performance: core.Performance) -> Any:
    """At which frames [F-1], from the second on, a move begins, loops or ends."""
    playing, entered = np.asarray(performance.moves), np.asarray(performance.entered)
    return (np.diff(playing, axis=0) != 0).any(1) | ((np.diff(entered) != 0) & (playing[1:, 0] >= 0))


def _own_step(character: core.Character, move: core.Move) -> float:
    """The furthest that a joint goes in the move in a frame of RATE, m of a character of 1.8 m."""
    heads, _ = move.clip.world_transforms(character.skeleton)
    steps = np.linalg.norm(np.diff(heads, axis=0), axis=2) * move.clip.rate / RATE
    return float(steps.max() * character.space.scale)
