# SPDX-License-Identifier: MIT
"""The figures of a run as tables of text, for the terminal and for docs/evaluation.md."""

from __future__ import annotations

import math
import statistics
from collections.abc import Callable, Iterable
from typing import Any, NamedTuple

Result = dict[str, Any]
TITLES = {"greedy": "Greedy", "svm": "SVM", "iterate": "Iterate", "anticipate": "Anticipate", "optimal": "Optimal"}
HOLE = 0.3  # ControlDis: the core's synthesis and the add-on's panel count a control as performed within this


class Table(NamedTuple):
    """Cells as text; the first column is left-aligned."""

    title: str
    header: list[str]
    rows: list[list[str]]


def number(value: float | None, digits: int = 1) -> str:
    """A figure, or a dash where there is none."""
    return "-" if value is None else f"{value:.{digits}f}"


def duration(seconds: float) -> str:
    """Seconds, or milliseconds where they are few."""
    return f"{seconds:.2f} s" if seconds >= 1 else f"{1000 * seconds:.1f} ms"


def size(count: int | None) -> str:
    """Bytes as kB or MB."""
    if count is None:
        return "not measured"
    return f"{count / 1e6:.1f} MB" if count >= 1e6 else f"{count / 1e3:.0f} kB"


def title(name: str, result: Result) -> str:
    """A controller's name for people."""
    return f"{TITLES[name]} (default)" if name == result["default"] else TITLES[name]


def synthesis_table(result: Result) -> Table:
    """The paper's Table 1."""
    rows = [
        [
            title(name, result),
            "yes" if figures["online"] else "no",
            duration(figures["synthesis_seconds"]),
            size(figures["peak_bytes"]),
        ]
        for name, figures in result["controllers"].items()
    ]
    return Table("Synthesis of each controller", ["controller", "online", "time", "memory"], rows)


def trace_table(result: Result) -> Table:
    """Fig. 5: the controllers that learned from the first session, on each test."""
    names = list(result["adaptability"])
    columns = {name: result["adaptability"][name]["matrix"][0] for name in names}
    rows = [
        [test, *(number(columns[name][i]) for name in names), number(result["bound"][test])]
        for i, test in enumerate(result["test"])
    ]
    bound = statistics.fmean(result["bound"].values())
    rows.append(["mean", *(number(statistics.fmean(columns[name])) for name in names), number(bound)])
    heading = f"Percent of Optimal on each test, learned from {result['train'][0]}"
    return Table(heading, ["test", *(title(name, result) for name in names), "knows the player"], rows)


def adaptability_table(result: Result) -> Table:
    """Over all pairs of a session learned from and a test of another player."""
    rows = [
        [title(name, result), *(number(found[key]) for key in ("mean", "sd", "min", "max"))]
        for name, found in result["adaptability"].items()
    ]
    bound = list(result["bound"].values())
    spread = statistics.stdev(bound) if len(bound) > 1 else 0.0
    figures = (statistics.fmean(bound), spread, min(bound), max(bound))
    rows.append(["knows the player", *(number(figure) for figure in figures)])
    heading = "Percent of Optimal over all pairs of a training session and a test of another player"
    return Table(heading, ["controller", "mean", "sd", "least", "greatest"], rows)


def matrix_table(result: Result) -> Table:
    """The default policy: who it learned from (rows) and who was tested (columns)."""
    name = result["default"]
    rows = [
        [own, *(number(value) for value in row)]
        for own, row in zip(result["train"], result["adaptability"][name]["matrix"])
    ]
    return Table(f"{TITLES[name]}, percent of Optimal", ["learned from \\ tested on", *result["test"]], rows)


def _percent(share: float | None) -> float | None:
    return None if share is None else 100 * share


_RUN_TIME: tuple[tuple[str, Callable[[Result], str]], ...] = (
    ("of Optimal, %", lambda r: number(r["percent_of_optimal"])),
    ("velocity error, m/s", lambda r: number(r["velocity_error"], 2)),
    ("velocity error, %", lambda r: number(r["velocity_error_percent"])),
    ("turn error, deg/s", lambda r: number(r["turn_error"])),
    ("jump error, %", lambda r: number(_percent(r["jump_error"]))),
    ("response p50, s", lambda r: number(r["response_p50_s"], 2)),
    ("response p95, s", lambda r: number(r["response_p95_s"], 2)),
    ("no response, %", lambda r: number(_percent(r["no_response_share"]))),
    ("foot skate, x takes'", lambda r: number(r["foot_skate_ratio"], 2)),
    ("feet's turns, x takes'", lambda r: number(r["foot_turn_ratio"], 2)),
    ("joint step, x takes'", lambda r: number(r["joint_step_ratio"], 2)),
    ("sliding, %", lambda r: number(_percent(r["sliding_contact_share"]))),
    ("drift, %", lambda r: number(r["drift_percent"])),
    ("beyond limits, %", lambda r: number(_percent(r["beyond_limits_share"]), 2)),
    ("furthest, deg", lambda r: number(r["beyond_limits_degrees"], 0)),
)


def run_time_table(result: Result) -> Table:
    """The real player at 60 Hz."""
    rows = [
        [title(name, result), *(cell(figures["run_time"]) for _, cell in _RUN_TIME)]
        for name, figures in result["controllers"].items()
    ]
    heading = "The player at 60 frames a second (Optimal: 100 by definition)"
    return Table(heading, ["controller", *(head for head, _ in _RUN_TIME)], rows)


_ACCELERATIONS: tuple[tuple[str, Callable[[Result], str]], ...] = (
    ("p50", lambda r: number(r["acceleration_p50"], 2)),
    ("p99", lambda r: number(r["acceleration_p99"], 2)),
    ("p99.9", lambda r: number(r["acceleration_p999"], 2)),
    ("greatest", lambda r: number(r["acceleration_max"])),
    ("over 6, %", lambda r: number(_percent(r["acceleration_over_6"]), 2)),
    ("hips over 6, %", lambda r: number(_percent(r["hips_acceleration_over_6"]), 2)),
    ("hips, greatest", lambda r: number(r["hips_acceleration_max"])),
    ("response beyond physics p50, s", lambda r: number(r.get("response_beyond_physics_p50_s"), 2)),
    ("p95, s", lambda r: number(r.get("response_beyond_physics_p95_s"), 2)),
)


def acceleration_table(result: Result) -> Table:
    """How hard the body is pushed along the ground, beside the takes."""
    played = {title(name, result): each["run_time"] for name, each in result["controllers"].items() if each["online"]}
    rows = [
        [name, *(cell(figures) for _, cell in _ACCELERATIONS)]
        for name, figures in {"the takes": result["takes"], **played}.items()
    ]
    heading = "Acceleration along the ground over 0.2 s, m/s\u00b2: of the centre of mass, then of the hips"
    return Table(heading, ["", *(head for head, _ in _ACCELERATIONS)], rows)


_WEIGHT: tuple[tuple[str, Callable[[Result], str]], ...] = (
    ("yaw p50, deg/s\u00b2", lambda r: number(r["yaw_acceleration_p50"], 0)),
    ("p99", lambda r: number(r["yaw_acceleration_p99"], 0)),
    ("p99.9", lambda r: number(r["yaw_acceleration_p999"], 0)),
    ("greatest", lambda r: number(r["yaw_acceleration_max"], 0)),
    ("dip before a jump, m", lambda r: number(r["jump_dip"], 2)),
    ("x takes'", lambda r: number(r.get("jump_dip_ratio"), 2)),
    ("dip after it, m", lambda r: number(r["landing_dip"], 2)),
    ("x takes'", lambda r: number(r.get("landing_dip_ratio"), 2)),
    ("flight, x ballistic", lambda r: number(r["flight_time_ratio"], 2)),
    ("same foot, %", lambda r: number(_percent(r["same_foot"]))),
    ("quick steps, %", lambda r: number(_percent(r["quick_steps"]))),
    ("dragged, %", lambda r: number(_percent(r.get("dragged_share")))),
    ("speed ripple, x takes'", lambda r: number(r.get("speed_ripple_ratio"), 2)),
    ("hips' bob, x takes'", lambda r: number(r.get("bob_ratio"), 2)),
    ("steps a second, x takes'", lambda r: number(r.get("step_rate_ratio"), 2)),
    ("about-face, s", lambda r: number(r.get("about_face_s"), 2)),
)


def weight_table(result: Result) -> Table:
    """What else tells a body's weight, beside the takes."""
    played = {title(name, result): each["run_time"] for name, each in result["controllers"].items() if each["online"]}
    rows = [
        [name, *(cell(figures) for _, cell in _WEIGHT)]
        for name, figures in {"the takes": result["takes"], **played}.items()
    ]
    return Table("Weight: support, turns, jumps and steps", ["", *(head for head, _ in _WEIGHT)], rows)


_FOLLOWING: tuple[tuple[str, Callable[[Result], str]], ...] = (
    ("velocity error, %", lambda r: number(r["velocity_error_percent"])),
    ("drift, %", lambda r: number(r["drift"])),
    ("heading, deg", lambda r: number(r["drift_heading"])),
    ("limited: velocity error, %", lambda r: number(r["velocity_error_limited"])),
    ("drift, %", lambda r: number(r["drift_limited"])),
    ("heading, deg", lambda r: number(r["drift_heading_limited"])),
)


def following_table(result: Result) -> Table:
    """How well the command is followed, and the command as a body can follow it."""
    rows = [
        [title(name, result), *(cell(figures["run_time"]) for _, cell in _FOLLOWING)]
        for name, figures in result["controllers"].items()
        if figures["online"]
    ]
    heading = "Following the command, and the command limited to 5 m/s\u00b2"
    return Table(heading, ["controller", *(head for head, _ in _FOLLOWING)], rows)


def changes_table(result: Result) -> Table:
    """The default policy's accelerations after each kind of change."""
    found = result["controllers"][result["default"]]["run_time"]["acceleration_by_change"]
    rows = [
        [
            kind,
            *(number(each[key], 2) for key in ("p50", "p99", "p999", "max")),
            number(100 * each["over_6"], 2),
            number(_percent(each.get("dragged"))),
        ]
        for kind, each in found.items()
    ]
    heading = "Acceleration of the centre of mass within 1.5 s of a change of the command, m/s\u00b2"
    return Table(heading, ["change", "p50", "p99", "p99.9", "greatest", "over 6, %", "dragged, cm"], rows)


def speeds_table(result: Result) -> Table:
    """The default policy's speeds at commands held."""
    rows = [
        [
            number(row["speed"]),
            number(100 * row["mean"]),
            number(row["ripple"], 3),
            number(row["takes_ripple"], 3),
            number(100 * row["bob"]),
            number(_percent(row["takes_bob"])),
            number(row.get("steps")),
            number(row.get("takes_steps")),
            number(row["takes_speed"], 2),
        ]
        for row in result["controllers"][result["default"]]["run_time"]["speed_ripple"]
    ]
    header = [
        "commanded, m/s",
        "reached, %",
        "ripple, m/s",
        "takes' ripple, m/s",
        "bob, cm",
        "takes' bob, cm",
        "steps a second",
        "takes' steps a second",
        "at their speed, m/s",
    ]
    return Table("Speeds at commands held", header, rows)


_STITCHINGS: tuple[tuple[str, Callable[[Result], str]], ...] = (
    ("foot skate, m/s", lambda r: number(r["foot_skate"], 3)),
    ("sliding, %", lambda r: number(100 * r["sliding_share"])),
    ("deepest foot, mm", lambda r: number(1000 * r["penetration"], 0)),
    ("joint step, m", lambda r: number(r["joint_step"], 3)),
    ("velocity step, m/s", lambda r: number(r["velocity_step_p99"], 2)),
    ("acceleration step, m/s\u00b2", lambda r: number(r["acceleration_step_p99"], 0)),
    ("beyond limits, %", lambda r: number(100 * r["beyond_limits_share"], 2)),
    ("furthest, deg", lambda r: number(r["beyond_limits_degrees"], 0)),
    ("velocity error, %", lambda r: number(r.get("velocity_error_percent"))),
    ("drift, %", lambda r: number(r.get("drift_percent"))),
    ("response p50, s", lambda r: number(r.get("response_p50_s"), 2)),
    ("response p95, s", lambda r: number(r.get("response_p95_s"), 2)),
)


def stitchings_table(result: Result) -> Table:
    """The default table, played in different ways."""
    rows = [[name, *(cell(figures) for _, cell in _STITCHINGS)] for name, figures in result["stitchings"].items()]
    return Table("How it is played: what is seen, and what is felt", ["", *(head for head, _ in _STITCHINGS)], rows)


def coverage_table(result: Result) -> Table:
    """How many of the controls of each kind have a fragment near."""
    space = result["control_space"]
    kinds = [_kind_of(point, space["speeds"]) for point in space["points"]]
    performed = [distance <= HOLE for distance in result["coverage"]]
    rows = []
    for jump, turn in sorted({kind[:2] for kind in kinds}):
        cells = []
        for gait in range(1 + len(space["speeds"])):
            good = [well for kind, well in zip(kinds, performed) if kind == (jump, turn, gait)]
            cells.append(f"{sum(good)} of {len(good)}")
        rows.append([f"{'jump' if jump else 'no jump'}, {'turning' if turn else 'no turn'}", *cells])
    return Table(f"Controls with a fragment within ControlDis {HOLE}", ["", "stand", *space["gaits"]], rows)


def _kind_of(point: list[float], speeds: list[float]) -> tuple[bool, bool, int]:
    """Whether a control jumps, whether it turns, and whether it stands (0) or at which speed it goes (from 1)."""
    x, y, turn, jump = point
    speed = math.hypot(x, y)
    gait = min(range(len(speeds)), key=lambda i: abs(speed - speeds[i]))
    return jump > 0, turn != 0, 1 + gait if speed > 0 else 0


_CURVE = ("of Optimal, %", "quality a step", "velocity error, m/s", "build, s")


def _curve_cells(row: Result) -> list[str]:
    return [
        number(row["percent_of_optimal"]),
        number(row["quality_per_step"], 3),
        number(row["velocity_error"], 2),
        number(row["build_seconds"]),
    ]


def classes_table(result: Result) -> Table:
    """Against the number of classes."""
    rows = [[str(row["classes"]), *_curve_cells(row)] for row in result["classes_curve"]]
    return Table(f"{TITLES[result['default']]} against the number of classes", ["classes", *_CURVE], rows)


def minutes_table(result: Result) -> Table:
    """Against the minutes learned from, with the other policies' percents."""
    others = [name for name in ("iterate", "svm") if name != result["default"]]
    rows = [
        [f"{row['minutes']:.3g}", *_curve_cells(row), *(number(row["percents"][name]) for name in others)]
        for row in result["minutes_curve"]
    ]
    heading = f"{TITLES[result['default']]} against minutes of the simulated explorer learned from"
    return Table(heading, ["minutes", *_CURVE, *(f"{TITLES[name]}, %" for name in others)], rows)


def tables(result: Result) -> Iterable[Table]:
    """All tables that the run has figures for."""
    for make in (synthesis_table, trace_table, adaptability_table, matrix_table, run_time_table, acceleration_table):
        yield make(result)
    for make in (changes_table, weight_table, speeds_table, following_table, stitchings_table, coverage_table):
        yield make(result)
    if "likeness" in result:
        yield likeness_table(result)
    if "classes_curve" in result:
        yield classes_table(result)
        yield minutes_table(result)


def figures_table(result: Result) -> Table:
    """Every figure of the default policy's run time that is a number, by its name in the JSON file."""
    played = result["controllers"][result["default"]]["run_time"]
    rows = [
        [key, number(result["takes"].get(key), 4), number(figure, 4)]
        for key, figure in played.items()
        if not isinstance(figure, (dict, list))
    ]
    return Table("The player at 60 frames a second", ["", "the takes", title(result["default"], result)], rows)


LIKENESS = {
    "frechet": "Frechet distance of windows of 0.8 s",
    "nearest": "nearest window, x an unseen take's",
    "auc": "told apart by a classifier (AUC)",
    "successors": "stitches that stay in the take, share",
    "head_jerk": "head's jerk, x takes'",
    "hands_jerk": "hands' jerk, x takes'",
    "ball_travel": "vertical travel of a planted ball, mm",
    "ball_under": "its lowest place, 5th percentile, mm",
    "stances": "stances a second, x takes'",
    "steps": "steps a second, x takes'",
    "left_right": "longer of left and right step, x shorter",
    "sway": "hips' sway, x takes'",
    "ripple": "speed's ripple, x takes'",
    "whips": "bones that turn too fast, a minute",
}
"""The figures of likeness, for people."""


def likeness_table(result: Result) -> Table:
    """How like takes a character of other takes looks that re-enacts them."""
    takes, played = result["likeness"]["takes"], result["likeness"]["played"]
    rows = [[name, number(takes.get(key), 2), number(played[key], 2)] for key, name in LIKENESS.items()]
    heading = "Likeness: half of the takes re-enact the other half's velocity and turn"
    return Table(heading, ["", "the takes", title(result["default"], result)], rows)


def quick_tables(result: Result) -> Iterable[Table]:
    """What `--quick` measures."""
    for make in (figures_table, changes_table, speeds_table):
        yield make(result)
    if "likeness" in result:
        yield likeness_table(result)


def text(table: Table) -> str:
    """The table for a terminal."""
    lines = [table.header, *table.rows]
    widths = [max(len(line[i]) for line in lines) for i in range(len(table.header))]
    aligned = [
        "  ".join(
            cell.ljust(width) if i == 0 else cell.rjust(width) for i, (cell, width) in enumerate(zip(line, widths))
        )
        for line in lines
    ]
    return "\n".join([table.title, *(line.rstrip() for line in aligned)])


def summary(result: Result) -> str:
    """What was built."""
    space = result["control_space"]
    speeds = ", ".join(f"{gait} {speed:.2f} m/s" for gait, speed in zip(space["gaits"], space["speeds"]))
    return (
        f"{result['takes']['count']} takes, {result['fragments']} fragments ({result['captured']} not synthesized), "
        f"{result['classes']} classes, built in {result['build_seconds']:.1f} s; "
        f"{speeds}, turn {space['turn_rate']:.0f} degrees/s"
    )
