# SPDX-License-Identifier: MIT
"""The comparison as a table: a measure a row, a system a column."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from fragmotion_command.evaluate.report import Table

TAKES = "the takes"


class Row(NamedTuple):
    """A row's name, its figures' keys, which stand side by side, and their digits."""

    name: str
    keys: tuple[str, ...]
    digits: int = 1


ROWS = (
    Row("velocity error, control held, %", ("velocity_error_held_percent",)),
    Row("velocity error, whole, %", ("velocity_error_percent",)),
    Row("turn error, degrees/s", ("turn_error",)),
    Row("drift in 2 s, % / heading, degrees", ("drift_percent", "drift_heading")),
    Row("velocity error against the limited command, %", ("velocity_error_limited_percent",)),
    Row(
        "drift in 2 s against the limited command, % / heading, degrees",
        ("drift_limited_percent", "drift_heading_limited"),
    ),
    Row("response p50 / p95, s", ("response_p50_s", "response_p95_s"), 2),
    Row("hips' acceleration over 0.2 s, p99, m/s\u00b2", ("hips_acceleration_p99",)),
    Row("hips' acceleration of the fitting parabola, p99, m/s\u00b2", ("hips_curve_p99",)),
    Row("foot skate, of the takes'", ("foot_skate_ratio",), 2),
    Row("same foot twice / steps under 0.2 s, %", ("same_foot_percent", "quick_steps_percent")),
    Row("unlikeness to the takes", ("unlikeness",), 2),
    Row("re-enacting unseen takes: Frechet distance", ("frechet",), 2),
    Row("nearest window, of an unseen take's / told apart (AUC)", ("nearest", "auc"), 2),
    Row("head's jerk, of the takes'", ("head_jerk",), 2),
    Row("planted ball's travel / 5th percentile of its depth, mm", ("ball_travel", "ball_under")),
    Row("stances / sway / ripple, of the takes'", ("stances", "sway", "ripple"), 2),
    Row("bones that turn too fast, a minute", ("whips",)),
    Row("effective variety, s of mocap", ("variety_seconds",), 0),
    Row("\u00b5s a frame", ("microseconds_a_frame",)),
    Row("of these, the search", ("search_microseconds_a_frame",)),
    Row("memory, MB", ("memory_mb",), 0),
)


def beside_table(result: Mapping[str, Any]) -> Table:
    """Rows that no system has a figure for are left out."""
    columns: dict[str, Mapping[str, float]] = {**result["systems"], TAKES: result["takes"]}
    rows = [
        [row.name, *(_cell(figures, row) for figures in columns.values())]
        for row in ROWS
        if any(key in figures for figures in columns.values() for key in row.keys)
    ]
    return Table("Fragmotion beside motion matching", ["", *columns], rows)


def _cell(figures: Mapping[str, float], row: Row) -> str:
    cells = [f"{figures[key]:.{row.digits}f}" for key in row.keys if key in figures]
    return " / ".join(cells) if cells else "-"
