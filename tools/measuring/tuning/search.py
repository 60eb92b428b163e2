# SPDX-License-Identifier: MIT
"""CMA-ES (N. Hansen, "The CMA Evolution Strategy: A Tutorial", 2016) over the logarithms of the constants."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping

import cma

from tools.shell import say

_STEP = 0.2  # of the logarithm of a constant, to begin with
_FARTHEST = math.log(4)  # of a constant from what it was, either way


def fit(
    start: Mapping[str, float], cost: Callable[[Mapping[str, float]], float], minutes: float, seed: int
) -> dict[str, float]:
    """The constants of the least cost that are found within so many minutes, beginning with `start`."""
    names, end = sorted(start), time.monotonic() + 60 * minutes

    def constants(logarithms: list[float]) -> dict[str, float]:
        return {name: start[name] * math.exp(value) for name, value in zip(names, logarithms)}

    options = {"seed": seed + 1, "bounds": [-_FARTHEST, _FARTHEST], "verbose": -9}  # to cma, a seed of 0 is none
    strategy = cma.CMAEvolutionStrategy([0.0] * len(names), _STEP, options)
    best, least = dict(start), cost(start)
    say(f"to begin with: cost {least:.4f}")
    while time.monotonic() < end and not strategy.stop():
        tried = strategy.ask()
        costs = [cost(constants(each)) for each in tried]
        strategy.tell(tried, costs)
        if min(costs) < least:
            best, least = constants(tried[costs.index(min(costs))]), min(costs)
            say(f"generation {strategy.countiter}: cost {least:.4f}")
    return best
