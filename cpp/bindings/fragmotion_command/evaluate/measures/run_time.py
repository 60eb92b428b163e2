# SPDX-License-Identifier: MIT
"""How the real player does at run time: it blends, plays whole fragments and answers late, as Fig. 5 does not see."""

from __future__ import annotations

import math
import statistics
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from ...core import core
from ..loading import Session
from . import weight

RATE = 60.0  # frames a second
PLAYERS = 3  # random seeds
_STILL = 1e-9  # so that takes without motion are no division by zero
FIGURES = (
    "percent_of_optimal",
    "velocity_error",
    "velocity_error_percent",
    "turn_error",
    "jump_error",
    "response_p50_s",
    "response_p95_s",
    "no_response_share",
    "foot_skate_ratio",
    "foot_turn_ratio",
    "joint_step_ratio",
    "sliding_contact_share",
    "drift_percent",
    "beyond_limits_share",
    "beyond_limits_degrees",
)
ACCELERATIONS = (
    "acceleration_p50",
    "acceleration_p99",
    "acceleration_p999",
    "acceleration_max",
    "acceleration_over_6",
    "hips_acceleration_over_6",
    "hips_acceleration_max",
)
FOLLOWING = ("velocity_error_limited", "drift", "drift_heading", "drift_limited", "drift_heading_limited")
BEYOND_PHYSICS = ("response_beyond_physics_p50_s", "response_beyond_physics_p95_s")
_BODY = 5.0  # m/s^2 by which a body of 1.8 m can change its velocity


ALL = (*FIGURES, *FOLLOWING, *ACCELERATIONS, *BEYOND_PHYSICS, *weight.SEEN, *weight.RATIOS, *weight.TRIALS)


def no_figures() -> dict[str, float | None]:
    """Optimal's run time: it is the yardstick, and cannot be played."""
    return {**dict.fromkeys(ALL), "percent_of_optimal": 100.0}


def best_qualities(character: core.Character, sessions: Sequence[Session]) -> list[float]:
    """The yardstick for each session: what a player could reach who knew it all."""
    return [core.optimal_performance(character, session.controls, RATE) for session in sessions]


def play(
    character: core.Character,
    policy: str,
    sessions: Sequence[Session],
    seed: int,
    players: int = PLAYERS,
    **options: Any,
) -> list[list[core.Performance]]:
    """Performances [session][player]."""
    seeds = range(seed, seed + players)
    return [
        [core.Player(character, s, policy=policy, **options).run(session.controls, RATE) for s in seeds]
        for session in sessions
    ]


def errors(performances: list[list[core.Performance]]) -> dict[str, float | None]:
    """Mean errors of velocity (m/s, and percent of the mean commanded speed), turn (degrees/s) and jump (share), and
    the root's drift from the exact path (percent of the mean commanded speed)."""
    every = [performance for some in performances for performance in some]
    velocity = statistics.fmean(p.velocity_error for p in every)
    return {
        "velocity_error": velocity,
        "velocity_error_percent": _percent_of_commanded(every, velocity),
        "drift_percent": _percent_of_commanded(every, statistics.fmean(p.drift for p in every)),
        "turn_error": math.degrees(statistics.fmean(p.turn_error for p in every)),
        "jump_error": statistics.fmean(p.jump_error for p in every),
    }


def following(performances: list[list[core.Performance]]) -> dict[str, float | None]:
    """Drift in two seconds (percent of the commanded way, and degrees of heading), and velocity error (percent) and
    drift against the command as a body can follow it, which is limited to 5 m/s^2 of a 1.8 m character."""
    every = [performance for some in performances for performance in some]
    return {
        "velocity_error_limited": _percent_of_commanded(
            every, statistics.fmean(p.velocity_error_limited for p in every)
        ),
        "drift": _percent_of_commanded(every, statistics.fmean(p.drift for p in every)),
        "drift_heading": math.degrees(statistics.fmean(p.drift_heading for p in every)),
        "drift_limited": _percent_of_commanded(every, statistics.fmean(p.drift_limited for p in every)),
        "drift_heading_limited": math.degrees(statistics.fmean(p.drift_heading_limited for p in every)),
    }


def _percent_of_commanded(every: Sequence[core.Performance], speed: float) -> float | None:
    commanded = statistics.fmean(p.commanded_speed for p in every)
    return 100 * speed / commanded if commanded > 0 else None


def looks(yardstick: core.MotionMetrics, performances: list[list[core.Performance]]) -> dict[str, float | None]:
    """Foot skate and how fast feet turn on the ground over the takes' own, the worst joint step at a stitch over the
    takes' 99.9th percentile (of places, a frame), the share of the time on the ground in which a foot slides,
    accelerations and what else tells a body's weight, and turns beyond the takes' limits."""
    takes, every = yardstick.takes, [yardstick.of(p) for some in performances for p in some]
    return {
        "foot_skate_ratio": statistics.fmean(m.foot_skate for m in every) / max(takes.foot_skate, _STILL),
        "foot_turn_ratio": statistics.fmean(m.foot_turn for m in every) / max(takes.foot_turn, _STILL),
        "joint_step_ratio": max(m.positions.worst for m in every) / max(takes.positions.p999, _STILL),
        "sliding_contact_share": statistics.fmean(m.sliding_share for m in every),
        **accelerations(every),
        **weight.beside_takes(yardstick, every),
        **_turns(every),
    }


def of_takes(character: core.Character) -> dict[str, float | None]:
    """The figures that takes have, too, of the captured ones."""
    takes = [core.MotionMetrics(character).takes]
    return {**accelerations(takes), **weight.seen(takes)}


def accelerations(measured: Sequence[core.MotionMeasures]) -> dict[str, float]:
    """Horizontal accelerations over 0.2 s, m/s^2 of a 1.8 m character, of the centre of mass and of the hips: means of
    the performances' percentiles, the greatest of all, and the share of the time over 6 m/s^2."""
    bodies, hips = [m.center_of_mass for m in measured], [m.hips for m in measured]
    return {
        "acceleration_p50": statistics.fmean(body.p50 for body in bodies),
        "acceleration_p99": statistics.fmean(body.p99 for body in bodies),
        "acceleration_p999": statistics.fmean(body.p999 for body in bodies),
        "acceleration_max": max(body.worst for body in bodies),
        "acceleration_over_6": statistics.fmean(body.over_6 for body in bodies),
        "hips_acceleration_over_6": statistics.fmean(each.over_6 for each in hips),
        "hips_acceleration_max": max(each.worst for each in hips),
    }


def _turns(measured: Sequence[core.MotionMeasures]) -> dict[str, float]:
    """The share of all joints in all frames that turn beyond what the takes show of them, and the worst."""
    return {
        "beyond_limits_share": statistics.fmean(m.turns.share for m in measured),
        "beyond_limits_degrees": math.degrees(max(m.turns.worst for m in measured)),
    }


def responses(character: core.Character, seeds: Iterable[int], **options: Any) -> dict[str, float]:
    """Half of all changes of velocity are answered within p50, 95 of 100 within p95, s, by players of these seeds; and
    the same of what is left of each answer's time without the time that a body needs for the change; and the share that
    is not answered at all. Changes of the stick that are none of what the character is able to do do not count."""
    quickest = _changes(character) * character.space.scale / _BODY
    seen = quickest > 0
    times = np.array([core.response_times(character, seed, **options)[seen] for seed in seeds])
    names = ("response_p50_s", "response_p95_s", *BEYOND_PHYSICS, "no_response_share")
    beyond, unanswered = times - quickest[seen], np.mean(times >= core.NO_RESPONSE)
    figures = [*np.percentile(times, [50, 95]), *np.percentile(beyond, [50, 95]), unanswered]
    return {name: float(figure) for name, figure in zip(names, figures)}


def _changes(character: core.Character) -> core.Doubles:
    """How much the velocity changes, m/s, in each of the core's response times: from each velocity to every other, as
    far as the character is able to do them."""
    space = character.space
    velocities = character.able(space.points.reshape(*space.shape, -1)[:, 0, 0])[:, :2]
    changes: core.Doubles = np.linalg.norm(velocities[:, None] - velocities[None], axis=2)
    different: core.Doubles = changes[~np.eye(len(changes), dtype=bool)]
    return different


STITCHINGS: dict[str, dict[str, Any]] = {
    "responsiveness 0": {"responsiveness": 0.0},
    "responsiveness 0.5 (default)": {},
    "responsiveness 1": {"responsiveness": 1.0},
    "feet not planted": {"lock_feet": False},
    "plain, as in the paper": {
        "stitching": "crossfade",
        "lock_feet": False,
        "root_adjustment": 0.0,
        "responsiveness": 1.0,
    },
}
"""Ways to play one and the same table."""


def measure_stitchings(
    character: core.Character, sessions: Sequence[Session], seed: int
) -> dict[str, dict[str, float]]:
    """What a viewer sees and what a player feels, by the way of playing; the takes' own figures first."""
    yardstick = core.MotionMetrics(character)
    found = {"the takes": _look([yardstick.takes], yardstick.takes.positions.p999)}
    for name, options in STITCHINGS.items():
        played = [core.Player(character, seed, **options).run(session.controls, RATE) for session in sessions]
        measured, follows = [yardstick.of(performance) for performance in played], errors([played])
        found[name] = {
            **_look(measured, max(m.positions.worst for m in measured)),
            **{key: float(follows[key] or 0) for key in ("velocity_error_percent", "drift_percent")},
            **responses(character, [seed], **options),
        }
    return found


def _look(measured: Sequence[core.MotionMeasures], joint_step: float) -> dict[str, float]:
    """Foot skate (m/s), sliding (share), the deepest foot (m), joint steps: of places (m), and the 99th percentiles of
    velocities (m/s) and accelerations (m/s^2), and turns beyond limits."""
    return {
        "foot_skate": statistics.fmean(m.foot_skate for m in measured),
        "sliding_share": statistics.fmean(m.sliding_share for m in measured),
        "penetration": max(m.penetration for m in measured),
        "joint_step": joint_step,
        "velocity_step_p99": statistics.fmean(m.velocities.p99 for m in measured),
        "acceleration_step_p99": statistics.fmean(m.accelerations.p99 for m in measured),
        **_turns(measured),
    }


def measure_run_time(
    character: core.Character, policies: Sequence[str], sessions: Sequence[Session], seed: int, **options: Any
) -> dict[str, dict[str, Any]]:
    """Each policy's figures, the percent of Optimal for each session among them as `by_trace`; `options` are the
    player's."""
    best = best_qualities(character, sessions)
    yardstick, seeds = core.MotionMetrics(character), range(seed, seed + PLAYERS)
    found: dict[str, dict[str, Any]] = {}
    for policy in policies:
        played = play(character, policy, sessions, seed, **options)
        percent = [100 * statistics.fmean(p.quality for p in some) / top for some, top in zip(played, best)]
        found[policy] = {
            "percent_of_optimal": statistics.fmean(percent),
            **errors(played),
            **following(played),
            **responses(character, seeds, policy=policy, **options),
            **looks(yardstick, played),
            **weight.trials(character, seeds, policy=policy, **options),
            "by_trace": dict(zip((session.name for session in sessions), percent)),
        }
    return found
