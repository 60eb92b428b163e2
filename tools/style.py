# SPDX-License-Identifier: MIT
"""How the code is written: ruff, mypy, clang-format and clang-tidy, in the versions that machine.py names."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from tools.compiling import COMPILING, configure_preset
from tools.environments import HOST, environment
from tools.paths import TOP
from tools.shell import Failure, run, say

_CPP = ("cpp", "tests")
_TYPED = ("dev.py", "tools", "cpp/bindings/fragmotion_command.py")


def check() -> tuple[int, list[str]]:
    """Run each check; how many passed, and what those say that did not."""
    programs = environment(HOST) / "bin"
    sources = sorted(str(path) for folder in _CPP for path in (TOP / folder).rglob("*.[ch]pp"))
    commands: dict[str, list[str | Path]] = {
        "ruff": [programs / "ruff", "check", "."],
        "ruff-format": [programs / "ruff", "format", "--check", "."],
        "mypy-tools": [programs / "mypy", *_TYPED],
        "mypy-addon": [programs / "mypy", "-p", "fragmotion"],
        "clang-format": [programs / "clang-format", "--dry-run", "--Werror", *sources],
    }
    failures = []
    for name, command in commands.items():
        try:
            run(command, name, {"MYPYPATH": f"{TOP / 'addon'}:{TOP / 'cpp' / 'bindings'}"})
            say(f"{name}: clean")
        except Failure as failure:
            failures.append(f"{name}: {failure}")
    return len(commands) - len(failures), failures


def tidy() -> tuple[int, list[str]]:
    """Run clang-tidy on each source of the core; how many it finds nothing in, and what it says of the others."""
    with COMPILING:
        database = configure_preset("release")
    program = environment(HOST) / "bin" / "clang-tidy"
    sources = sorted((TOP / "cpp" / "src").rglob("*.cpp"))

    def look_into(source: Path) -> str | None:
        try:
            run([program, "--quiet", "-p", database, source], f"tidy-{source.stem}")
        except Failure as failure:
            return f"{source.relative_to(TOP)}: {failure}"
        return None

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        failures = [failure for failure in pool.map(look_into, sources) if failure]
    return len(sources) - len(failures), failures
