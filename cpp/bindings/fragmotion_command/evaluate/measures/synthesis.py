# SPDX-License-Identifier: MIT
"""What a controller's synthesis takes in time and memory (Table 1): measured in fresh processes, nothing estimated.

python -m fragmotion_command.evaluate.measures.synthesis ARRAYS CONTROLLER prints the figures of one process as JSON.
"""

from __future__ import annotations

import ctypes
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from ...core import core
from ..loading import Session
from .controllers import CONTROLLERS, Factors, make_table

_ABOVE = Path(__file__).parents[3]  # where the command's package is
_PROCESSES = 3  # a controller
_RUNS = 3  # a process
_WARM_UP = 4  # classes
_ALLOCATOR = {-8: 1, -4: 0, -1: 2**31 - 1}  # glibc's M_ARENA_MAX, M_MMAP_MAX and M_TRIM_THRESHOLD


def measure_synthesis(factors: Factors, teacher: Session, test: Session) -> dict[str, dict[str, float | None]]:
    """Seconds and peak bytes of every controller: median of several processes; bytes None where Linux does not tell."""
    with tempfile.TemporaryDirectory() as folder:
        arrays = Path(folder) / "arrays.npz"
        factors.save(arrays, train=teacher.indices, test=test.indices)
        return {name: _median([_run_child(arrays, name) for _ in range(_PROCESSES)]) for name in CONTROLLERS}


def _median(runs: list[dict[str, Any]]) -> dict[str, float | None]:
    peaks = [run["peak_bytes"] for run in runs if run["peak_bytes"] is not None]
    return {
        "synthesis_seconds": statistics.median(run["seconds"] for run in runs),
        "peak_bytes": int(statistics.median(peaks)) if peaks else None,
    }


def _run_child(arrays: Path, name: str) -> dict[str, Any]:
    command = [sys.executable, "-m", "fragmotion_command.evaluate.measures.synthesis", str(arrays), name]
    paths = {"PYTHONPATH": os.pathsep.join((str(_ABOVE), *sys.path))}
    answer = subprocess.run(command, env={**os.environ, **paths}, capture_output=True, text=True, check=False)
    if answer.returncode != 0:
        raise ValueError(f"measuring the synthesis of {name} failed:\n{answer.stderr}")
    measured: dict[str, Any] = json.loads(answer.stdout)
    return measured


def _synthesis(name: str, factors: Factors, train: core.Ints, test: core.Ints) -> Callable[[], object]:
    if name == "optimal":
        return lambda: core.optimal_path(factors.smoothness, factors.match, test)
    return lambda: make_table(name, factors, [train])


def _warm_up(name: str, factors: Factors, train: core.Ints, test: core.Ints) -> None:
    """The same on few classes, so that the program itself is in memory."""
    n = min(_WARM_UP, len(factors.match))
    few = Factors(factors.smoothness[:n, :n].copy(), factors.match[:n].copy(), factors.features[:n], factors.space)
    _synthesis(name, few, train, test)()


def _keep_memory() -> None:
    """Let the allocator give nothing back to the system before it is asked to.

    Linux is exact on what a process has, but misses up to some 100 kB of a peak that is over.
    """
    with suppress(AttributeError):  # not glibc
        for parameter, value in _ALLOCATOR.items():
            ctypes.CDLL(None).mallopt(parameter, value)


def _status(field: str) -> int:
    """A field of /proc/self/status, bytes."""
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith(f"{field}:"):
            return 1024 * int(line.split()[1])
    raise OSError(f"/proc/self/status has no {field}")


def peak_memory(work: Callable[[], object]) -> int | None:
    """By how many bytes the process grew at most while it worked; None where the system does not tell.

    The greatest of a few runs: Linux counts pages for each processor and adds them up late, so that one may miss some.
    """
    peaks = [_peak_of_a_run(work) for _ in range(_RUNS)]
    return max((peak for peak in peaks if peak is not None), default=None)


def _peak_of_a_run(work: Callable[[], object]) -> int | None:
    try:
        ctypes.CDLL(None).malloc_trim(0)
        before = _status("VmRSS")
        Path("/proc/self/clear_refs").write_text("5")
        work()
        return max(0, _status("VmHWM") - before)
    except (OSError, AttributeError):
        return None


def _seconds(work: Callable[[], object]) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def main(arrays_file: str, name: str) -> None:
    """Measure one controller in this process."""
    _keep_memory()
    with np.load(arrays_file) as arrays:
        factors, train, test = Factors.of_arrays(arrays), arrays["train"], arrays["test"]
    _warm_up(name, factors, train, test)
    work = _synthesis(name, factors, train, test)
    peak = peak_memory(work)
    print(json.dumps({"peak_bytes": peak, "seconds": statistics.median(_seconds(work) for _ in range(_RUNS))}))


if __name__ == "__main__":
    main(*sys.argv[1:])
