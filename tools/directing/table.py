# SPDX-License-Identifier: MIT
"""The figures as tables."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from tools.evaluate.report import Table

_PINS = ["asked, m", "left, mm", "left, degrees", "tries", "seconds"]
_MOVES = ["move", "waits, s", "joint step, of the takes'"]
_PATHS = ["path", "m/s", "mean distance, m", "greatest, m", "from the end, m", "from the time, s"]


def tables(result: Mapping[str, Any]) -> dict[str, Table]:
    """Paths, a path and speed a row, pins and moves."""
    return {
        "paths": Table("Along paths", _PATHS, [_path_row(row) for row in result["paths"]]),
        "pins": Table("Pins", _PINS, [_pin_row(row) for row in result["pins"]]),
        "moves": Table("Moves", _MOVES, [_move_row(row) for row in result["moves"]]),
    }


def _path_row(row: Mapping[str, Any]) -> list[str]:
    return [
        row["name"],
        f"{row['speed']:.1f}",
        f"{row['mean_m']:.3f}",
        f"{row['max_m']:.2f}",
        f"{row['arrival_m']:.2f}",
        f"{row['arrival_s']:+.2f}",
    ]


def _pin_row(row: Mapping[str, Any]) -> list[str]:
    return [
        f"{row['asked_m']:.1f}",
        f"{1000 * row['left_m']:.1f}",
        f"{row['left_degrees']:.2f}",
        str(row["tries"]),
        f"{row['seconds']:.2f}",
    ]


def _move_row(row: Mapping[str, Any]) -> list[str]:
    return [row["name"], f"{row['wait_s']:.2f}", f"{row['joint_step_ratio']:.2f}"]
