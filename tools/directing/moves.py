# SPDX-License-Identifier: MIT
"""How long moves wait for their moment, and how smoothly they begin and end."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import fragmotion_core as core
import numpy as np

RATE = 60.0  # frames a second
_TRACE_RATE = 10  # controls a second
_PRESSES = range(20, 40, 3)  # controls before which a move is started, so that it meets every phase of a gait
_AFTER = 20  # controls that are played after a move's longest time
_PEDAL = 1e-6  # m


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
                "joint_step_ratio": max(metrics.of(_marked(character, p)).positions.worst for _, p in played) / usual,
            }
        )
    return rows


def _performances(character: core.Character, number: int, move: core.Move) -> Iterator[tuple[int, core.Performance]]:
    space = character.space
    lasts = round((len(move.clip.root_positions) / move.clip.rate + move.wait) * _TRACE_RATE) + _AFTER
    for control in ((0, 0, 0, 0), (0, space.walk, 0, 0), (0, space.run, 0, 0), (0, space.walk, 1, 0)):
        for press in _PRESSES:
            trace = np.tile(np.array(control, float), (press + lasts, 1))
            yield press, core.Player(character).run(trace, RATE, moves=[[press, number, 1]])


def _waited(performance: core.Performance, number: int, press: int) -> float:
    """Seconds from the press to the first frame that shows the move."""
    plays = np.flatnonzero((np.asarray(performance.moves) == number).any(1))
    return float(max(plays[0] / RATE - press / _TRACE_RATE, 0.0)) if len(plays) else float("inf")


def _marked(character: core.Character, performance: core.Performance) -> core.Performance:
    """The performance, in which moves that begin, loop and end are all that is begun."""
    playing, entered = np.asarray(performance.moves), np.asarray(performance.entered)
    changes = (np.diff(playing, axis=0) != 0).any(1)
    loops = (np.diff(entered) != 0) & (playing[1:, 0] >= 0)
    begun = np.concatenate(([0], np.cumsum(changes | loops)))
    clip = core.Clip(character.skeleton, "played", RATE, performance.root_positions, np.array(performance.rotations))
    controls = round((len(begun) - 1) / RATE * _TRACE_RATE)
    return core.judge_clip(character, np.zeros((controls, 4)), clip, begun.tolist())


def _own_step(character: core.Character, move: core.Move) -> float:
    """The furthest that a joint goes in the move in a frame of RATE, m of a character of 1.8 m."""
    heads, _ = move.clip.world_transforms(character.skeleton)
    steps = np.linalg.norm(np.diff(heads, axis=0), axis=2) * move.clip.rate / RATE
    return float(steps.max() * character.space.scale)
