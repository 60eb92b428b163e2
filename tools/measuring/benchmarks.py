# SPDX-License-Identifier: MIT
"""`dev.py bench`: build the benchmarks, and compare the core with NumPy and scikit-learn."""

from __future__ import annotations

from pathlib import Path

from tools.packaging import packages
from tools.packaging.compiling import compile_preset, installed_core
from tools.setup import machine
from tools.setup.environments import HOST, environment_python
from tools.shell import run, say


def run_benchmarks(takes: list[Path], json_file: Path | None) -> int:
    """Measure in the Python that runs this, a policy file of `takes` or else of the sample's, too, and save the figures
    in `json_file` if one is given."""
    machine.set_up(machine.BENCH)
    say("build: benchmarks and core")
    program = compile_preset("release", "fragmotion_benchmarks") / "fragmotion_benchmarks"
    core = installed_core(HOST, packages.wheel(HOST))
    output = ["--json", str(json_file.resolve())] if json_file else []
    if takes:
        output += ["--takes", *(str(path.resolve()) for path in takes)]
    python = environment_python(HOST)
    run([python, "-m", "tools.measuring.bench", program, *output], "bench", {"PYTHONPATH": str(core)}, echo=True)
    return 0
