# SPDX-License-Identifier: MIT
"""What the tests of engines share: commands here and in Debian unstable, what CMake builds, the sample character."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Sequence
from functools import cache
from pathlib import Path

from tools.paths import BUILD, TOP
from tools.setup import unstable

GAMES = TOP / "games"
FOLDER = BUILD / "engines"
WALKING = TOP / "tests" / "data" / "version-3.policy"


def sample(name: str) -> Path:
    """A file of the sample character: sample.policy or sample.glb."""
    return Path(os.environ["FRAGMOTION_SAMPLE"]) / name


def run(words: Sequence[str | Path], seconds: float = 600, **environment: str) -> str:
    """What a command prints; it must succeed."""
    command = [str(word) for word in words]
    done = subprocess.run(
        command,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        timeout=seconds,
        env={**os.environ, **environment},
        check=False,
    )
    assert done.returncode == 0, f"{command} ended with {done.returncode}\n{done.stdout}"
    return done.stdout


def run_inside(words: Sequence[str | Path], folder: Path = TOP, seconds: float = 600) -> str:
    """The same in Debian unstable, from a folder of the project."""
    return run(unstable.command(words, folder), seconds)


def compile_here(source: Path, folder: Path, *options: str) -> Path:
    """The folder where this machine's compiler has built a CMake project."""
    launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
    run(["cmake", "-S", source, "-B", folder, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", *launcher, *options])
    run(["cmake", "--build", folder], seconds=3600)
    return folder


@cache
def library() -> Path:
    """The folder of libfragmotion.so."""
    return compile_here(TOP, FOLDER / "library", "-DFRAGMOTION_RUNTIME_ONLY=ON") / "game"


@cache
def reference() -> Path:
    """The C program that plays scripted input on a policy and prints poses: reference.c says how."""
    program = FOLDER / "reference"
    source = TOP / "tests" / "engines" / "reference.c"
    link = ["-L", library(), "-lfragmotion", f"-Wl,-rpath,{library()}"]
    run(["gcc", "-std=c99", "-Wall", "-Werror", source, "-I", TOP / "cpp" / "include", "-o", program, *link])
    return program
