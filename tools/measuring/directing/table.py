# SPDX-License-Identifier: MIT
"""The figures as tables."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from fragmotion_command.evaluate.report import Table

_PINS = ["asked, m", "left, mm", "left, degrees", "tries", "seconds"]
_MOVES = ["move", "waits, s", "joint step, of the takes'"]
_SPACES = ["speeds x directions", "controls", "of Optimal, %", "velocity error, m/s", "build, s"]
_STYLES = ["style", "% of Optimal", "built alone, %", "changes within, s", "joint step, of other stitches'"]
_GROUND = ["ground", "depth, cm", "within 2 cm, %", "longest beyond, s", "skating", "hips' acceleration", "thighs"]
_PATHS = ["path", "m/s", "mean distance, m", "greatest, m", "from the end, m", "from the time, s"]


def tables(result: Mapping[str, Any]) -> dict[str, Table]:
    """Paths, a path and speed a row, pins, moves, styles, ground, and control spaces where there are figures."""
    rows = [_space_row(row) for row in result.get("spaces", ())]
    measured = {"spaces": Table("Controls of its own", _SPACES, rows)} if rows else {}
    return {
        "paths": Table("Along paths", _PATHS, [_path_row(row) for row in result["paths"]]),
        "pins": Table("Pins", _PINS, [_pin_row(row) for row in result["pins"]]),
        "moves": Table("Moves", _MOVES, [_move_row(row) for row in result["moves"]]),
        "styles": Table("Styles", _STYLES, [_style_row(row) for row in result["styles"]]),
        "ground": Table("On the ground", _GROUND, [_ground_row(row) for row in result["ground"]]),
        **measured,
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


def _space_row(row: Mapping[str, Any]) -> list[str]:
    return [
        f"{row['speeds']} x {row['directions']}",
        str(row["controls"]),
        f"{row['percent_of_optimal']:.1f}",
        f"{row['velocity_error']:.2f}",
        f"{row['build_s']:.1f}",
    ]


def _style_row(row: Mapping[str, Any]) -> list[str]:
    return [
        row["name"],
        f"{row['percent_of_optimal']:.1f}",
        f"{row['alone']:.1f}",
        f"{row['change_s']:.2f}",
        f"{row['joint_step_ratio']:.2f}",
    ]


def _ground_row(row: Mapping[str, Any]) -> list[str]:
    return [
        row["name"],
        f"{100 * row['depth_m']:.1f}",
        f"{100 * row['within_2_cm']:.1f}",
        f"{row['late_s']:.2f}",
        f"{row['skate_ratio']:.2f}",
        f"{row['hips_ratio']:.2f}",
        f"{row['thigh_ratio']:.2f}",
    ]
