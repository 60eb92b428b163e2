# SPDX-License-Identifier: MIT
"""The pictures of a run, drawn from what its JSON file holds."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from matplotlib import pyplot
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, Rectangle
from matplotlib.ticker import FixedLocator, NullLocator

from .report import HOLE, TITLES, Result

_COLOURS = {"greedy": "#999999", "svm": "#E69F00", "iterate": "#56B4E9", "anticipate": "#00735C"}
_LIGHT = ("svm", "iterate")  # on these, text is black
_BOUND = "#CC3311"
_STYLE: Any = {
    "font.size": 10,
    "font.family": "DejaVu Sans",
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": 11,
    "axes.axisbelow": True,
    "figure.dpi": 110,
    "savefig.dpi": 110,
    "legend.frameon": False,
}


def draw_all(result: Result, folder: Path) -> list[Path]:
    """Draw every picture that the run has figures for; returns the files."""
    matplotlib.use("Agg")
    drawings = {"traces": traces, "adaptability": adaptability, "run-time": run_time, "coverage": coverage}
    if "classes_curve" in result:
        drawings.update({"classes": classes, "minutes": minutes})
    folder.mkdir(parents=True, exist_ok=True)
    with pyplot.rc_context(_STYLE):
        return [_save(draw, result, folder / f"{name}.png") for name, draw in drawings.items()]


def _save(draw: Callable[[Result], Figure], result: Result, path: Path) -> Path:
    figure = draw(result)
    figure.savefig(path, metadata={"Software": None})
    pyplot.close(figure)
    return path


def traces(result: Result) -> Figure:
    """Fig. 5: percent of Optimal of each controller on each test."""
    names, tests = list(result["adaptability"]), result["test"]
    figure, axes = pyplot.subplots(figsize=(max(6.5, 2.5 + 0.95 * len(tests)), 4), layout="constrained")
    width = 0.8 / len(names)
    for i, name in enumerate(names):
        values = result["adaptability"][name]["matrix"][0]
        bars = axes.bar(
            np.arange(len(tests)) + (i - (len(names) - 1) / 2) * width,
            values,
            0.92 * width,
            color=_COLOURS[name],
            label=TITLES[name],
        )
        colour = "black" if name in _LIGHT else "white"
        axes.bar_label(bars, [f"{v:.1f}" for v in values], rotation=90, fontsize=8, padding=-26, color=colour)
    for i, test in enumerate(tests):
        axes.hlines(
            result["bound"][test], i - 0.45, i + 0.45, _BOUND, "dotted", lw=2, label="" if i else "knows the player"
        )
    axes.set_xticks(range(len(tests)), tests, **_rotation(tests))
    _percent_axis(axes)
    axes.set_title(f"Quality on each test; learned from {result['train'][0]}", loc="left")
    figure.legend(loc="outside lower center", ncols=len(names) + 1)
    return figure


def _rotation(names: Sequence[str]) -> dict[str, Any]:
    return {"rotation": 30, "ha": "right"} if max(map(len, names)) > 10 else {}


def _percent_axis(axes: Axes, label: str = "percent of Optimal") -> None:
    axes.set_ylim(0, 108)
    axes.set_yticks(range(0, 101, 20))
    axes.set_ylabel(label)
    axes.grid(axis="y", color="#DDDDDD")


def adaptability(result: Result) -> Figure:
    """A heat map for each policy that learns: who it learned from, and who was tested."""
    names = [name for name in result["adaptability"] if name != "greedy"]
    rows, columns = len(result["train"]), len(result["test"])
    size = (max(7.0, 1.4 + 0.42 * columns * len(names)), 2.4 + 0.4 * rows)
    figure, grid = pyplot.subplots(1, len(names), figsize=size, sharey=True, squeeze=False, layout="constrained")
    least = min(value for name in names for row in result["adaptability"][name]["matrix"] for value in row)
    floor = 10 * (least // 10)
    for axes, name in zip(grid[0], names):
        image = _heat_map(axes, result, name, floor)
    grid[0][0].set_ylabel("learned from")
    figure.colorbar(image, ax=grid[0], label="percent of Optimal", aspect=30, pad=0.01)
    figure.supxlabel("tested on (framed: the player learned from, in another session)", fontsize=10)
    return figure


def _heat_map(axes: Axes, result: Result, name: str, floor: float) -> Any:
    found = result["adaptability"][name]
    image = axes.imshow(found["matrix"], vmin=floor, vmax=100, cmap="viridis", aspect="auto")
    axes.set_title(f"{TITLES[name]}: mean {found['mean']:.1f}, sd {found['sd']:.1f}", fontsize=10)
    axes.set_xticks(range(len(result["test"])), result["test"], rotation=60, ha="right", rotation_mode="anchor")
    axes.set_yticks(range(len(result["train"])), result["train"])
    axes.spines[:].set_visible(False)
    for y, own in enumerate(result["train"]):
        for x, test in enumerate(result["test"]):
            value = found["matrix"][y][x]
            dark = value < floor + 0.6 * (100 - floor)
            axes.text(x, y, f"{value:.1f}", ha="center", va="center", fontsize=7, color="white" if dark else "black")
            if own == test:
                axes.add_patch(Rectangle((x - 0.47, y - 0.45), 0.94, 0.9, fill=False, color=_BOUND, lw=1.5))
    return image


_RUN_TIME = (
    ("percent_of_optimal", "Quality", "percent of Optimal", 1, "{:.0f}"),
    ("velocity_error", "Velocity error", "m/s", 1, "{:.2f}"),
    ("turn_error", "Turn error", "degrees/s", 1, "{:.0f}"),
    ("jump_error", "Jump error", "% of the time", 100, "{:.1f}"),
)


def run_time(result: Result) -> Figure:
    """The player's figures, a panel each."""
    figure, grid = pyplot.subplots(1, 5, figsize=(11, 3.2), layout="constrained")
    names = [name for name, figures in result["controllers"].items() if figures["online"]]
    played = {name: result["controllers"][name]["run_time"] for name in names}
    for axes, (key, heading, unit, factor, form) in zip(grid, _RUN_TIME):
        _bars(axes, [factor * played[name][key] for name in names], names, form)
        axes.set_title(heading, loc="left")
        axes.set_ylabel(unit)
    _percent_axis(grid[0])
    _bars(grid[-1], [played[name]["response_p50_s"] for name in names], names, "{:.2f}")
    _whiskers(grid[-1], [played[name]["response_p95_s"] for name in names])
    grid[-1].set_title("Response", loc="left")
    grid[-1].set_ylabel("s (bar: p50, line: p95)")
    return figure


def _bars(axes: Axes, values: list[float], names: list[str], form: str) -> None:
    bars = axes.bar(range(len(names)), values, 0.75, color=[_COLOURS[name] for name in names])
    axes.bar_label(bars, [form.format(value) for value in values], fontsize=8, padding=1)
    axes.set_xticks(range(len(names)), [TITLES[name] for name in names], rotation=45, ha="right", fontsize=9)
    axes.set_ylim(0, 1.12 * max(*values, 1e-9))


def _whiskers(axes: Axes, values: list[float]) -> None:
    axes.hlines(values, np.arange(len(values)) - 0.35, np.arange(len(values)) + 0.35, "black", lw=1.5)
    for i, value in enumerate(values):
        axes.text(i, value, f"{value:.2f}", ha="center", va="bottom", fontsize=8)
    axes.set_ylim(0, 1.12 * max(*values, 1e-9))


def coverage(result: Result) -> Figure:
    """Fig. 4 for every turn and jump: how near the nearest fragment is to each control, and how many there are."""
    points = result["control_space"]["points"]
    turns, jumps = sorted({point[2] for point in points}, reverse=True), sorted({point[3] for point in points})
    size, count = (3.2 * len(turns), 3.45 * len(jumps)), len(points)
    figure, grid = pyplot.subplots(len(jumps), len(turns), figsize=size, layout="constrained", squeeze=False)
    limit = 2 * HOLE
    for row, jump in enumerate(jumps):
        for column, turn in enumerate(turns):
            drawn = _coverage_panel(grid[row][column], result, int(turn), int(jump), limit)
    label = "ControlDis to the nearest fragment"
    figure.colorbar(drawn, ax=grid, label=label, extend="max", aspect=40, pad=0.02)
    holes = sum(distance > HOLE for distance in result["coverage"])
    figure.suptitle(
        f"The {count} controls (m/s; forward is up) and how many fragments are nearest to each.\n"
        f"Ringed: a hole, no fragment within {HOLE:g} ({holes} of {count})",
        fontsize=11,
    )
    return figure


def _coverage_panel(axes: Axes, result: Result, turn: int, jump: int, limit: float) -> Any:
    space = result["control_space"]
    indices = [i for i, point in enumerate(space["points"]) if tuple(point[2:]) == (turn, jump)]
    points = np.array([space["points"][i][:2] for i in indices])
    distances = np.array([result["coverage"][i] for i in indices])
    for speed in space["speeds"]:
        axes.add_patch(Circle((0, 0), speed, fill=False, color="#CCCCCC"))
    drawn = axes.scatter(points[:, 0], points[:, 1], s=260, c=distances, cmap="viridis_r", vmin=0, vmax=limit, zorder=2)
    holes = points[distances > HOLE]
    axes.scatter(holes[:, 0], holes[:, 1], s=380, facecolors="none", edgecolors=_BOUND, linewidths=2.2, zorder=3)
    for i, (x, y), distance in zip(indices, points, distances):
        colour = "white" if distance > 0.5 * limit else "black"
        count = str(result["coverage_counts"][i])
        axes.text(x, y, count, ha="center", va="center", fontsize=7, zorder=4, color=colour)
    turns = {1: "turning left", 0: "no turn", -1: "turning right"}
    axes.set_title(f"{turns[turn]}, {'jumping' if jump else 'no jump'}", fontsize=10)
    axes.set_aspect("equal")
    reach = 1.2 * space["run"]
    axes.set(xlim=(-reach, reach), ylim=(-reach, reach))
    return drawn


def classes(result: Result) -> Figure:
    """The default policy against the number of classes."""
    figure, grid = pyplot.subplots(1, 4, figsize=(11, 3), layout="constrained")
    rows = result["classes_curve"]
    _curves(grid, rows, [row["classes"] for row in rows], result["default"])
    for axes in grid:
        axes.set_xlim(0, None)
        axes.axvline(result["classes"], color="#BBBBBB", lw=1, zorder=0)
    figure.supxlabel("classes (grey line: this run's)", fontsize=10)
    return figure


def minutes(result: Result) -> Figure:
    """The default policy, and the others' quality, against the minutes learned from."""
    figure, grid = pyplot.subplots(1, 4, figsize=(11, 3), layout="constrained")
    rows = result["minutes_curve"]
    at = [row["minutes"] for row in rows]
    _curves(grid, rows, at, result["default"])
    for name in ("iterate", "svm"):
        grid[0].plot(at, [row["percents"][name] for row in rows], ".--", color=_COLOURS[name], label=TITLES[name])
    grid[0].legend(loc="lower right")
    for axes in grid:
        axes.set_xscale("log")
        axes.xaxis.set_major_locator(FixedLocator(at))
        axes.xaxis.set_minor_locator(NullLocator())
        axes.set_xticklabels(["10 s" if m < 0.2 else "20 s" if m < 0.5 else f"{m:g}" for m in at], fontsize=8)
    figure.supxlabel("learned from the simulated explorer: 10 s, 20 s, and minutes", fontsize=10)
    return figure


_CURVES = (
    ("percent_of_optimal", "Quality, percent of Optimal"),
    ("quality_per_step", "Quality a step (Eq. 2)"),
    ("velocity_error", "Velocity error at run time, m/s"),
    ("build_seconds", "Build, s"),
)


def _curves(grid: Sequence[Axes], rows: list[Result], at: list[float], name: str) -> None:
    for axes, (key, heading) in zip(grid, _CURVES):
        axes.plot(at, [row[key] for row in rows], ".-", lw=2.5, color=_COLOURS[name], label=TITLES[name])
        axes.set_title(heading, loc="left", fontsize=10)
        axes.set_ylim(0, 1.1 * max(max(row[key] for row in rows), 1e-9))
        axes.grid(axis="y", color="#DDDDDD")
    _percent_axis(grid[0], "")
