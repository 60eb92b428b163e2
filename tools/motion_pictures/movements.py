# SPDX-License-Identifier: MIT
"""The movements that the sheets show: what is asked of the character, and which take is nearest to it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, NamedTuple

import fragmotion_core as core
import numpy as np
from numpy.typing import NDArray

STEPS_A_SECOND = 10  # of a trace
_FASTEST = 3  # times as fast as asked for, at which a take may do a movement
_WAITING = 0.5  # ControlDis that it costs to wait for the movement in a moment of the take
_QUICKLY = 9.0  # turn rates: more than any character's
_UNLIKE = 1.5  # mean ControlDis of a movement's parts from which on a take is no example of it


class Part(NamedTuple):
    """A control that is held: speed by name, direction in degrees (left positive), turn (1 left; what is more than the
    character's quickest turn is that), jump (0, 1)."""

    seconds: float
    speed: str  # stand, slow, walk, jog or run
    direction: float = 0
    turn: float = 0
    jump: float = 0


class Movement(NamedTuple):
    """Parts one after the other, and those of them that a take should be an example of (all where none is named)."""

    name: str
    title: str
    parts: tuple[Part, ...]
    example: tuple[Part, ...] = ()


MOVEMENTS = (
    Movement("held-walk", "A walk, held", (Part(5.5, "walk"),)),
    Movement("stand", "A stand, held", (Part(5.5, "stand"),)),
    Movement(
        "walk-run-stop",
        "Walk, run, stop",
        (Part(0.6, "stand"), Part(1.6, "walk"), Part(1.8, "run"), Part(2, "stand")),
    ),
    Movement(
        "sharp-turns",
        "Sharp turns: left, straight on, right, and running to the left",
        (Part(0.8, "walk"), Part(1.4, "walk", turn=1), Part(0.6, "walk"), Part(1.8, "walk", turn=-1),
         Part(1.4, "run", turn=1)),
        (Part(1, "walk"), Part(1.2, "walk", turn=1), Part(1.2, "walk", turn=-1)),
    ),
    Movement(
        "sidestep",
        "Sidestep to the left, then to the right",
        (Part(0.6, "stand"), Part(2.2, "walk", 90), Part(2.2, "walk", -90), Part(1, "stand")),
        (Part(3, "walk", 90),),
    ),
    Movement(
        "walk-jump",
        "Walk, jump, walk, jump",
        (Part(1.4, "walk"), Part(0.3, "walk", jump=1), Part(2.1, "walk"), Part(0.3, "walk", jump=1), Part(1.9, "walk")),
        (Part(1.4, "walk"), Part(0.3, "walk", jump=1), Part(1.4, "walk")),
    ),
    Movement(
        "start-stop",
        "Start, stop, start, stop",
        (Part(0.8, "stand"), Part(1.4, "walk"), Part(1.2, "stand"), Part(1.4, "walk"), Part(1.2, "stand")),
        (Part(0.8, "stand"), Part(1.4, "walk"), Part(1.2, "stand")),
    ),
    Movement(
        "run-stop",
        "Start into a run, and stop from it",
        (Part(0.6, "stand"), Part(2.2, "run"), Part(1.6, "stand")),
    ),
    Movement(
        "reversal",
        "From a run forward to a walk backward",
        (Part(1.8, "run"), Part(2.4, "walk", 180)),
        (Part(1.6, "walk", 180),),
    ),
    Movement(
        "about-face",
        "About-face in a walk",
        (Part(1.4, "walk"), Part(1.1, "stand", turn=_QUICKLY), Part(1.7, "walk")),
        (Part(1.4, "walk"), Part(1.4, "stand", turn=1)),
    ),
    Movement(
        "jump",
        "Jump on the spot",
        (Part(0.8, "stand"), Part(0.3, "stand", jump=1), Part(1.9, "stand")),
        (Part(0.3, "stand"), Part(0.4, "stand", jump=1), Part(0.6, "stand")),
    ),
    Movement(
        "slow-to-fast",
        "From slow to fast: under a walk, a walk, between walk and run, a run",
        (Part(1.4, "slow"), Part(1.4, "walk"), Part(1.4, "jog"), Part(1.4, "run")),
        (Part(1.4, "walk"), Part(1.4, "run")),
    ),
)  # fmt: skip


def trace_of(parts: tuple[Part, ...], space: core.ControlSpace) -> core.Doubles:
    """[T,4]: the parts as controls."""
    jog = (space.walk + space.run) / 2
    speeds = {"stand": 0.0, "slow": space.walk / 2, "walk": space.walk, "jog": jog, "run": space.run}
    rows = []
    for part in parts:
        angle, speed = np.radians(part.direction), speeds[part.speed]
        turn = np.clip(part.turn, -space.quickest_turn, space.quickest_turn)
        row = (-speed * np.sin(angle), speed * np.cos(angle), turn, part.jump)
        rows += [row] * _steps(part)
    return np.array(rows)


def _steps(part: Part) -> int:
    return round(part.seconds * STEPS_A_SECOND)


class Example(NamedTuple):
    """A span of a captured take, s."""

    clip: str
    start: float
    end: float


def nearest_take(character: core.Character, parts: tuple[Part, ...]) -> Example | None:
    """The span of a captured take whose evident controls are nearest to the parts', in any time; None where none is
    like them."""
    trace = trace_of(parts, character.space)
    weights = np.concatenate([np.full(count, 1 / count / len(parts)) for count in map(_steps, parts)])
    found = [(*_align(distances, weights), name) for name, distances in _distances(character, trace)]
    distance, start, end, name = min(found)
    return Example(name, start / STEPS_A_SECOND, end / STEPS_A_SECOND) if distance < _UNLIKE else None


def _distances(character: core.Character, trace: core.Doubles) -> Iterator[tuple[str, core.Doubles]]:
    """Of each captured take, ControlDis [T,C] between the trace's controls and the take's at the same rate."""
    controls, index = np.unique(trace, axis=0, return_inverse=True)
    captured = np.flatnonzero(np.array(character.fragment_origins) == "captured")
    for clip in np.unique(character.fragment_clips[captured]):
        own = captured[character.fragment_clips[captured] == clip]
        spans = character.fragment_ranges[own]
        times = np.arange(0, spans.max(), 1 / STEPS_A_SECOND)
        at = np.abs(times[:, None] - spans.mean(axis=1)).argmin(axis=1)
        table = np.array([[character.space.distance(c, e) for e in character.evident[own]] for c in controls])
        yield character.clip_names[clip], table[index.ravel()][:, at]


def _align(distances: core.Doubles, weights: core.Doubles) -> tuple[float, int, int]:
    """Dynamic time warping: the least weighted sum along a way through [T,C] that goes on by 0 to _FASTEST steps of the
    take for every step of the trace, and where in the take that way starts and ends."""
    costs, starts = weights[0] * distances[0], np.arange(distances.shape[1])
    for weight, row in zip(weights[1:], distances[1:]):
        earlier = np.array([_shifted(costs, k, np.inf) for k in range(_FASTEST + 1)])
        earlier[0] += weight * _WAITING
        best = earlier.argmin(axis=0)
        costs = earlier.min(axis=0) + weight * row
        starts = np.choose(best, [_shifted(starts, k, 0) for k in range(_FASTEST + 1)])
    end = int(costs.argmin())
    return float(costs[end]), int(starts[end]), end + 1


def _shifted(values: NDArray[Any], steps: int, fill: float) -> NDArray[Any]:
    """Moved to higher indices."""
    return np.concatenate([np.full(steps, fill, values.dtype), values[: len(values) - steps]])
