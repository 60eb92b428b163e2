# SPDX-License-Identifier: MIT
"""Compare the core's stages (Google Benchmark) with NumPy and scikit-learn: same run, same data, results compared.
Then how time grows with the number of fragments, and each of the project's goals beside its figure.

Frames are measured on the benchmark's own small character, and on a large one of the sample's takes or those of
`--takes`, of whose policy file is told what it keeps of them.

python -m tools.measuring.bench PROGRAM [--takes MOCAP...] [--json FILE], from the top folder, with NumPy and
scikit-learn.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from fragmotion_command.evaluate.loading import read_recordings
from numpy.typing import NDArray

from tests.reference import numpy_build as reference
from tools.measuring.quality.sample import sample_recordings
from tools.measuring.stored import Stored, measure_stored, policy_of

Arrays = dict[str, NDArray[Any]]
Stage = Callable[[Arrays], tuple[float, str]]

_UNITS = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}
_UNIT = 0.01  # m of a BVH file's numbers
_ENOUGH = 1.0  # s: a reference that took less is measured again
_REPEATS = 3
_FRAMES = 200  # of the NumPy player
_DECISIONS = 200  # of NumPy
_LARGE = "large build"
_FRAME_GOALS = {"free": 1e-6, "locked": 2e-6}  # s, under a stick that is held
_RESTLESS = 1.3  # times that for one that is not
_ASKED = 8  # times that a player's step asks for the ground at most
_CROWDS = ("crowd step", "crowd step, two threads")  # 10,000 players
_FAR_CROWD = "far crowd step"  # 50,000
_FAR_ERROR = "far crowd's error"


@dataclass(frozen=True)
class Row:
    """One stage; `seconds` are the core's."""

    name: str
    seconds: float
    reference: str
    reference_seconds: float
    ratio: float


@dataclass(frozen=True)
class Growth:
    """Large pools by number of fragments, fitted by CPU seconds = factor * fragments^exponent."""

    fragments: list[int]
    seconds: list[float]
    cpu_seconds: list[float]
    peak_bytes: list[float]
    exponent: float
    r_squared: float


@dataclass(frozen=True)
class Goal:
    """A figure and what it is to be: at most `limit`, or at least where `more` is better."""

    name: str
    figure: float
    limit: float
    shown: Callable[[float], str]
    more: bool = False

    @property
    def met(self) -> bool:
        return self.figure >= self.limit if self.more else self.figure <= self.limit


class Measured:
    """What the benchmarks told."""

    def __init__(self, runs: list[dict[str, Any]]) -> None:
        """Read Google Benchmark's runs; of several of one name the fastest counts."""
        self.seconds: dict[str, float] = {}
        self.whole: dict[str, Any] = {}
        self.asked: dict[str, float] = {}
        self.off: dict[int, float] = {}  # by how many frames a player steps at once: m
        large: dict[int, list[tuple[float, float, float]]] = {}
        for run in runs:
            name, _, arguments = run["name"].partition("/")
            timed_by = "real_time" if arguments.endswith("real_time") else "cpu_time"  # which others disturb less
            seconds = run[timed_by] * _UNITS[run["time_unit"]]
            if name == _LARGE:
                figures = (seconds, run["cpu_time"] * _UNITS[run["time_unit"]], run["peak_bytes"])
                large.setdefault(int(arguments.partition("/")[0]), []).append(figures)
            elif name == _FAR_ERROR:
                self.off[int(arguments.partition("/")[0])] = run["off"]
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
    output = folder / "benchmarks.json"
    options = [f"--benchmark_out={output}", "--benchmark_out_format=json", f"--benchmark_repetitions={_REPEATS}"]
    answer = subprocess.run([program, policy, folder, *options], capture_output=True, text=True, check=False)
    if answer.returncode != 0:
        raise SystemExit(f"{program} failed with exit code {answer.returncode}:\n{answer.stderr}")
    runs = json.loads(output.read_text())["benchmarks"]
    return Measured([run for run in runs if run["run_type"] == "iteration"])


def timed(work: Callable[[], Any]) -> tuple[float, Any]:
    """The shortest of a few runs in seconds, and the result."""
    best, result = float("inf"), None
    for _ in range(_REPEATS):
        start = time.perf_counter()
        result = work()
        best = min(best, time.perf_counter() - start)
        if best > _ENOUGH:
            break
    return best, result


# The stages in NumPy: seconds, and how their results compare with the core's.


def _trajectories(data: Arrays) -> tuple[float, str]:
    seconds, (whole, first, last) = timed(
        lambda: reference.trajectories(_body(data), _motion(data), data["ranges"], data["played"])
    )
    ours = np.moveaxis(data["trajectories"], 1, 2)[:, : whole.shape[1]]
    data.update(whole=whole, first=first, last=last)
    return seconds, f"largest difference {np.abs(whole - ours).max() * 1e3:.4f} mm"


def _cluster(data: Arrays) -> tuple[float, str]:
    points, classes = data["whole"].astype(np.float32), len(data["representatives"])
    restarts = int(data["restarts"][0])
    seconds, (_, _, inertia) = timed(lambda: reference.cluster(points, classes, restarts=restarts))
    return seconds, f"inertia: core {data['inertia'][0]:.0f}, NumPy {inertia:.0f}"


def _k_means(data: Arrays) -> tuple[float, str]:
    from sklearn.cluster import KMeans

    points, classes = data["whole"].astype(np.float32), len(data["representatives"])
    model = KMeans(classes, n_init=int(data["restarts"][0]), random_state=1)
    seconds, _ = timed(lambda: model.fit(points.reshape(len(points), -1)))
    means = [points[model.labels_ == k].mean(axis=0) for k in range(classes)]
    own = [reference.distances(points[model.labels_ == k], mean[None]) for k, mean in enumerate(means)]
    inertia = sum(float((apart**2).sum()) for apart in own)
    return seconds, f"inertia under Dis: core {data['inertia'][0]:.0f}, scikit-learn {inertia:.0f}"


def _quality(data: Arrays) -> tuple[float, str]:
    chosen = data["representatives"]
    first, last, evident = (data[name][chosen] for name in ("first", "last", "evident"))
    seconds, (smoothness, match) = timed(
        lambda: reference.quality_table(first, last, evident, data["points"], data["control_weights"])
    )
    worst = max(np.abs(smoothness - data["smoothness"]).max(), np.abs(match - data["match"]).max())
    return seconds, f"largest difference {worst:.0e}"


def _optimal(data: Arrays) -> tuple[float, str]:
    seconds, (_, quality) = timed(lambda: reference.optimal_path(data["smoothness"], data["match"], data["trace"]))
    return seconds, f"total quality: core {data['optimal'][0]:.6f}, NumPy {quality:.6f}"


def _svm(data: Arrays) -> tuple[float, str]:
    seconds, (table, c, gamma, accuracy) = timed(
        lambda: reference.svm_table(
            data["smoothness"], data["match"], data["trace"], data["features"], data["points"], data["control_weights"]
        )
    )
    same = (table == data["svm_table"]).mean()
    return seconds, f"{same:.2%} of the table equal; C {c:g}, gamma {gamma:g}, cross-validated accuracy {accuracy:.1%}"


def _iterate(data: Arrays) -> tuple[float, str]:
    seconds, table = timed(lambda: reference.iterate_table(data["smoothness"], data["match"], [data["trace"]]))
    return seconds, f"{(table == data['iterate_table']).mean():.2%} of the table equal"


def _decision(data: Arrays) -> tuple[float, str]:
    controls = np.random.default_rng(1).uniform([-4, -4, -1.2, 0], [4, 4, 1.2, 1], (_DECISIONS, 4))
    table, points, weights = data["iterate_table"], data["points"], data["control_weights"]
    seconds, _ = timed(lambda: [reference.decide(table, 0, control, points, weights) for control in controls])
    return seconds / _DECISIONS, "the nearest of the 102 points, and the table's next class"


def _player_frame(data: Arrays) -> tuple[float, str]:
    motion, offset = _motion(data), np.zeros(3)
    frames = [10 + 0.5 * k for k in range(_FRAMES)]
    seconds, _ = timed(
        lambda: [reference.player_frame(motion, at, at + 20, 0.5, 0.3, offset) for at in frames],
    )
    return seconds / _FRAMES, "a frame in the middle of a stitch; the core's: all frames, and the places of all bones"


def _body(data: Arrays) -> reference.Body:
    return reference.Body(
        data["parents"], data["offsets"], data["tips"], data["measured"], scale=float(data["scale"][0])
    )


def _motion(data: Arrays) -> reference.Motion:
    return reference.Motion(data["root_positions"], data["rotations"], data["headings"])


_STAGES: dict[str, tuple[str, str, Stage]] = {
    "trajectories": ("trajectories", "NumPy", _trajectories),
    "cluster": ("cluster", "NumPy", _cluster),
    "cluster, Euclidean": ("cluster", "scikit-learn KMeans", _k_means),
    "quality table": ("quality table", "NumPy", _quality),
    "optimal": ("optimal", "NumPy", _optimal),
    "svm": ("svm", "scikit-learn SVC", _svm),
    "iterate": ("iterate", "NumPy", _iterate),
    "decision": ("decision", "NumPy", _decision),
    "player frame": ("player frame", "NumPy", _player_frame),
}
_WHOLE = ("trajectories", "quality table", "optimal", "iterate")  # and the faster of both ways to cluster
_CLUSTER = ("cluster", "cluster, Euclidean")


def compare(core: dict[str, float], data: Arrays) -> tuple[list[Row], dict[str, str]]:
    """Measure every stage's reference; the rows, and a remark on the results of each."""
    rows, remarks = [], {}
    for name, (measured, library, stage) in _STAGES.items():
        seconds, remarks[name] = stage(data)
        rows.append(Row(name, core[measured], library, seconds, seconds / core[measured]))
    clustered = min((row for row in rows if row.name in _CLUSTER), key=lambda row: row.reference_seconds)
    whole = clustered.reference_seconds + sum(row.reference_seconds for row in rows if row.name in _WHOLE)
    rows.append(Row("whole build", core["whole build"], "NumPy, scikit-learn", whole, whole / core["whole build"]))
    stages = ", ".join((clustered.name, *_WHOLE))
    remarks["whole build"] = f"reference: {stages}; without cutting, mirroring and synthesis, as the core's has"
    return rows, remarks


def goals(rows: list[Row], measured: Measured, stored: Stored) -> list[Goal]:
    """The project's goals, for two cores, beside what was measured."""
    core, growth = {row.name: row for row in rows}, measured.growth
    return [
        Goal("whole build", core["whole build"].seconds, 0.12, _duration),
        Goal("whole build against the reference", core["whole build"].ratio, 30, "{:.1f}x".format, more=True),
        Goal("iterate", core["iterate"].seconds, 0.01, _duration),
        Goal("optimal", core["optimal"].seconds, 0.0005, _duration),
        Goal("decision", core["decision"].seconds, 50e-9, _duration),
        *_frame_goals(measured),
        Goal("step of a crowd of 10000", measured.seconds[_CROWDS[0]], 1 / 60, _duration),
        Goal("step of a crowd of 50000 by distance", measured.seconds[_FAR_CROWD], 1 / 60, _duration),
        Goal("crowd's gain by a second thread", _gain(measured), 1.8, "{:.2f}x".format, more=True),
        Goal(f"{growth.fragments[-1]} fragments", growth.seconds[-1], 6, _duration),
        Goal(f"memory of {growth.fragments[-1]} fragments", growth.peak_bytes[-1], 480e6, _megabytes),
        Goal("exponent of CPU time over fragments", growth.exponent, 1.1, "{:.2f}".format),
        Goal("motion data, bytes a rotation", stored.bytes_a_rotation, 2, "{:.2f}".format),
        Goal("its error at bones' ends", stored.off, 1e-4, "{:.1e} m".format),
        Goal(f"policy file of {stored.takes} takes", stored.file_bytes, 2.6e6, "{:.0f} bytes".format),
        Goal("its load", stored.load_seconds, 5e-3, _duration),
    ]


def _frame_goals(measured: Measured) -> list[Goal]:
    """Of a frame of both characters, under a stick that is held and under a restless one, and of one on stairs."""
    listed = []
    for character in ("small", "large"):
        for feet, limit in _FRAME_GOALS.items():
            frame = f"{character} frame, {feet}"
            held, restless = measured.seconds[f"{frame}, held"], measured.seconds[f"{frame}, restless"]
            listed.append(Goal(f"{frame}, held", held, limit, _nanoseconds))
            listed.append(Goal(f"{frame}, restless over held", restless / held, _RESTLESS, "{:.2f}x".format))
        asked = measured.asked[f"{character} on stairs"]
        listed.append(Goal(f"{character} on stairs, ground asked for at most", asked, _ASKED, "{:.0f} times".format))
    return listed


def show(rows: list[Row], remarks: dict[str, str], measured: Measured, data: Arrays, stored: Stored) -> None:
    """Print the table."""
    print(
        f"{len(data['ranges'])} fragments, {len(data['representatives'])} classes, {len(data['points'])} controls, "
        f"{len(data['trace'])} samples, {len(data['parents'])} bones; {os.cpu_count()} CPUs, "
        f"load {os.getloadavg()[0]:.1f}\n"
    )
    print(f"{'stage':<20} {'core':>10} {'reference':>10} {'ratio':>8}  by")
    for row in rows:
        figures = f"{_duration(row.seconds):>10} {_duration(row.reference_seconds):>10} {row.ratio:>7.1f}x"
        print(f"{row.name:<20} {figures}  {row.reference}: {remarks[row.name]}")
    whole = measured.whole
    stages = [key for key in whole if key.endswith("_seconds")]
    parts = ", ".join(f"{key.partition('_')[0]} {_duration(whole[key])}" for key in stages)
    cpu = _duration(whole["cpu_time"] * _UNITS[whole["time_unit"]])
    print(f"\nWhole build: {whole['fragments']:.0f} fragments ({whole['captured']:.0f} not synthesized), {cpu} of CPU")
    print(f"The fastest one's stages: {parts}")
    show_growth(measured.growth)
    far = ", ".join(f"every {frames}. frame {off:.3f} m" for frames, off in sorted(measured.off.items()))
    print(f"\nPlayers that step in some frames, without held feet, are off there: {far} (median of all bones)")
    show_goals(goals(rows, measured, stored))


def show_growth(growth: Growth) -> None:
    """Print how time and memory grow."""
    print(f"\n{'fragments':>10} {'build':>10} {'CPU':>10} {'peak':>10}  of classes, quality, Optimal, default policy")
    for fragments, seconds, cpu, peak in zip(growth.fragments, growth.seconds, growth.cpu_seconds, growth.peak_bytes):
        print(f"{fragments:>10} {_duration(seconds):>10} {_duration(cpu):>10} {_megabytes(peak):>10}")
    print(f"CPU time grows as fragments^{growth.exponent:.2f} (R^2 {growth.r_squared:.4f})")


def show_goals(listed: list[Goal]) -> None:
    """Print each goal beside its figure."""
    print(f"\n{'goal':<38} {'measured':>10}")
    for goal in listed:
        limit = f"at {'least' if goal.more else 'most'} {goal.shown(goal.limit)}"
        print(f"{goal.name:<38} {goal.shown(goal.figure):>10}  {limit:<18} {'met' if goal.met else 'NOT MET'}")


def _gain(measured: Measured) -> float:
    one, two = (measured.seconds[name] for name in _CROWDS)
    return one / two


def _nanoseconds(seconds: float) -> str:
    return f"{seconds * 1e9:.0f} ns"


def _megabytes(count: float) -> str:
    return f"{count / 1e6:.0f} MB"


def _duration(seconds: float) -> str:
    unit = next((unit for unit in ("s", "ms", "us") if seconds >= _UNITS[unit]), "ns")
    return f"{seconds / _UNITS[unit]:.3g} {unit}"


def main(arguments: list[str]) -> None:
    """Measure, print, and save where asked."""
    parser = argparse.ArgumentParser(prog="tools.measuring.bench", description=__doc__)
    parser.add_argument("program", type=Path, help="the Google Benchmark program")
    parser.add_argument("--takes", type=Path, nargs="+", metavar="MOCAP", help="BVH in centimetres, or ASF and AMC")
    parser.add_argument("--json", type=Path, metavar="FILE", help="save the figures there too")
    options = parser.parse_args(arguments)
    recordings = read_recordings(options.takes, _UNIT) if options.takes else sample_recordings()
    policy = policy_of(recordings)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        large = folder / "large.policy"
        large.write_bytes(policy)
        measured = measure_core(options.program, large, folder)
        data: Arrays = {path.stem: np.load(path) for path in folder.glob("*.npy")}
    rows, remarks = compare(measured.seconds, data)
    stored = measure_stored(recordings, policy)
    show(rows, remarks, measured, data, stored)
    if options.json:
        figures = {"stages": [asdict(row) for row in rows], "growth": asdict(measured.growth), "stored": asdict(stored)}
        options.json.write_text(json.dumps(figures, indent=2) + "\n")


if __name__ == "__main__":
    main(sys.argv[1:])
