# SPDX-License-Identifier: MIT
"""Running the benchmarks of C++, and what they told."""

from __future__ import annotations

import json
import subprocess
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from tools.measuring.bench.units import UNITS

_REPEATS = 3
_FRAMES = "frame, "  # what is measured in turns, many times: ratios of these are judged
_LARGE = "large build"
_PASSES = (
    (
        f"--benchmark_filter={_FRAMES}",
        "--benchmark_enable_random_interleaving=true",
        "--benchmark_min_time=0.1",
        "--benchmark_repetitions=9",
    ),
    (f"--benchmark_filter=-{_FRAMES}|{_LARGE}", f"--benchmark_repetitions={_REPEATS}"),
    (f"--benchmark_filter={_LARGE}", f"--benchmark_repetitions={_REPEATS}"),  # alone: it tells a process's memory
)
_FAR_ERROR = "far crowd's error"


@dataclass(frozen=True)
class Growth:
    """Large pools by number of fragments, fitted by CPU seconds = factor * fragments^exponent."""

    fragments: list[int]
    seconds: list[float]
    cpu_seconds: list[float]
    peak_bytes: list[float]
    exponent: float
    r_squared: float


class Measured:
    """What the benchmarks told."""

    def __init__(self, runs: list[dict[str, Any]]) -> None:
        """Read Google Benchmark's runs; of several of one name the fastest counts."""
        self.seconds: dict[str, float] = {}
        self.cpu_seconds: dict[str, float] = {}
        self.whole: dict[str, Any] = {}
        self.asked: dict[str, float] = {}
        # By character, by how many frames a player steps at once: m/s off what is asked, and of feet that stand.
        self.off: dict[str, dict[int, tuple[float, float]]] = {}
        large: dict[int, list[tuple[float, float, float]]] = {}
        for run in runs:
            name, _, arguments = run["name"].partition("/")
            timed_by = "real_time" if arguments.endswith("real_time") else "cpu_time"  # which others disturb less
            seconds, cpu_seconds = (run[time] * UNITS[run["time_unit"]] for time in (timed_by, "cpu_time"))
            self.cpu_seconds[name] = min(cpu_seconds, self.cpu_seconds.get(name, float("inf")))
            if name == _LARGE:
                figures = (seconds, cpu_seconds, run["peak_bytes"])
                large.setdefault(int(arguments.partition("/")[0]), []).append(figures)
            elif name.endswith(_FAR_ERROR):
                off = self.off.setdefault(name.partition(" ")[0], {})
                off[int(arguments.partition("/")[0])] = run["off"], run["slides"]
            elif "asked" in run:
                self.asked[name] = run["asked"]
            elif seconds < self.seconds.get(name, float("inf")):
                self.seconds[name] = seconds
                self.whole = run if name == "whole build" else self.whole
        self.growth = _growth(large)


def _growth(large: dict[int, list[tuple[float, float, float]]]) -> Growth:
    fragments = sorted(large)
    # The fit is one of CPU time, which other programs on the machine disturb least.
    seconds, cpu_seconds, peaks = ([min(run[part] for run in large[count]) for count in fragments] for part in range(3))
    x, y = np.log(fragments), np.log(cpu_seconds)
    exponent, offset = np.polyfit(x, y, 1)
    unexplained = ((y - exponent * x - offset) ** 2).sum() / ((y - y.mean()) ** 2).sum()
    return Growth(fragments, seconds, cpu_seconds, peaks, float(exponent), float(1 - unexplained))


def measure_core(program: Path, policy: Path, folder: Path) -> Measured:
    """Run the benchmarks, on the character of this policy file, too; their data lie in the folder."""
    runs = [run for options in _PASSES for run in _runs([program, policy, folder, *options], folder)]
    return Measured([run for run in runs if run["run_type"] == "iteration"])


def _runs(command: list[str | Path], folder: Path) -> list[dict[str, Any]]:
    output = folder / "benchmarks.json"
    command = [*command, f"--benchmark_out={output}", "--benchmark_out_format=json"]
    answer = subprocess.run(command, capture_output=True, text=True, check=False)
    if answer.returncode != 0:
        raise SystemExit(f"{command[0]} failed with exit code {answer.returncode}:\n{answer.stderr}")
    runs: list[dict[str, Any]] = json.loads(output.read_text())["benchmarks"]
    return runs
