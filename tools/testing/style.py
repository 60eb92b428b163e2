# SPDX-License-Identifier: MIT
"""How the code is written: ruff, mypy, clang-format and clang-tidy, in the versions that setup/machine.py names."""

from __future__ import annotations

import json
import os
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from tools.packaging.compiling import COMPILING, configure_preset
from tools.paths import TOP
from tools.setup.environments import HOST, environment
from tools.shell import Failure, run, say

_CPP = ("cpp", "games", "tests")
_STAGES = tuple((f"{target}.dir", "Unity") for target in ("fragmotion", "fragmotion_runtime"))
_TYPED = ("dev.py", "tools", "cpp/bindings/fragmotion_command")


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
    """Run clang-tidy on each stage of the core, compiled as one; how many are clean, and what it says of the others."""
    with COMPILING:
        database = configure_preset("release")
    program = environment(HOST) / "bin" / "clang-tidy"
    files = [Path(each["file"]) for each in json.loads((database / "compile_commands.json").read_text())]
    sources = sorted(file for file in files if file.parts[-3:-1] in _STAGES)
    if not sources:
        raise Failure(f"{database} has no sources of the core")

    def look_into(source: Path) -> str | None:
        try:
            run([program, "--quiet", "-p", database, source], f"tidy-{source.parts[-3]}-{source.stem}")
        except Failure as failure:
            return str(failure)
        return None

    with ThreadPoolExecutor(os.cpu_count()) as pool:
        failures = [failure for failure in pool.map(look_into, sources) if failure]
    return len(sources) - len(failures), failures
