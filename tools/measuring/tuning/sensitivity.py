# SPDX-License-Identifier: MIT
"""What each constant is worth: by how much the cost rises where it is other than it is, one at a time."""

from __future__ import annotations

import math
import statistics
from collections.abc import Callable, Mapping, Sequence

TIMES = 10.0
"""As large as it is, and as small."""

Rise = tuple[float, float]


def rises(
    start: Mapping[str, float], costs: Callable[[Mapping[str, float]], Sequence[float]]
) -> dict[str, tuple[Rise, Rise]]:
    """By how much the costs of several characters rise where a constant is a tenth of what it is, and ten times as
    large: the mean and its standard error."""
    usual = costs(start)

    def rise(name: str, value: float) -> Rise:
        more = [cost - before for cost, before in zip(costs({**start, name: value}), usual)]
        return statistics.fmean(more), statistics.stdev(more) / math.sqrt(len(more))

    return {name: (rise(name, value / TIMES), rise(name, value * TIMES)) for name, value in start.items()}
