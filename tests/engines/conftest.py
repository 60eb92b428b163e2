# SPDX-License-Identifier: MIT
"""Debian unstable, the sample character, and what this machine's own libfragmotion makes of it: the oracle of all
engines."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from native import Library

from tools.setup import unstable

TOP = Path(__file__).parents[2]
BUILD = TOP / "build" / "engines"
Run = Callable[..., str]
Poses = Any


def finished(words: list[str], seconds: float) -> str:
    """What a command prints; it must succeed."""
    done = subprocess.run(words, capture_output=True, text=True, timeout=seconds, check=False, cwd=TOP)
    assert done.returncode == 0, f"{words[-8:]}\n{done.stdout[-6000:]}{done.stderr[-6000:]}"
    return done.stdout


@pytest.fixture(scope="session")
def in_unstable() -> Run:
    """Runs a command in Debian unstable, from a folder of the project, and returns what it prints."""

    def run(*words: str | Path, folder: Path = TOP, seconds: float = 600) -> str:
        return finished(unstable.command(words, folder), seconds)

    return run


@pytest.fixture(scope="session")
def sample() -> Path:
    """The folder of sample.policy and sample.glb."""
    return Path(os.environ["FRAGMOTION_SAMPLE"])


@pytest.fixture(scope="session")
def library() -> Library:
    """This machine's libfragmotion."""
    folder = BUILD / "native"
    launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
    options = ["-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DFRAGMOTION_RUNTIME_ONLY=ON", *launcher]
    finished(["cmake", "-S", str(TOP), "-B", str(folder), *options], 600)
    finished(["cmake", "--build", str(folder), "--target", "fragmotion_shared"], 1800)
    return Library(folder / "game" / "libfragmotion.so")


@pytest.fixture(scope="session")
def poses(library: Library, sample: Path) -> Poses:
    """[600, bones, 7]: what native.play() shows of the sample character in glTF's axes."""
    return library.play((sample / "sample.policy").read_bytes())
