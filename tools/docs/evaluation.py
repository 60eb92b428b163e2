# SPDX-License-Identifier: MIT
"""The places of docs/evaluation.md, from the figures of a run of `fragmotion evaluate` and one of `dev.py beside`."""

from __future__ import annotations

import json
import re
import statistics
from collections.abc import Callable
from typing import Any

from fragmotion_command.evaluate import report
from fragmotion_command.evaluate.report import Table, number

from tools.docs.filling import fill, markdown
from tools.measuring.beside.table import beside_table
from tools.paths import TOP

Result = dict[str, Any]
PAGE = TOP / "docs" / "evaluation.md"
FIGURES = TOP / "docs" / "evaluation"
_PLAYERS = TOP / "cpp" / "src" / "make" / "control" / "simulated_players.cpp"
_PLAYER = re.compile(r'^ +\{"(\w+)", +(.*)\},$', re.MULTILINE)

# The paper's Table 1 and Sec. 4.
_PAPER_SYNTHESIS = {
    "greedy": ("8 s", "under 10 MB"),
    "svm": ("2.5 min", "10-20 MB"),
    "iterate": ("15 min", "over 100 MB"),
    "optimal": ("2 min", "under 10 MB"),
}
_PAPER_QUALITY = {"greedy": "about 40", "svm": "84 (81 to 90, sd 4.1)", "iterate": "88 (85 to 91, sd 1.7)"}


def short(result: Result) -> str:
    """The whole in a few sentences."""
    name = result["default"]
    found, played = result["adaptability"][name], result["controllers"][name]["run_time"]
    return f"""\
- {report.summary(result)}.
- The default policy reaches **{found["mean"]:.1f} %** of the best that was possible, as the paper measures it, on
  players that it did not learn from; in the least of all pairs, {found["min"]:.1f} %.
- Played at 60 frames a second, blends and delays included, it reaches {played["percent_of_optimal"]:.1f} % of what a
  player could who knew the session in advance. Its velocity is {played["velocity_error"]:.2f} m/s off the commanded one
  on average ({played["velocity_error_percent"]:.0f} % of the commanded speed).
- Half of all changes of the stick are answered within {played["response_p50_s"]:.2f} s, 95 of 100 within
  {played["response_p95_s"]:.2f} s."""


def traces(result: Result) -> str:
    """Fig. 5."""
    return markdown(report.trace_table(result))


def adaptability(result: Result) -> str:
    """Beside the paper's figures."""
    table = report.adaptability_table(result)
    papers = [_PAPER_QUALITY.get(name, "-") for name in result["adaptability"]] + ["-"]
    rows = [[*row, paper] for row, paper in zip(table.rows, papers)]
    return markdown(Table("", [*table.header, "paper"], rows))


def svm_least(result: Result) -> str:
    """The pair that the SVM does worst on."""
    percent, own, test = min(
        (value, own, test)
        for own, row in zip(result["train"], result["adaptability"]["svm"]["matrix"])
        for test, value in zip(result["test"], row)
        if own != test
    )
    return f"In this run it did worst on the {test} after learning from the {own}: {percent:.1f} %."


def limits(result: Result) -> str:
    """Where the default policy stays furthest below Optimal, and what stands in the way."""
    by_trace = result["controllers"][result["default"]]["percent_of_optimal"]["by_trace"]
    worst = min(by_trace, key=lambda test: by_trace[test])
    changes = result["sessions"]["test"][worst]["changes_a_second"]
    return (
        f"The hardest test is the {worst}, who changes the control {changes:.1f} times a second: "
        f"{by_trace[worst]:.1f} % of Optimal. Value iteration that counted how controls follow each other on that very "
        f"test reaches {result['bound'][worst]:.1f} %."
    )


def run_time(result: Result) -> str:
    """The player's figures."""
    return markdown(report.run_time_table(result))


def accelerations(result: Result) -> str:
    """How hard the body is pushed."""
    return markdown(report.acceleration_table(result))


def changes(result: Result) -> str:
    """How hard, after each kind of change."""
    return markdown(report.changes_table(result))


def weight(result: Result) -> str:
    """Support, turns, jumps and steps."""
    return markdown(report.weight_table(result))


def speeds(result: Result) -> str:
    """How even the default policy's speeds are."""
    return markdown(report.speeds_table(result))


def following(result: Result) -> str:
    """Against the command, and against what a body can do of it."""
    return markdown(report.following_table(result))


def stitchings(result: Result) -> str:
    """The ways to play."""
    return markdown(report.stitchings_table(result))


def coverage(result: Result) -> str:
    """Kinds of controls, and the furthest hole."""
    holes = sum(distance > report.HOLE for distance in result["coverage"])
    are = "is a hole" if holes == 1 else "are holes"
    return (
        f"{markdown(report.coverage_table(result))}\n\nIn this run {holes} of the 102 controls {are}; the furthest "
        f"has its nearest fragment at {max(result['coverage']):.2f}."
    )


def classes(result: Result) -> str:
    """Against the number of classes."""
    return markdown(report.classes_table(result))


def minutes(result: Result) -> str:
    """Against the minutes learned from."""
    return markdown(report.minutes_table(result))


def synthesis(result: Result) -> str:
    """Beside the paper's Table 1."""
    table = report.synthesis_table(result)
    papers = [_PAPER_SYNTHESIS.get(name, ("-", "-")) for name in result["controllers"]]
    rows = [[*row, *paper] for row, paper in zip(table.rows, papers)]
    seconds = {name: figures["synthesis_seconds"] for name, figures in result["controllers"].items()}
    ratio = float(f"{seconds['svm'] / seconds['iterate']:.2g}")
    return (
        f"{markdown(Table('', [*table.header, 'paper: time', 'paper: memory'], rows))}\n\n"
        f"SVM took {ratio:g} times as long as Iterate; in the paper it took a sixth."
    )


def players(result: Result) -> str:
    """The habits that the core's source gives, and what the test sessions show of them."""
    header = [
        "player",
        "stand",
        "walk",
        "run",
        "holds, s",
        "forward",
        "back",
        "turn",
        "left",
        "jumps a second",
        "lag, s",
    ]
    rows = []
    for name, numbers in _PLAYER.findall(_PLAYERS.read_text()):
        stand, walk, low, high, _, forward, back, _, turn, left, jumps, lag = map(float, numbers.split(","))
        shares = [stand, walk, 1 - stand - walk]
        rest = [f"{low:g}-{high:g}", *map(_share, (forward, back, turn, left)), f"{jumps:.2f}", f"{lag:.2f}"]
        seen = result["sessions"]["test"].get(name, {})
        rows.append([name, *map(_share, shares), *rest, number(seen.get("changes_a_second"))])
    return markdown(Table("", [*header, "changes a second (measured)"], rows))


def _share(share: float) -> str:
    return f"{100 * share:.0f} %"


def beside(result: Result) -> str:
    """The character beside motion matching."""
    return markdown(beside_table(result["beside"]))


def visited(result: Result) -> str:
    """How little one session shows."""
    counts = [session["visited"] for session in result["sessions"]["train"].values()]
    mean = statistics.fmean(counts)
    return f"One minute visits {min(counts)} to {max(counts)} of the 102 controls, {mean:.0f} on average."


_MADE: dict[str, Callable[[Result], str]] = {
    made.__name__: made
    for made in (
        short,
        traces,
        adaptability,
        svm_least,
        limits,
        run_time,
        accelerations,
        changes,
        weight,
        speeds,
        following,
        stitchings,
        coverage,
        classes,
        minutes,
        synthesis,
        players,
        visited,
        beside,
    )
}


def made() -> Callable[[str], str]:
    """What is made for each name, from the figures in docs/evaluation."""
    result = json.loads((FIGURES / "evaluation.json").read_text())
    result["beside"] = json.loads((FIGURES / "beside.json").read_text())
    return lambda name: _MADE[name](result)


if __name__ == "__main__":
    fill(PAGE, made())
