# SPDX-License-Identifier: MIT
"""Windows on this machine: its Python, with Blender's module for it, run by Wine."""

from __future__ import annotations

import shutil
from pathlib import Path

from tools import environments, maven
from tools.environments import BPY_PYTHON
from tools.paths import BUILD
from tools.shell import Failure, run

PACKAGES = (*maven.PACKAGES, "wine64")
"""The Debian packages that it takes."""

_FOLDER = BUILD / "windows"
_PYTHON = _FOLDER / "python"
# bpy's metadata names neither cattrs nor which NumPy it was built for; pip takes this machine for the one that runs it,
# where pytest needs no colorama.
_REQUIREMENTS = (
    "bpy==4.5.*",
    "cattrs",
    "colorama",
    "matplotlib",
    "numpy<2",
    "pytest",
    "requests",
    "scikit-learn",
    "scipy",
)
_LOADERS = ("/usr/lib/wine/wine64", "/usr/lib/wine/wine")  # Debian 12's, 13's: both off the PATH


def ensure() -> None:
    """Put Windows' Python into build/windows, with bpy and what the tests need."""
    label = f"Windows' Python {BPY_PYTHON} with {' '.join(_REQUIREMENTS)}"
    with environments.filled(_FOLDER, _REQUIREMENTS, label) as is_needed:
        if is_needed:
            maven.ensure_windows_python(BPY_PYTHON, _PYTHON)
            environments.install_for_windows(_PYTHON / "lib" / "site-packages", BPY_PYTHON, _REQUIREMENTS)
            run([*python_command(), "-c", "import bpy"], "wine", environment())


def python_command() -> list[str | Path]:
    """What runs Windows' Python; to be followed by its arguments, and run in `environment()`."""
    loader = next((path for path in _LOADERS if Path(path).exists()), None) or shutil.which("wine")
    if not loader:
        raise Failure("wine64 is installed, but none of its programs is where Debian puts them")
    return [loader, _PYTHON / "python.exe"]


def environment() -> dict[str, str]:
    """Environment variables that keep Wine's Windows in build/windows, and quiet."""
    return {
        "WINEPREFIX": str(_FOLDER / "prefix"),
        "WINEDEBUG": "-all",
        "WINEDLLOVERRIDES": "mscoree,mshtml=",
        # Wine's XInput has a thread that goes on when SDL unloads it.
        "SDL_XINPUT_ENABLED": "0",
    }


def path(unix: Path | str) -> str:
    """An absolute path as Windows' programs see it."""
    return f"Z:{unix}"
