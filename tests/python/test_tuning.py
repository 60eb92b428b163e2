# SPDX-License-Identifier: MIT
"""`dev.py tune`: the search finds what is best, and the player's constants are what it changes."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path

import fragmotion_core as core
import numpy as np
import pytest

from tools.measuring.quality.sample import sample_recordings
from tools.measuring.tuning import inputs, objective
from tools.measuring.tuning.search import fit
from tools.measuring.tuning.sensitivity import TIMES, rises
from tools.shell import Failure


@pytest.fixture(scope="module")
def sample() -> core.Character:
    return core.build(*sample_recordings(), [core.simulate_trace("explorer", 60, 1)])


def test_the_search_finds_the_least_cost_and_never_more_than_it_began_with() -> None:
    best = {"a": 2.0, "b": 0.3, "c": 30.0}

    def cost(some: Mapping[str, float]) -> float:
        return sum(math.log(some[name] / best[name]) ** 2 for name in best)

    start = {"a": 1.0, "b": 0.5, "c": 20.0}
    found = fit(start, cost, 0.05, seed=0)
    assert found == pytest.approx(best, rel=0.01)
    assert fit(best, cost, 0.0001, seed=1) == best


def test_what_a_constant_is_worth_is_what_the_costs_rise_by_without_it() -> None:
    def costs(some: Mapping[str, float]) -> list[float]:
        return [10 + some["a"] + weight * abs(math.log(some["b"], TIMES)) + 0 * some["c"] for weight in (1.0, 3.0)]

    found = rises({"a": 5.0, "b": 1.0, "c": 7.0}, costs)
    assert np.allclose(found["a"], [(-4.5, 0), (45, 0)])
    assert np.allclose(found["b"], [(2, 1), (2, 1)]), "a standard error of two costs is half of their difference"
    assert np.allclose(found["c"], 0)


def test_a_cost_counts_each_figure_by_its_goal() -> None:
    at_goal = {**objective.AT_MOST, **objective.AT_ONE}
    assert objective.cost(at_goal) == pytest.approx(math.log(2))
    for name in at_goal:
        assert objective.cost({**at_goal, name: 2 * at_goal[name]}) > objective.cost(at_goal)
    for name, far in objective.AT_ONE.items():
        assert objective.cost({**at_goal, name: 1 / far}) == pytest.approx(objective.cost(at_goal))
    assert objective.cost({"nearest": objective.AT_MOST["nearest"]}) == pytest.approx(math.log(2))


def test_every_constant_changes_what_is_shown(sample: core.Character) -> None:
    traces = [core.simulate_trace(player, 60, 1, sample.space) for player in ("explorer", "twitcher", "runner")]
    options = core.PlayerOptions()
    usual = [core.Player(sample, options).run(trace, 60).rotations for trace in traces]

    def is_usual(constants: dict[str, float]) -> bool:
        return all(
            np.array_equal(core.Player(sample, constants=constants).run(trace, 60).rotations, shown)
            for trace, shown in zip(traces, usual)
        )

    for name, value in options.constants.items():
        assert not is_usual({name: value / 2}), name
    assert is_usual(options.constants)
    assert len(options.constants) <= 30


def test_constants_that_cannot_be_are_refused(sample: core.Character) -> None:
    with pytest.raises(ValueError, match='no constant "haste"'):
        core.Player(sample, constants={"haste": 1.0})
    for value in (0.0, -1.0, 1001.0, math.nan, math.inf):
        with pytest.raises(ValueError, match="the constant stitch_fades must be"):
            core.PlayerOptions(constants={"stitch_fades": value})


def test_a_set_without_takes_is_named(tmp_path: Path) -> None:
    with pytest.raises(Failure, match="there are no takes"):
        inputs.files_of(f"{tmp_path}/nothing*.bvh")
