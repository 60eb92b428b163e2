# SPDX-License-Identifier: MIT
"""Running Debian's Blender, and keeping every Blender away from the user's own settings."""

from __future__ import annotations

import shutil
from pathlib import Path

from tools.paths import BLENDER, BUILD


def sandbox(name: str) -> dict[str, str]:
    """Environment variables that give a Blender an empty user folder of its own, build/sandbox/NAME."""
    folder = BUILD / "sandbox" / name
    shutil.rmtree(folder, ignore_errors=True)
    folders = {
        "BLENDER_USER_RESOURCES": folder,  # 4.2 and later
        "BLENDER_USER_SCRIPTS": folder / "scripts",
        "BLENDER_USER_CONFIG": folder / "config",
    }
    for path in folders.values():
        path.mkdir(parents=True, exist_ok=True)
    return {variable: str(path) for variable, path in folders.items()}


def debian_environment(name: str) -> dict[str, str]:
    """The sandbox for Debian's Blender, which takes its Python library from the first python3 on the PATH."""
    return {**sandbox(name), "PATH": "/usr/local/sbin:/usr/sbin:/usr/bin:/sbin:/bin"}


def background_command(script: Path, *arguments: str | Path) -> list[str | Path]:
    """Run a script in Debian's Blender without a window; its failure is the exit code."""
    options = ["--background", "--factory-startup", "--python-exit-code", "1"]
    return [BLENDER, *options, "--python", script, "--", *arguments]
