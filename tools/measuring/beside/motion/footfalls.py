# SPDX-License-Identifier: MIT
"""Whether the feet alternate as feet do: told by the core where it tells it, and else by the core's own definition of
when a foot stands."""

from __future__ import annotations

from collections.abc import Sequence

import fragmotion_core as core
import numpy as np
from fragmotion_command.evaluate.rotations import Array
from scipy.signal import savgol_filter

from tools.measuring.peers.kinematics.bodies import RATE, Body, Motion, derived, world
from tools.measuring.peers.motion_matching.library import floors_of

_LOW, _SLOW, _SLOW_SHARE, _SHORTEST = 0.045, 0.5, 0.2, 4  # m, m/s, of the hips' speed, frames
_MOVING, _QUICK, _AROUND = 0.5, 0.2, 31  # m/s, s, frames


def figures(
    body: Body, takes: Sequence[Motion], motions: Sequence[Motion], measured: Sequence[core.MotionMeasures]
) -> dict[str, float]:
    """Of all steps of motions, while they go faster than half a metre a second: percent of the foot that came down
    last, and of the other one less than a fifth of a second later."""
    told = [getattr(each, "footfalls", None) for each in measured]
    counted = [(f.count, f.same_foot, f.quick) for f in told if f is not None] or _count_all(body, takes, motions)
    steps, same, quick = np.sum(counted, axis=0)
    return {"same_foot_percent": 100 * same / max(steps, 1), "quick_steps_percent": 100 * quick / max(steps, 1)}


def _count_all(body: Body, takes: Sequence[Motion], motions: Sequence[Motion]) -> list[tuple[int, int, int]]:
    floors = floors_of(body, takes, [*body.toes, *body.feet])
    return [count(body, motion, floors) for motion in motions if len(motion.root) > _AROUND]


def count(body: Body, motion: Motion, floors: Array) -> tuple[int, int, int]:
    """Steps, those of the same foot as before, and those of the other foot too soon; `floors` [4] of left and right
    balls and left and right heels, m of a character of 1.8 m."""
    heads = world(body, motion.root, motion.rotations)[0] * body.scale
    flags = _contacts(heads[:, [*body.toes, *body.feet]], heads[:, 0], floors)
    moving = np.linalg.norm(savgol_filter(heads[:, 0, :2], _AROUND, 1, deriv=1, delta=1 / RATE, axis=0), axis=1)
    strikes = sorted((f, s) for s in range(2) for f in np.flatnonzero(flags[1:, s] & ~flags[:-1, s]) + 1)
    steps = same = quick = 0
    for (before, other), (now, side) in zip(strikes[:-1], strikes[1:]):
        if (moving[before : now + 1] > _MOVING).all():
            steps += 1
            same += side == other
            quick += bool(side != other and now - before < _QUICK * RATE)
    return steps, same, quick


def _contacts(points: Array, hips: Array, floors: Array) -> Array:
    """[F,2]: a foot stands with its ball or its heel."""
    limit = _SLOW + _SLOW_SHARE * np.linalg.norm(derived(hips), axis=-1)
    slow = np.linalg.norm(derived(points), axis=-1) < limit[:, None]
    stands = (points[..., 2] - floors < _LOW) & slow
    return np.stack([_closed(stands[:, side] | stands[:, side + 2]) for side in range(2)], 1)


def _closed(flags: Array) -> Array:
    """Without gaps, and then without contacts, of less than _SHORTEST frames."""
    flags = flags.copy()
    for value in (False, True):
        changes = np.flatnonzero(np.diff(flags)) + 1
        for begin, end in zip(changes[:-1], changes[1:]):
            if flags[begin] == value and end - begin < _SHORTEST:
                flags[begin:end] = not value
    return flags
