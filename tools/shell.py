# SPDX-License-Identifier: MIT
"""Running programs: noisy output goes to a log, whose end is shown when the program fails."""

from __future__ import annotations

import os
import re
import shlex
import sys
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from tools.paths import LOGS, TOP
from tools.processes import OutOfTime, run_for

TAIL_LINES = 60
_STEPS_EVERY = 20.0  # s, where lines are not written over


class Failure(Exception):
    """What went wrong, in words for the person at the terminal."""


def say(text: str) -> None:
    """Print one progress line at once."""
    print(text, flush=True)


@contextmanager
def step(name: str, contents: str = "") -> Iterator[None]:
    """Say which step of the set-up begins, and how long it took."""
    say(f"set-up: {name} {contents}".rstrip())
    start = time.monotonic()
    yield
    say(f"set-up: {name}: done in {time.monotonic() - start:.0f} s")


def steps_of(label: str) -> Callable[[str], None]:
    """A hearer for `run` that says how far ninja is: written over on a terminal, now and then elsewhere."""
    due = time.monotonic() + _STEPS_EVERY

    def hear(line: str) -> None:
        nonlocal due
        step = re.match(r"\[\d+/\d+\]", line)
        if step and sys.stdout.isatty():
            print(f"{label}: {step[0]}", end="\r", flush=True)
        elif step and time.monotonic() >= due:
            say(f"{label}: {step[0]}")
            due = time.monotonic() + _STEPS_EVERY

    return hear


def run(
    command: Sequence[str | Path],
    log: str,
    environment: Mapping[str, str] | None = None,
    echo: bool = False,
    timeout: float = 1800.0,
    hear: Callable[[str], None] | None = None,
) -> None:
    """Run a program from the top folder with its output in build/logs/LOG.log, and with `echo` on the terminal; `hear`
    is told each line.

    Raises Failure with the command and the log's end when it fails or takes more than `timeout` seconds.
    """
    words = [str(word) for word in command]
    LOGS.mkdir(parents=True, exist_ok=True)
    path = LOGS / f"{log}.log"
    if echo:
        hear = partial(print, f"{log}: ", end="", sep="", flush=True)
    try:
        with path.open("w") as file:
            file.write(f"$ {shlex.join(words)}\n")
            code = run_for(timeout, words, TOP, {**os.environ, **(environment or {})}, _both(file.write, hear))
    except OSError as error:
        raise Failure(f"cannot run {words[0]}: {error.strerror}") from error
    except OutOfTime:
        cause = f"was stopped after {timeout:.0f} s, with all that it started"
    else:
        cause = f"failed with exit code {code}" if code else ""
    if cause:
        raise Failure(f"this {cause} (log: {path}):\n  {shlex.join(words)}{'' if echo else _tail(path)}")


def _both(write: Callable[[str], object], hear: Callable[[str], None] | None) -> Callable[[str], None]:
    def tell(line: str) -> None:
        write(line)
        if hear:
            hear(line)

    return tell


def _tail(path: Path) -> str:
    lines = path.read_text(errors="replace").splitlines()[1:][-TAIL_LINES:]
    return "".join(f"\n  | {line}" for line in lines)
