# SPDX-License-Identifier: MIT
"""The controllers of the paper's Sec. 4: their tables, and what these reach of Optimal's quality."""

from __future__ import annotations

import statistics
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ...core import core
from ..loading import Session, Sessions

DEFAULT = "anticipate"
TRAINED = ("svm", "iterate", "anticipate")
TABLES = ("greedy", *TRAINED)
CONTROLLERS = (*TABLES, "optimal")


class Factors(NamedTuple):
    """What a controller is made from: the factors of Eq. 2, the classes as the SVM sees them, and the controls."""

    smoothness: core.Doubles
    match: core.Doubles
    features: core.Doubles
    space: core.ControlSpace

    def save(self, path: Path, **others: core.Ints) -> None:
        """Write them with other arrays to an .npz file."""
        space = [getattr(self.space, name) for name in ("turn_rate", "scale", "directions", "turns", "jumps")]
        factors = {
            "smoothness": self.smoothness,
            "match": self.match,
            "features": self.features,
            "speeds": self.space.speeds,
            "space": space,
        }
        arrays: dict[str, Any] = {**factors, **others}
        np.savez(path, **arrays)

    @staticmethod
    def of_arrays(arrays: Any) -> Factors:
        """From what `save` wrote."""
        turn_rate, scale, directions, turns, jumps = arrays["space"]
        space = core.ControlSpace(
            turn_rate=turn_rate,
            scale=scale,
            speeds=arrays["speeds"],
            directions=int(directions),
            turn=bool(turns),
            jump=bool(jumps),
        )
        return Factors(arrays["smoothness"], arrays["match"], arrays["features"], space)


def factors_of(character: core.Character) -> Factors:
    """The character's factors."""
    return Factors(character.smoothness, character.match, core.class_features(character), character.space)


def make_table(name: str, factors: Factors, traces: Sequence[core.Ints]) -> core.Ints:
    """The policy table [n,102] of one of TABLES, learned from traces of control indices."""
    smoothness, match, features, space = factors
    if name == "greedy":
        return core.greedy_table(smoothness, match)
    if name == "iterate":
        return core.iterate_table(smoothness, match, traces)
    if name == "anticipate":
        return core.anticipate_table(smoothness, match, traces)
    return core.svm_table(smoothness, match, traces, features, space)[0]


def percents(factors: Factors, table: core.Ints, sessions: Sequence[Session]) -> list[float]:
    """The table's quality on each session in percent of Optimal's."""
    return [core.percent_of_optimal(factors.smoothness, factors.match, table, session.indices) for session in sessions]


def percent_matrix(name: str, factors: Factors, sessions: Sessions) -> list[list[float]]:
    """Percent of Optimal: a row for each session learned from, a column for each test."""
    if name == "optimal":
        return [[100.0] * len(sessions.test) for _ in sessions.train]
    if name == "greedy":
        return [percents(factors, make_table(name, factors, []), sessions.test)] * len(sessions.train)
    return [percents(factors, make_table(name, factors, [s.indices]), sessions.test) for s in sessions.train]


def unseen(sessions: Sessions) -> list[list[bool]]:
    """Which tests [train][test] are of another player than the one learned from; with one to learn from, all."""
    alone = len(sessions.train) == 1
    return [[alone or own.name != test.name for test in sessions.test] for own in sessions.train]


def summarise(matrix: list[list[float]], counted: list[list[bool]]) -> dict[str, float]:
    """Mean, standard deviation, least and greatest of the pairs that count."""
    values = [value for row, marks in zip(matrix, counted) for value, mark in zip(row, marks) if mark]
    return {
        "mean": statistics.fmean(values),
        "sd": statistics.stdev(values) if len(values) > 1 else 0.0,
        "min": min(values),
        "max": max(values),
    }


def means_by_test(matrix: list[list[float]], counted: list[list[bool]]) -> list[float]:
    """For each test the mean over those who learned from another player."""
    columns = zip(zip(*matrix), zip(*counted))
    return [statistics.fmean(v for v, mark in zip(values, marks) if mark) for values, marks in columns]


def measure_quality(factors: Factors, sessions: Sessions) -> dict[str, dict[str, Any]]:
    """Each controller's percents of Optimal: the whole matrix, and over pairs of different players."""
    counted = unseen(sessions)
    found = {}
    for name in CONTROLLERS:
        matrix = percent_matrix(name, factors, sessions)
        by_test = dict(zip((s.name for s in sessions.test), means_by_test(matrix, counted)))
        found[name] = {**summarise(matrix, counted), "by_trace": by_test, "matrix": matrix}
    return found


def measure_bound(factors: Factors, tests: Sequence[Session]) -> dict[str, float]:
    """What value iteration reaches on each test when its control model was counted on that very test."""
    return {test.name: percents(factors, make_table("iterate", factors, [test.indices]), [test])[0] for test in tests}
