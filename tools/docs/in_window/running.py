# SPDX-License-Identifier: MIT
"""Scripts that make pictures in a Blender with a window, on a screen of its own: Debian unstable's 5.2 where that is
set up, else the one that Debian has here."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from tools.packaging import cross, packages
from tools.paths import BLENDER, BUILD, LOGS
from tools.platforms import LINUX
from tools.setup import apt, blender, machine, unstable
from tools.shell import Failure, run, say

PACKAGES = ("blender", "imagemagick", "libgl1-mesa-dri", "python3-numpy", "xauth", "xvfb")
"""What it takes in Debian unstable."""

_PYTHON = "3.14"  # of Debian unstable's Blender
_SCREEN = ("xvfb-run", "--auto-servernum", "--server-args", "-screen 0 1600x900x24")
_WINDOW = ("--factory-startup", "--enable-event-simulate", "--window-geometry", "0", "0", "1600", "900")


def run_script(name: str, folder: Path) -> None:
    """Run a script of this folder; its arguments are the add-on's zip and the folder for what it makes."""
    script, log = Path(__file__).parent / f"{name}.py", f"docs-{name}"
    absent = unstable.why_not() or apt.missing(PACKAGES, unstable.ROOT)
    if absent:
        say("in this machine's own Blender; `sudo python3 dev.py unstable` sets up 5.2")
    (_run_here if absent else _run_in_unstable)(script, folder, log)
    if "SESSION PASSED" not in (LOGS / f"{log}.log").read_text():
        raise Failure(f"{script.name} did not come to its end; what it printed says why")


def _run_here(script: Path, folder: Path, log: str) -> None:
    machine.set_up(machine.GUI)
    package = packages.build_for_debian()
    environment = {**blender.debian_environment("docs"), "LIBGL_ALWAYS_SOFTWARE": "1"}
    run(_command(BLENDER, script, package, folder), log, environment, echo=True)


def _run_in_unstable(script: Path, folder: Path, log: str) -> None:
    platform = replace(LINUX, more_pythons=(_PYTHON,))
    machine.set_up(machine.package_needs((platform,)))
    package = packages.build_extension(platform, cross.build_wheels(platform, (_PYTHON,)), BUILD / "packages-unstable")
    variables = [f"{name}={value}" for name, value in blender.sandbox("docs").items()]
    words = _command("blender", script, package, folder)
    run(unstable.command(["env", *variables, *words]), log, echo=True)


def _command(program: str | Path, script: Path, package: Path, folder: Path) -> Sequence[str | Path]:
    return [*_SCREEN, program, *_WINDOW, "--python", script, "--", package, folder]
