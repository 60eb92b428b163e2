# SPDX-License-Identifier: MIT
"""Windows on this machine: its Pythons, with Blender's module for each, run by Wine."""

from __future__ import annotations

import shutil
from pathlib import Path

from tools.paths import BUILD, TOP
from tools.setup import environments, maven
from tools.shell import Failure, run

PACKAGES = (*maven.PACKAGES, "wine64")
"""The Debian packages that it takes."""

_FOLDER = BUILD / "windows"
# The metadata of bpy 4.5 names neither cattrs nor which NumPy it was built for; pip takes this machine for the one that
# runs it, where pytest needs no colorama.
_REQUIREMENTS = {
    "3.11": (
        "bpy==4.5.*",
        "cattrs",
        "colorama",
        "matplotlib",
        "numpy<2",
        "pytest",
        "requests",
        "scikit-learn",
        "scipy",
    ),
    "3.13": ("bpy==5.2.*", "colorama", "pytest"),
}
_START = TOP / "tests" / "windows" / "wine"  # what these Pythons read when they start
_LOADERS = ("/usr/lib/wine/wine64", "/usr/lib/wine/wine")  # Debian 12's, 13's: both off the PATH


def ensure(version: str) -> None:
    """Put Windows' Python of a version ("3.11") into build/windows, with bpy and what the tests need; this machine's
    environment of that version is there."""
    folder, requirements = _FOLDER / version, _REQUIREMENTS[version]
    label = f"Windows' Python {version} with {' '.join(requirements)}"
    with environments.filled(folder, requirements, label) as is_needed:
        if is_needed:
            packages = _python(version) / "lib" / "site-packages"
            maven.ensure_windows_python(version, _python(version))
            environments.install_for_windows(packages, version, requirements)
            (packages / "wine.pth").write_text(f"{path(_START)}\n")
            run([*python_command(version), "-c", "import bpy"], f"wine-{version}", environment("set-up"), timeout=300.0)


def _python(version: str) -> Path:
    return _FOLDER / version / "python"


def python_command(version: str) -> list[str | Path]:
    """What runs Windows' Python of a version; to be followed by its arguments, and run in an `environment`."""
    return [loader(), _python(version) / "python.exe"]


def loader() -> str:
    """What runs a program of Windows'."""
    found = next((path for path in _LOADERS if Path(path).exists()), None) or shutil.which("wine")
    if not found:
        raise Failure("wine64 is installed, but none of its programs is where Debian puts them")
    return found


def environment(name: str) -> dict[str, str]:
    """Environment variables that give a stage a Windows of its own in build/windows, whose server ends with it, and
    keep Wine quiet."""
    _FOLDER.mkdir(parents=True, exist_ok=True)
    return {
        "WINEPREFIX": str(_FOLDER / f"prefix-{name}"),
        "WINEDEBUG": "-all",
        "WINEDLLOVERRIDES": "mscoree,mshtml=",
        # Wine's XInput has a thread that goes on when SDL unloads it.
        "SDL_XINPUT_ENABLED": "0",
    }


def path(unix: Path | str) -> str:
    """An absolute path as Windows' programs see it."""
    return f"Z:{unix}"
