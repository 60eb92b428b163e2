# SPDX-License-Identifier: MIT
"""`dev.py beside`, `directing` and `tune`: build the core, and let tools' package of that name work with it."""

from __future__ import annotations

import argparse
import os
import subprocess

from tools.measuring.beside import inputs as beside_inputs
from tools.measuring.command import has_blend
from tools.measuring.directing import inputs as directing_inputs
from tools.measuring.tuning import inputs as tuning_inputs
from tools.packaging import packages
from tools.packaging.compiling import installed_core
from tools.paths import TOP
from tools.setup import machine
from tools.setup.environments import BPY_PYTHON, HOST, environment_python
from tools.shell import say


def run_comparison(options: argparse.Namespace, arguments: list[str]) -> int:
    """Measure beside motion matching; `arguments` are the words that the options were read from."""
    beside_inputs.check(options)
    return _run("tools.measuring.beside", has_blend(options.mocap), arguments)


def run_directing(options: argparse.Namespace, arguments: list[str]) -> int:
    """Direct a character, likewise."""
    directing_inputs.check(options)
    return _run("tools.measuring.directing", directing_inputs.needs_blender(options), arguments)


def run_tuning(options: argparse.Namespace, arguments: list[str]) -> int:
    """Fit the run time's constants, likewise."""
    tuning_inputs.check(options)
    return _run("tools.measuring.tuning", False, arguments, ("cma",))


def run_quality(arguments: list[str]) -> int:
    """Compare with the quality's baseline or write it, as python3 -m tools.measuring.quality does with a core."""
    return _run("tools.measuring.quality", False, arguments)


def _run(module: str, blender: bool, arguments: list[str], more: tuple[str, ...] = ()) -> int:
    """Run a module of tools, which needs `more` packages, in the Python that runs this, or with `blender` in that of
    Blender 4.5's module."""
    python = BPY_PYTHON if blender else HOST
    machine.set_up(
        machine.measuring_needs(python)
        | machine.Needs((), {python: more})
        | (machine.BLENDER_45 if blender else machine.Needs())
    )
    say("build: core")
    core = installed_core(python, packages.wheel(python))
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join((str(core), str(TOP)))}
    command = [str(environment_python(python)), "-m", module, *arguments]
    return subprocess.run(command, env=environment, check=False).returncode


COMMANDS = {
    "beside": run_comparison,
    "directing": run_directing,
    "tune": run_tuning,
}
"""What does each command, with its options and its arguments as they were given."""
