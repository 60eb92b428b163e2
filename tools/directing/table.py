# SPDX-License-Identifier: MIT
"""The figures as tables."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from tools.evaluate.report import Table

_HEADER = ["path", "m/s", "mean distance, m", "greatest, m", "from the end, m", "from the time, s"]


def paths_table(result: Mapping[str, Any]) -> Table:
    """A path and speed a row."""
    return Table("Along paths", _HEADER, [_path_row(row) for row in result["paths"]])


def _path_row(row: Mapping[str, Any]) -> list[str]:
    return [
        row["name"],
        f"{row['speed']:.1f}",
        f"{row['mean_m']:.3f}",
        f"{row['max_m']:.2f}",
        f"{row['arrival_m']:.2f}",
        f"{row['arrival_s']:+.2f}",
    ]
