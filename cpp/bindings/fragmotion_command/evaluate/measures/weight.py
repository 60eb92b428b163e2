# SPDX-License-Identifier: MIT
"""Whether a character moves as a body that has a weight: what the ground can give, jumps, steps and even speeds, of the
player and of the takes by the same definitions, which the core's contracts tell."""

from __future__ import annotations

import math
import statistics
from collections.abc import Callable, Iterable, Sequence
from typing import Any

from ...core import core

Figures = dict[str, float | None]
SEEN = (
    "jump_dip",
    "landing_dip",
    "flight_time_ratio",
    "same_foot",
    "quick_steps",
    "dragged_share",
    "yaw_acceleration_p50",
    "yaw_acceleration_p99",
    "yaw_acceleration_p999",
    "yaw_acceleration_max",
)
"""What takes have, too."""
RATIOS = ("jump_dip_ratio", "landing_dip_ratio")
TRIALS = (
    "speed_ripple_ratio",
    "bob_ratio",
    "step_rate_ratio",
    "speed_ripple",
    "acceleration_by_change",
    "about_face_s",
)
"""What a player is put to the test for."""


def seen(measured: Sequence[core.MotionMeasures]) -> Figures:
    """Of motions: how far the hips dip before and after a jump's flight (m), and its
    time over a ballistic one's; shares of the steps, and of the feet's way; yaw accelerations over 0.2 s
    (degrees/s^2)."""
    steps = [m.footfalls for m in measured]
    count = sum(each.count for each in steps)
    yaw = [m.yaw for m in measured]
    return {
        "jump_dip": _of_jumps(measured, lambda jumps: jumps.dip),
        "landing_dip": _of_jumps(measured, lambda jumps: jumps.landing_dip),
        "flight_time_ratio": _of_jumps(measured, lambda jumps: jumps.flight_ratio),
        "same_foot": ratio(sum(each.same_foot for each in steps), count),
        "quick_steps": ratio(sum(each.quick for each in steps), count),
        "dragged_share": statistics.fmean(m.dragged_share for m in measured),
        "yaw_acceleration_p50": math.degrees(statistics.fmean(each.p50 for each in yaw)),
        "yaw_acceleration_p99": math.degrees(statistics.fmean(each.p99 for each in yaw)),
        "yaw_acceleration_p999": math.degrees(statistics.fmean(each.p999 for each in yaw)),
        "yaw_acceleration_max": math.degrees(max(each.worst for each in yaw)),
    }


def beside_takes(yardstick: core.MotionMetrics, measured: Sequence[core.MotionMeasures]) -> Figures:
    """`seen` of what was played, and its dips over those of the takes' jumps, where both jump."""
    takes, played = seen([yardstick.takes]), seen(measured)
    return {
        **played,
        "jump_dip_ratio": ratio(played["jump_dip"], takes["jump_dip"]),
        "landing_dip_ratio": ratio(played["landing_dip"], takes["landing_dip"]),
    }


def trials(character: core.Character, seeds: Iterable[int], **options: Any) -> dict[str, Any]:
    """What players of these seeds do when they are put to the test: how even their speeds are, how hard they change
    their motion, and how soon they turn round (s)."""
    every = list(seeds)
    return {
        **evenness(character, every, **options),
        "acceleration_by_change": _changes([core.change_pushes(character, seed, **options) for seed in every]),
        "about_face_s": statistics.fmean(
            float(core.about_face_times(character, seed, **options).mean()) for seed in every
        ),
    }


def evenness(character: core.Character, seeds: Iterable[int], **options: Any) -> dict[str, Any]:
    """How even the speeds and the hips' heights of players of these seeds are, and how often they step: means over the
    takes', and by speed."""
    speeds = _speeds([core.speed_ripples(character, seed, **options) for seed in seeds])
    return {
        "speed_ripple_ratio": _mean(ratio(row["ripple"], row["takes_ripple"]) for row in speeds),
        "bob_ratio": _mean(ratio(row["bob"], row["takes_bob"]) for row in speeds),
        "step_rate_ratio": _mean(ratio(row["steps"], row["takes_steps"]) for row in speeds),
        "speed_ripple": speeds,
    }


def _speeds(players: Sequence[Sequence[core.SpeedRipple]]) -> list[Figures]:
    """A row for each commanded speed, m/s of a 1.8 m character; `mean` is the speed reached over it."""
    return [
        {
            "speed": rows[0].commanded,
            "mean": statistics.fmean(row.speed for row in rows) / rows[0].commanded,
            "ripple": statistics.fmean(row.ripple for row in rows),
            "takes_ripple": _number(rows[0].takes_ripple),
            "bob": statistics.fmean(row.bob for row in rows),
            "takes_bob": _number(rows[0].takes_bob),
            "steps": statistics.fmean(row.steps for row in rows),
            "takes_steps": _number(rows[0].takes_steps),
            "takes_speed": _number(rows[0].takes_speed),
        }
        for rows in zip(*players)
    ]


def _changes(players: Sequence[dict[str, core.ChangePushes]]) -> dict[str, dict[str, float]]:
    """m/s^2 of a 1.8 m character, and a share, for each kind of change: as `accelerations`; and m that feet are dragged
    after one."""
    return {
        kind: {
            "p50": statistics.fmean(player[kind].p50 for player in players),
            "p99": statistics.fmean(player[kind].p99 for player in players),
            "p999": statistics.fmean(player[kind].p999 for player in players),
            "max": max(player[kind].worst for player in players),
            "over_6": statistics.fmean(player[kind].over_6 for player in players),
            "dragged": statistics.fmean(player[kind].dragged for player in players),
        }
        for kind in players[0]
    }


def ratio(figure: float | None, other: float | None) -> float | None:
    """None where there is no figure, or nothing to divide by."""
    return None if figure is None or not other else figure / other


def _number(figure: float) -> float | None:
    return None if math.isnan(figure) else figure


def _mean(figures: Iterable[float | None]) -> float | None:
    """Of those that are numbers."""
    known = [figure for figure in figures if figure is not None and not math.isnan(figure)]
    return statistics.fmean(known) if known else None


def _of_jumps(measured: Sequence[core.MotionMeasures], figure: Callable[[core.JumpMeans], float]) -> float | None:
    """The mean over all jumps."""
    known = [m.jumps for m in measured if not math.isnan(figure(m.jumps))]
    return ratio(sum(jumps.count * figure(jumps) for jumps in known), sum(jumps.count for jumps in known))
