# SPDX-License-Identifier: MIT
"""What it is worth to have more speeds and directions, or fewer."""

from __future__ import annotations

import statistics
from typing import Any

import fragmotion_core as core
from fragmotion_command.evaluate.loading import SECONDS, TEACHER, Recordings, core_failures
from fragmotion_command.evaluate.measures.controllers import DEFAULT

SPACES = ((1, 4), (2, 8), (3, 8), (4, 16))
"""Speeds and directions, from the coarsest; the second is the paper's."""

_RATE = 60.0  # frames a second
_CLASSES = 97
_TEST_SEEDS = 1000  # from a seed to that of what is tested with


def spaces(recordings: Recordings, seed: int) -> list[dict[str, Any]]:
    """A row for each of SPACES: percent of Optimal, of simulated players who ask for what there is; the velocity error
    in m/s of the same players, who ask each character for what the finest has; and seconds that Build took."""
    characters = [_build(recordings, seed, *each) for each in SPACES]
    asked = _traces(characters[-1].space, seed)
    return [
        {
            "speeds": speeds,
            "directions": directions,
            "controls": len(character.space.points),
            "percent_of_optimal": _percent(character, seed),
            "velocity_error": _velocity_error(character, asked),
            "build_s": character.report["seconds"],
        }
        for (speeds, directions), character in zip(SPACES, characters)
    ]


def _build(recordings: Recordings, seed: int, speeds: int, directions: int) -> core.Character:
    options = core.BuildOptions()
    options.classes, options.seed, options.policies = _CLASSES, seed, [DEFAULT]
    options.speeds, options.directions = speeds, directions
    with core_failures(f"Building {speeds} speeds and {directions} directions"):
        return core.build(*recordings, [core.simulate_trace(TEACHER, SECONDS, seed, options.usual_space)], options)


def _traces(space: core.ControlSpace, seed: int) -> list[core.Doubles]:
    return [core.simulate_trace(player, SECONDS, seed + _TEST_SEEDS, space) for player in core.PLAYERS]


def _percent(character: core.Character, seed: int) -> float:
    return statistics.fmean(character.percent_of_optimal(trace) for trace in _traces(character.space, seed))


def _velocity_error(character: core.Character, traces: list[core.Doubles]) -> float:
    return statistics.fmean(core.Player(character).run(trace, _RATE).velocity_error for trace in traces)
