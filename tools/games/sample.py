# SPDX-License-Identifier: MIT
"""The sample character as a game gets it: sample.policy and sample.glb, made by Debian's Blender."""

from __future__ import annotations

from pathlib import Path

from tools.packaging import packages
from tools.paths import BUILD, TOP
from tools.setup import blender
from tools.shell import run, say

FOLDER = BUILD / "sample"
_MADE = tuple(FOLDER / name for name in ("sample.policy", "sample.glb"))
_MADE_FROM = ("addon", "cpp/src/make", "sample_rigs", "tools/games/sample_in_blender.py")


def make() -> Path:
    """The folder with both files, made anew where what makes them is younger."""
    if not _is_up_to_date():
        say("build: the sample character, by Blender")
        FOLDER.mkdir(parents=True, exist_ok=True)
        script = TOP / "tools" / "games" / "sample_in_blender.py"
        package = packages.build_for_debian(FOLDER)
        run(blender.background_command(script, package, FOLDER), "sample", blender.debian_environment("sample"))
    return FOLDER


def _is_up_to_date() -> bool:
    sources = [path for name in _MADE_FROM for path in (TOP / name, *(TOP / name).rglob("*")) if path.is_file()]
    youngest = max(path.stat().st_mtime for path in sources)
    return all(path.exists() and path.stat().st_mtime > youngest for path in _MADE)
