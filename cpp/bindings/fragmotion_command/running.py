# SPDX-License-Identifier: MIT
"""Running one command: what it found goes to the terminal and to a file, what was wrong is told in a line."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple


class Done(NamedTuple):
    """What a command found: its figures, and the same as a text."""

    figures: Mapping[str, Any]
    text: str
    code: int = 0
    """The exit code."""


def run(parser: argparse.ArgumentParser, arguments: Sequence[str]) -> int:
    """Run one command; the exit code, which is 1 where the cause of a failure was told."""
    options = parser.parse_args(arguments)
    try:
        done: Done = options.command(options)
        _tell(done, options.json)
    except (ValueError, OSError) as error:
        print(f"fragmotion: {error}", file=sys.stderr)
        return 1
    return done.code


def _tell(done: Done, file: str | None) -> None:
    figures = json.dumps(done.figures, indent=1, allow_nan=False, ensure_ascii=False)
    if file == "-":
        print(figures, flush=True)
        return
    print(done.text, flush=True)
    if file:
        Path(file).parent.mkdir(parents=True, exist_ok=True)
        Path(file).write_text(figures + "\n", encoding="utf-8")


def say(text: str) -> None:
    """Say at once what is being done: not where figures are printed."""
    print(text, file=sys.stderr, flush=True)


def listed(figures: Mapping[str, Any]) -> str:
    """Figures as a line."""
    return ", ".join(f"{name.replace('_', ' ')} {_shown(value)}" for name, value in figures.items())


def _shown(value: object) -> str:
    if isinstance(value, list):
        return " ".join(map(str, value))
    return f"{value:.3g}" if isinstance(value, float) else str(value)
