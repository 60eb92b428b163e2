# SPDX-License-Identifier: MIT
"""What else poses tell: how smooth head and hands go, how feet stand and step, and how hips sway."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from ..rotations import Array
from .poses import RATE, Body, Poses, derived, heading
from .windows import LENGTH, Span, beginnings

_LOW, _SLOW, _SHORTEST = 0.05, 0.25, 6  # m, m/s and frames: where and how long a ball stands
_MOVING = 0.5  # m/s of the hips in a step
_TOO_FAST, _LEAST_TURN = 1.25, 1.0  # of the takes' fastest turn, and rad/s that count as the takes' at least


class Stance(NamedTuple):
    """A foot that stands."""

    foot: int
    begin: int
    end: int


@dataclass
class _Seen:
    """Of all motions: squares of jerks, what windows and stances show, and how much there is of each."""

    head: list[float] = field(default_factory=list)
    hands: list[float] = field(default_factory=list)
    sway: list[float] = field(default_factory=list)
    ripple: list[float] = field(default_factory=list)
    travel: list[float] = field(default_factory=list)
    under: list[float] = field(default_factory=list)
    uneven: list[float] = field(default_factory=list)
    seconds: float = 0.0
    steps: int = 0


def floor_of(body: Body, motions: Sequence[Poses]) -> float:
    """How high balls are where they stand, m."""
    return float(np.median([np.percentile(motion.heads[:, body.balls, 2], 5) for motion in motions]))


def seen_in(body: Body, motions: Sequence[Poses], spans: Sequence[Sequence[Span]], floor: float) -> dict[str, float]:
    """Of spans of motions: jerks (m/s^3, root mean square; hands seen from the hips), vertical travel of a ball that
    stands (mm, median) and its lowest place over the floor (mm, 5th percentile), stances and steps a second, the longer
    over the shorter of a left step's time and the next right one's (median), and the standard deviation in a window of
    the turn rate (rad/s) and the speed (m/s; medians)."""
    seen = _Seen()
    for motion, parts in zip(motions, spans):
        _see(seen, body, motion.heads, [(begin, end) for begin, end in parts if end - begin >= LENGTH], floor)
    return {
        "head_jerk": float(np.sqrt(np.mean(seen.head))),
        "hands_jerk": float(np.sqrt(np.mean(seen.hands))),
        "ball_travel": 1e3 * _median(seen.travel),
        "ball_under": 1e3 * float(np.percentile(seen.under, 5)) if seen.under else float("nan"),
        "stances": len(seen.travel) / seen.seconds,
        "steps": seen.steps / seen.seconds,
        "left_right": _median(seen.uneven),
        "sway": _median(seen.sway),
        "ripple": _median(seen.ripple),
    }


def _median(values: Sequence[float]) -> float:
    return float(np.median(values)) if values else float("nan")


def _see(seen: _Seen, body: Body, heads: Array, spans: Sequence[Span], floor: float) -> None:
    hips = heads[:, body.hips]
    head = _squared_jerk(heads[:, body.head])
    hands = [_squared_jerk(heads[:, hand] - hips) for hand in body.hands]
    turning, speed = derived(heading(body, heads)), np.linalg.norm(derived(hips[:, :2]), axis=1)
    for first in beginnings(spans):
        seen.sway.append(float(turning[first : first + LENGTH].std()))
        seen.ripple.append(float(speed[first : first + LENGTH].std()))
    for begin, end in spans:
        seen.seconds += (end - begin) / RATE
        seen.head.append(float(head[begin:end].mean()))
        seen.hands += [float(hand[begin:end].mean()) for hand in hands]
        stances = list(_stances(body, heads, (begin, end), floor))
        for foot, down, up in stances:
            height = heads[down:up, body.balls[foot], 2]
            seen.travel.append(float(np.ptp(height)))
            seen.under.append(float(height.min()) - floor)
        _see_steps(seen, sorted(stances, key=lambda stance: stance.begin), speed, begin)


def _squared_jerk(path: Array) -> Array:
    squared: Array = np.sum(derived(path, 3) ** 2, axis=1)
    return squared


def _stances(body: Body, heads: Array, span: Span, floor: float) -> Iterator[Stance]:
    begin, end = span
    for foot, ball in enumerate(body.balls):
        slow = np.linalg.norm(derived(heads[:, ball, :2]), axis=1) < _SLOW
        stands = (slow & (heads[:, ball, 2] < floor + _LOW))[begin:end]
        edges = begin + np.flatnonzero(np.diff(np.concatenate(([0], stands.astype(int), [0]))))
        for down, up in zip(edges[::2], edges[1::2]):
            if up - down >= _SHORTEST:
                yield Stance(foot, int(down), int(up))


def _see_steps(seen: _Seen, stances: Sequence[Stance], speed: Array, begin: int) -> None:
    """A step is from one foot's touch-down to the other's, while the hips move."""
    came_down = [stance for stance in stances if stance.begin > begin]
    steps = [
        later.begin - sooner.begin
        if later.foot != sooner.foot and speed[sooner.begin : later.begin].min(initial=np.inf) > _MOVING
        else 0
        for sooner, later in zip(came_down, came_down[1:])
    ]
    seen.steps += sum(step > 0 for step in steps)
    seen.uneven += [max(pair) / min(pair) for pair in zip(steps, steps[1:]) if min(pair) > 0]


def fastest_turns(motions: Sequence[Poses]) -> Array:
    """[B] rad/s: as fast as each bone ever turns, but for the first and last fifth of a second of a motion."""
    margin = round(0.2 * RATE)
    long = [motion.turns[margin:-margin] for motion in motions if len(motion.turns) > 2 * margin]
    fastest: Array = np.concatenate(long).max(0)
    return fastest


def whips(motions: Sequence[Poses], fastest: Array) -> float:
    """How often a minute a bone comes to turn faster than 1.25 times its fastest."""
    limit = _TOO_FAST * np.maximum(fastest, _LEAST_TURN)
    begun = frames = 0
    for motion in motions:
        fast = np.any(motion.turns > limit, axis=1).astype(int)
        begun += int(np.count_nonzero(np.diff(fast, prepend=0) > 0))
        frames += len(fast)
    return 60 * RATE * begun / frames
