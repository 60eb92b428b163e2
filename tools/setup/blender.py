# SPDX-License-Identifier: MIT
"""Running Debian's Blender, what it is, and keeping every Blender away from the user's own settings."""

from __future__ import annotations

import re
import shutil
from functools import cache
from pathlib import Path

from tools.paths import BLENDER, BUILD
from tools.setup.environments import site_packages
from tools.shell import Failure, run

_SYSTEM_PATH = "/usr/local/sbin:/usr/sbin:/usr/bin:/sbin:/bin"
_FIRST_WITH_EXTENSIONS = (4, 2)


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
    return {**sandbox(name), "PATH": _SYSTEM_PATH}


def background_command(script: Path, *arguments: str | Path) -> list[str | Path]:
    """Run a script in Debian's Blender without a window; its failure is the exit code."""
    options = ["--background", "--factory-startup", "--python-exit-code", "1"]
    return [BLENDER, *options, "--python", script, "--", *arguments]


def takes_extensions() -> bool:
    """Whether Debian's Blender is one that installs extensions (4.2 and later)."""
    return debian_version() >= _FIRST_WITH_EXTENSIONS


@cache
def debian_version() -> tuple[int, int]:
    """The version of Debian's Blender, as it says itself."""
    major, minor = _ask(["--version"], r"Blender (\d+)\.(\d+)")
    return int(major), int(minor)


@cache
def debian_python() -> str:
    """The Python ("3.11") that Debian's Blender runs, as it says itself."""
    code = "import sys; print('python is %d.%d' % sys.version_info[:2])"
    return ".".join(_ask(["--background", "--factory-startup", "--python-expr", code], r"python is (\d+)\.(\d+)"))


def extension_tools() -> dict[str, Path]:
    """Blender's own tool for extensions in each bpy that is here, by its Python."""
    places = {python: site_packages(python) for python in ("3.11", "3.13")}
    tools = {
        python: list(place.glob("bpy/*/scripts/addons_core/bl_pkg/cli/blender_ext.py"))
        for python, place in places.items()
    }
    return {python: found[0] for python, found in tools.items() if found}


def _ask(arguments: list[str], pattern: str) -> tuple[str, str]:
    environment, lines = {**debian_environment("asked"), "HOME": str(BUILD)}, list[str]()
    run([BLENDER, *arguments], "blender-asked", environment, hear=lines.append, timeout=120.0)
    match = re.search(pattern, "".join(lines))
    if not match:
        raise Failure(f"{BLENDER} {' '.join(arguments)} does not tell its version: {''.join(lines)}")
    return match[1], match[2]
