# SPDX-License-Identifier: MIT
"""ozz-animation, a run time for games' animation to compare frames with: its sources, which are nowhere in the project,
and the benchmarks compiled with it."""

from __future__ import annotations

from pathlib import Path

from tools.packaging.compiling import COMPILING, compiler_environment
from tools.paths import BUILD
from tools.shell import run, say

_OZZ = "https://github.com/guillaumeblanc/ozz-animation"
_VERSION = "0.16.0"


def ozz_in(folder: Path) -> Path:
    """Its sources in the folder, fetched by git where they are not there yet."""
    sources = folder.resolve() / "ozz-animation"
    if not (sources / "CMakeLists.txt").exists():
        say(f"set-up: ozz-animation {_VERSION} in {folder}")
        run(["git", "clone", "--quiet", "--depth", "1", "--branch", _VERSION, _OZZ, sources], "ozz-animation")
    return sources


def compile_with_ozz(sources: Path) -> Path:
    """The folder of the benchmarks compiled with it, apart from those without."""
    folder, environment = BUILD / "release-peers", compiler_environment()
    with COMPILING:
        run(
            ["cmake", "--preset", "release", "-B", folder, f"-DFRAGMOTION_OZZ_DIR={sources}"],
            "cmake-peers",
            environment,
        )
        run(["cmake", "--build", folder, "--target", "fragmotion_benchmarks"], "build-peers", environment)
    return folder
