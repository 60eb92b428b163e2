# SPDX-License-Identifier: MIT
"""How the code is written: ruff, mypy and clang-format, in the versions that machine.py names."""

from __future__ import annotations

from pathlib import Path

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
