# SPDX-License-Identifier: MIT
"""Quality against the number of classes and against the length of the session that a character learns from."""

from __future__ import annotations

import argparse
import statistics
from collections.abc import Sequence
from typing import Any

from ...building import tell_controls
from ...core import core
from ..loading import TEACHER, Recordings, Session, core_failures, make_session
from . import run_time
from .controllers import DEFAULT, TRAINED

CLASSES = (20, 40, 60, 80, 97, 120, 160, 200, 250)
MINUTES = (1 / 6, 1 / 3, 1.0, 2.0, 5.0, 10.0)


def build(
    recordings: Recordings,
    session: Session,
    classes: int,
    seed: int,
    policies: Sequence[str],
    told: argparse.Namespace | None = None,
) -> core.Character:
    """A character that learned from one session, with the controls that a command line tells, or the paper's."""
    options = core.BuildOptions()
    if told:
        tell_controls(options, told)
    options.classes, options.seed, options.policies = classes, seed, list(policies)
    with core_failures(f"Building {classes} classes"):
        return core.build(*recordings, [session.controls], options)


def classes_curve(
    recordings: Recordings, teacher: Session, tests: Sequence[Session], fragments: int, options: argparse.Namespace
) -> list[dict[str, Any]]:
    """The default policy's figures for each number of classes that the fragments are enough for."""
    rows = []
    for classes in (n for n in CLASSES if n <= fragments):
        character = build(recordings, teacher, classes, options.seed, [DEFAULT], options)
        rows.append({"classes": classes, **measure_point(character, tests, options.seed)})
    return rows


def minutes_curve(
    recordings: Recordings, tests: Sequence[Session], space: core.ControlSpace, options: argparse.Namespace
) -> list[dict[str, Any]]:
    """The default policy's figures after so many minutes of the simulated explorer, and all policies' percents."""
    others = [test for test in tests if test.name != TEACHER] or tests
    rows = []
    for minutes in MINUTES:
        controls = core.simulate_trace(TEACHER, 60 * minutes, options.seed, space)
        session = make_session(TEACHER, controls, space)
        character = build(recordings, session, options.classes, options.seed, [DEFAULT, *TRAINED[:-1]], options)
        figures = measure_point(character, others, options.seed)
        rows.append({"minutes": minutes, **figures, "percents": _percents(character, others)})
    return rows


def measure_point(character: core.Character, tests: Sequence[Session], seed: int) -> dict[str, Any]:
    """Means over the tests for the policy that drives."""
    percents = [character.percent_of_optimal(test.controls) for test in tests]
    best = [character.optimal(test.controls)[1] / len(test.controls) for test in tests]
    played = run_time.play(character, character.policy, tests, seed)
    return {
        "percent_of_optimal": statistics.fmean(percents),
        "quality_per_step": statistics.fmean(percent / 100 * top for percent, top in zip(percents, best)),
        "velocity_error": run_time.errors(played)["velocity_error"],
        "build_seconds": character.report["seconds"],
    }


def _percents(character: core.Character, tests: Sequence[Session]) -> dict[str, float]:
    return {
        name: statistics.fmean(character.percent_of_optimal(test.controls, name) for test in tests)
        for name in character.policies
    }
