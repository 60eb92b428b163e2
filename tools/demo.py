# SPDX-License-Identifier: MIT
"""`dev.py demo`: build, package, and let Debian's Blender install the zip and show what it does."""

from __future__ import annotations

from tools.packaging import packages
from tools.paths import BUILD, TOP
from tools.setup import blender, machine
from tools.shell import run, say

OUTPUT = BUILD / "demo"


def run_demo() -> int:
    """Show the whole chain; the pictures, the .blend and the figures are in build/demo."""
    machine.set_up(machine.DEMO)
    say("build: the core and the add-on's zip")
    package = packages.build_for_debian(OUTPUT)
    OUTPUT.mkdir(parents=True, exist_ok=True)
    say("demo: in Blender")
    command = blender.background_command(TOP / "tools" / "demo_in_blender.py", OUTPUT, package)
    run(command, "demo", blender.debian_environment("demo"), echo=True)
    return 0
