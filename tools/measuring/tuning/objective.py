# SPDX-License-Identifier: MIT
"""What is made as small as can be: how far the figures of `fragmotion evaluate` are from what they are to be.

The cost of a character is the mean of log(1 + figure / goal) over the figures, where a figure that is best at 1 counts
by its logarithm. So halving any figure that is far beyond its goal is worth the same, and what is well within its goal
counts for little. The Frechet distance from unseen takes is told over that of the takes which the character was made
of, as that is large where takes are few."""

from __future__ import annotations

import math
import os
import statistics
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor

import fragmotion_core as core
from fragmotion_command.evaluate.likeness.reenacting import Likeness, reenact
from fragmotion_command.evaluate.loading import TEACHER, Recordings, Session, make_session, simulate_players
from fragmotion_command.evaluate.measures import curves, run_time, weight
from fragmotion_command.evaluate.measures.controllers import DEFAULT

from tools.measuring.quality.gate import off_one

Constants = Mapping[str, float]
Figures = dict[str, float]

AT_MOST: Mapping[str, float] = {
    "frechet_ratio": 4.0,
    "nearest": 1.6,
    "ball_travel": 12.0,
    "whips": 0.2,
    "velocity_error_limited": 9.0,
    "response_beyond_physics_p50_s": 0.15,
    "response_beyond_physics_p95_s": 0.45,
    "hips_acceleration_over_6": 0.01,
    "foot_skate_ratio": 0.75,
    "joint_step_ratio": 1.2,
    "same_foot": 0.01,
    "quick_steps": 0.005,
    "beyond_limits_share": 0.006,
}
"""Figures of which less is better, and what they are to be at most."""

AT_ONE: Mapping[str, float] = {
    "head_jerk": 1.2,
    "sway": 1.3,
    "ripple": 1.3,
    "stances": 1.1,
    "speed_ripple_ratio": 1.3,
    "bob_ratio": 1.3,
}
"""Figures over the takes' own, which are best at 1 as the gate for quality has it, and by what factor they may be
off."""

_CLASSES, _SECONDS = 97, 60.0
_TESTS = 1000  # how far the seeds of the sessions to play are from the teacher's


def cost(figures: Figures) -> float:
    """Of one character; what could not be told of its takes does not count."""
    parts = [max(0.0, figures[name]) / goal for name, goal in AT_MOST.items() if name in figures]
    parts += [off_one(figures[name]) / off_one(far) for name, far in AT_ONE.items() if figures.get(name, 0) > 0]
    return statistics.fmean(math.log1p(part) for part in parts)


class Character:
    """A set of takes, and the characters that are measured: one of all takes, and one of half of them."""

    def __init__(self, name: str, recordings: Recordings, seed: int) -> None:
        self.name, self._seed = name, seed
        teacher = make_session(TEACHER, core.simulate_trace(TEACHER, _SECONDS, seed), core.ControlSpace())
        self._whole = curves.build(recordings, teacher, _CLASSES, seed, [DEFAULT])
        self._yardstick = core.MotionMetrics(self._whole)
        self._tests: list[Session] = simulate_players(seed + _TESTS, self._whole.space)
        try:
            self._likeness: Likeness | None = Likeness(recordings)
        except ValueError:  # too few takes
            self._likeness = None
        else:
            self._half = curves.build(self._likeness.seen, teacher, _CLASSES, seed, [DEFAULT])

    def figures(self, constants: Constants) -> Figures:
        """The figures that count, of a player with these constants."""
        options = {"constants": dict(constants)}
        played = run_time.play(self._whole, DEFAULT, self._tests, self._seed, players=1, **options)
        found: dict[str, float | None] = {
            **run_time.following(played),
            **run_time.looks(self._yardstick, played),
            **run_time.responses(self._whole, [self._seed], **options),
            **weight.evenness(self._whole, [self._seed], **options),
        }
        if self._likeness:
            found.update(reenact(self._likeness, self._half, self._seed, **options))
            found["frechet_ratio"] = weight.ratio(found["frechet"], self._likeness.takes["frechet"])
        wanted = (*AT_MOST, *AT_ONE)
        known = {name: found.get(name) for name in wanted}
        return {name: figure for name, figure in known.items() if figure is not None}


def measure(characters: Sequence[Character], constants: Constants) -> list[Figures]:
    """Of each character, as many at a time as there are processors."""
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(lambda character: character.figures(constants), characters))


def mean_cost(figures: Sequence[Figures]) -> float:
    """Of all characters, which count alike."""
    return statistics.fmean(map(cost, figures))
