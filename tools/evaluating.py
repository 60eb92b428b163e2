# SPDX-License-Identifier: MIT
"""`dev.py evaluate`: build the core, and let tools.evaluate measure with it."""

from __future__ import annotations

import argparse
import os
import subprocess

from tools import machine, packages
from tools.compiling import installed_core
from tools.environments import environment_python
from tools.evaluate import inputs
from tools.paths import TOP
from tools.shell import say


def run_evaluation(options: argparse.Namespace, arguments: list[str]) -> int:
    """Measure in the Python 3.11 environment; `arguments` are the words that the options were read from."""
    inputs.check(options)
    machine.set_up(machine.EVALUATE_BLEND if inputs.has_blend(options.mocap) else machine.EVALUATE)
    say("build: core")
    core = installed_core("3.11", packages.wheel("3.11"))
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join((str(core), str(TOP)))}
    command = [str(environment_python("3.11")), "-m", "tools.evaluate", *arguments]
    return subprocess.run(command, env=environment, check=False).returncode
