# SPDX-License-Identifier: MIT
"""What the baseline says, what is worse than it, and how it is written. Needs Python alone."""

from __future__ import annotations

import json
import math
import statistics
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, Union

from tools.paths import TOP

BASELINE = TOP / "tests" / "quality" / "baseline.json"
SEEDS = (1, 2, 3, 4)
ABOUT = (
    "Figures of `fragmotion evaluate --quick` on the sample's takes, which tools/measuring/quality/sample.py "
    "makes: mean, and spread (greatest less least), over seeds 1 to 4. A change may make no mean worse by more "
    "than its spread, or, of what is told by frames or counted, the least that can be told: "
    "tests/python/test_quality.py. `python3 -m tools.measuring.quality` compares; with --write 'why' it writes this "
    "anew, and under `lowered` each bar that is lower than it was, and why. A bar is the worst mean that passes; of a "
    "figure that is best at a value, how far from that it may be; of a ratio that is best at 1, its greatest "
    "|logarithm| (up to flight_time_ratio's row: how far from 1 it may be)."
)
LESS, MORE, LIKE = "less is better", "more is better", "best at 1"
Better = Union[str, float]
"""LESS, MORE, LIKE (a ratio over what it is to be: twice of it is as bad as half of it), or the value that is best."""

WORSE: Mapping[str, Better] = {
    "percent_of_optimal": MORE,
    "velocity_error_percent": LESS,
    "turn_error": LESS,
    "jump_error": LESS,
    "response_p50_s": LESS,
    "response_p95_s": LESS,
    "response_beyond_physics_p50_s": LESS,
    "response_beyond_physics_p95_s": LESS,
    "velocity_error_limited": LESS,
    "drift": LESS,
    "drift_limited": LESS,
    "drift_heading": LESS,
    "about_face_s": LESS,
    "foot_skate_ratio": LESS,
    "foot_turn_ratio": LESS,
    "sliding_contact_share": LESS,
    "joint_step_ratio": LESS,
    "beyond_limits_share": LESS,
    "beyond_limits_degrees": LESS,
    "acceleration_p99": LESS,
    "acceleration_p999": LESS,
    "acceleration_max": LESS,
    "acceleration_over_6": LESS,
    "hips_acceleration_over_6": LESS,
    "hips_acceleration_max": LESS,
    "yaw_acceleration_p99": LESS,
    "yaw_acceleration_p999": LESS,
    "yaw_acceleration_max": LESS,
    "jump_dip_ratio": LIKE,
    "landing_dip_ratio": LIKE,
    "flight_time_ratio": LIKE,
    "speed_ripple_ratio": LIKE,
    "bob_ratio": LIKE,
    "same_foot": LESS,
    "quick_steps": LESS,
    "frechet": LESS,
    "nearest": LESS,
    "auc": LESS,
    "successors": MORE,
    "head_jerk": LIKE,
    "hands_jerk": LIKE,
    "ball_travel": LESS,
    "ball_under": 0.0,
    "stances": LIKE,
    "steps": LIKE,
    "left_right": LESS,
    "sway": LIKE,
    "ripple": LIKE,
    "whips": LESS,
}
"""The figures, by their names in the JSON file of `fragmotion evaluate`, and what makes each of them better."""

_FRAME = 1 / 60  # s, by which times of response are told
_STEP = 0.5  # s, of which left ones are told over right ones
_A_MINUTE = 0.2  # whips, which are few: as many as are allowed
_GRAINS = {
    **{name: _FRAME for name in WORSE if name.startswith("response")},
    "left_right": _FRAME / _STEP,
    "whips": _A_MINUTE,
}
_DIGITS = 6  # of what is written
_ROUNDING = 1e-5  # of a figure, which is no change


class Spread(NamedTuple):
    """A figure over the seeds: its mean, and its greatest less its least value."""

    mean: float
    spread: float

    @staticmethod
    def of(values: Sequence[float]) -> Spread:
        """Of one value a seed."""
        return Spread(statistics.fmean(values), max(values) - min(values))


class Change(NamedTuple):
    """A figure's mean beside the baseline's."""

    name: str
    before: Spread
    now: Spread

    @property
    def worse(self) -> float:
        """By how much it is worse; below 0 where it is better."""
        return badness(self.now.mean, WORSE[self.name]) - badness(self.before.mean, WORSE[self.name])

    @property
    def fails(self) -> bool:
        """Whether it is worse than what may be."""
        return badness(self.now.mean, WORSE[self.name]) > bar(self.name, self.before) + self._rounding

    @property
    def lowers(self) -> bool:
        """Whether it may be worse from now on than before."""
        return bar(self.name, self.now) > bar(self.name, self.before) + self._rounding

    @property
    def kept(self) -> Change:
        """What a new baseline keeps: the former one where that would be lowered, though nothing fails."""
        return self._replace(now=self.before) if self.lowers and not self.fails else self

    @property
    def _rounding(self) -> float:
        return _ROUNDING * abs(self.before.mean)


def bar(name: str, spread: Spread) -> float:
    """How bad a figure's mean may be."""
    off = max(spread.spread, _GRAINS.get(name, 0.0))
    return badness(spread.mean, WORSE[name]) + (math.log1p(off / spread.mean) if WORSE[name] == LIKE else off)


def off_one(ratio: float) -> float:
    """How far a ratio is from 1: its |logarithm|."""
    return abs(math.log(ratio)) if ratio > 0 else math.inf


def badness(figure: float, better: Better) -> float:
    """The greater the worse: in the figure's own unit, or how far a ratio is from 1."""
    if better == LIKE:
        return off_one(figure)
    if isinstance(better, float):
        return abs(figure - better)
    return figure if better == LESS else -figure


def read_baseline(text: str) -> tuple[dict[str, Spread], list[dict[str, Any]]]:
    """The figures, and what was lowered."""
    baseline = json.loads(text)
    return {name: Spread(**row) for name, row in baseline["figures"].items()}, baseline["lowered"]


def changes(before: Mapping[str, Spread], now: Mapping[str, Spread]) -> list[Change]:
    """Of all figures that both have."""
    return [Change(name, before[name], now[name]) for name in WORSE if name in before and name in now]


def table(some: Sequence[Change]) -> str:
    """For people: those that fail are marked."""
    lines = [f"{'':2}{'figure':<32}{'baseline':>12}{'spread':>12}{'now':>12}{'worse by':>12}"]
    for change in some:
        worse = 0.0 if abs(change.worse) <= _ROUNDING * abs(change.before.mean) else change.worse
        numbers = "".join(f"{number:>12.4g}" for number in (*change.before, change.now.mean, worse))
        lines.append(f"{'!' if change.fails else '':2}{change.name:<32}{numbers}")
    return "\n".join(lines)


def lowered_bars(some: Sequence[Change], why: str) -> list[dict[str, Any]]:
    """A line for each bar that a new baseline lowers."""
    return [
        {
            "figure": change.name,
            "from": _rounded(abs(bar(change.name, change.before))),
            "to": _rounded(abs(bar(change.name, change.now))),
            "why": why,
        }
        for change in some
        if change.lowers
    ]


def written(now: Mapping[str, Spread], lowered: Sequence[Mapping[str, Any]]) -> str:
    """The file: a line for each figure and for each bar that was lowered."""
    rows = {name: {"mean": _rounded(now[name].mean), "spread": _rounded(now[name].spread)} for name in WORSE}
    figures = ",\n".join(f"  {json.dumps(name)}: {json.dumps(row)}" for name, row in rows.items())
    lines = ",\n".join(f"  {json.dumps(row, ensure_ascii=False)}" for row in lowered)
    more = f"[\n{lines}\n ]" if lowered else "[]"
    return f'{{\n "about": {json.dumps(ABOUT)},\n "figures": {{\n{figures}\n }},\n "lowered": {more}\n}}\n'


def _rounded(figure: float) -> float:
    return float(f"{figure:.{_DIGITS}g}")
