# SPDX-License-Identifier: MIT
"""`dev.py bench`: build the benchmarks and the add-on, and measure."""

from __future__ import annotations

from pathlib import Path

from tools.measuring.peers.ozz import compile_with_ozz, ozz_in
from tools.packaging import packages
from tools.packaging.compiling import compile_preset, installed_core
from tools.paths import BUILD
from tools.setup import machine
from tools.setup.environments import HOST, environment_python
from tools.shell import run, say


def run_benchmarks(takes: list[Path], peers: Path | None, json_file: Path | None) -> int:
    """Measure in the Python that runs this, a character of `takes` or else of the sample's, too; beside ozz-animation
    in the folder `peers` if one is given; and save the figures in `json_file` if one is."""
    machine.set_up(machine.BENCH)
    say("build: benchmarks, core and the add-on's zip")
    folder = compile_with_ozz(ozz_in(peers)) if peers else compile_preset("release", "fragmotion_benchmarks")
    core = installed_core(HOST, packages.wheel(HOST))
    words: list[str | Path] = [folder / "fragmotion_benchmarks", packages.build_for_debian(BUILD / "bench")]
    if json_file:
        words += ["--json", json_file.resolve()]
    if takes:
        words += ["--takes", *(path.resolve() for path in takes)]
    command = [environment_python(HOST), "-m", "tools.measuring.bench", *words]
    run(command, "bench", {"PYTHONPATH": str(core)}, echo=True)
    return 0
