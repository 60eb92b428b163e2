# SPDX-License-Identifier: MIT
"""The character that retargeted takes make, and how good it is, as `fragmotion evaluate` measures it."""

from __future__ import annotations

from typing import NamedTuple

from ..core import core
from ..evaluate.loading import Recordings, core_failures, simulate_players
from ..evaluate.measures import run_time
from ..evaluate.measures.controllers import DEFAULT

CLASSES = 97
_FIGURES = ("percent_of_optimal", "velocity_error", "foot_skate_ratio")
_TEST_SEEDS = 1000  # how far the seeds of the test are from those of the training


class Made(NamedTuple):
    """A character, and its figures."""

    character: core.Character
    figures: dict[str, float]


def make_character(recordings: Recordings, seed: int) -> Made:
    """Build, taught by the simulated players' first, and measure with all of them."""
    first = _build(recordings, 1, seed, core.simulate_trace("explorer", 1))
    teacher = simulate_players(seed, first.space)[0]
    classes = min(CLASSES, len(first.labels) // 2)
    character = _build(recordings, classes, seed, teacher.controls)
    tests = simulate_players(seed + _TEST_SEEDS, character.space)
    played = run_time.measure_run_time(character, [DEFAULT], tests, seed)[DEFAULT]
    return Made(character, {"fragments": len(character.labels), **{name: played[name] for name in _FIGURES}})


def _build(recordings: Recordings, classes: int, seed: int, trace: core.Doubles) -> core.Character:
    options = core.BuildOptions()
    options.classes, options.seed, options.policies = max(1, classes), seed, [DEFAULT]
    with core_failures("The takes"):
        return core.build(*recordings, [trace], options)
