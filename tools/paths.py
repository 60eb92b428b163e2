# SPDX-License-Identifier: MIT
"""Where things are, and the version that is being built."""

from __future__ import annotations

import re
from pathlib import Path

TOP = Path(__file__).resolve().parent.parent
BUILD = TOP / "build"
LOGS = BUILD / "logs"
ADDON = TOP / "addon" / "fragmotion"
PACKAGES = BUILD / "packages"
LIBSVM = BUILD / "libsvm"
MUSL = BUILD / "musl"
SDL = BUILD / "sdl"
BLENDER = Path("/usr/bin/blender")  # Debian's, which runs the system's Python: 3.4.1 on Debian 12, 4.3 on 13


def version() -> str:
    """The version that CMakeLists.txt gives the project."""
    match = re.search(r"project\(fragmotion VERSION ([0-9.]+)", (TOP / "CMakeLists.txt").read_text())
    assert match, "CMakeLists.txt names no version"
    return match.group(1)
