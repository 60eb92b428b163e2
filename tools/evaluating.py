# SPDX-License-Identifier: MIT
"""`dev.py evaluate`, `beside` and `retarget`: build the core, and let tools' package of that name work with it."""

from __future__ import annotations

import argparse
import os
import subprocess
from collections.abc import Sequence
from pathlib import Path

from tools import machine, packages
from tools.beside import inputs as beside_inputs
from tools.compiling import installed_core
from tools.environments import environment_python
from tools.evaluate import inputs
from tools.paths import TOP
from tools.retarget import inputs as retarget_inputs
from tools.shell import say


def run_evaluation(options: argparse.Namespace, arguments: list[str]) -> int:
    """Measure in the Python 3.11 environment; `arguments` are the words that the options were read from."""
    inputs.check(options)
    return _run("tools.evaluate", machine.EVALUATE, options.mocap, arguments)


def run_comparison(options: argparse.Namespace, arguments: list[str]) -> int:
    """Measure beside motion matching, likewise."""
    beside_inputs.check(options)
    return _run("tools.beside", machine.BESIDE, options.mocap, arguments)


def run_retargeting(options: argparse.Namespace, arguments: list[str]) -> int:
    """Retarget, likewise."""
    retarget_inputs.check(options)
    return _run("tools.retarget", machine.EVALUATE, [], arguments, retarget_inputs.needs_blender(options))


def _run(
    module: str, needs: machine.Needs, mocap: Sequence[Path], arguments: list[str], with_blender: bool = False
) -> int:
    machine.set_up(needs | machine.BLENDER_45 if with_blender or inputs.has_blend(mocap) else needs)
    say("build: core")
    core = installed_core("3.11", packages.wheel("3.11"))
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join((str(core), str(TOP)))}
    command = [str(environment_python("3.11")), "-m", module, *arguments]
    return subprocess.run(command, env=environment, check=False).returncode
