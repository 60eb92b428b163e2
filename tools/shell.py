# SPDX-License-Identifier: MIT
"""Running programs: noisy output goes to a log, whose end is shown when the program fails."""

from __future__ import annotations

import os
import shlex
import signal
import subprocess
import threading
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TextIO

from tools.paths import LOGS, TOP

TAIL_LINES = 60


class Failure(Exception):
    """What went wrong, in words for the person at the terminal."""


def say(text: str) -> None:
    """Print one progress line at once."""
    print(text, flush=True)


def run(
    command: Sequence[str | Path],
    log: str,
    environment: Mapping[str, str] | None = None,
    echo: bool = False,
    timeout: float = 1800.0,
) -> None:
    """Run a program from the top folder with its output in build/logs/LOG.log, and with `echo` on the terminal.

    Raises Failure with the command and the log's end when it fails or takes more than `timeout` seconds.
    """
    words = [str(word) for word in command]
    LOGS.mkdir(parents=True, exist_ok=True)
    path = LOGS / f"{log}.log"
    with path.open("w") as file:
        file.write(f"$ {shlex.join(words)}\n")
        file.flush()
        code = _run_logged(words, file, {**os.environ, **(environment or {})}, f"{log}: " if echo else None, timeout)
    if code != 0:
        cause = f"was stopped after {timeout:.0f} s" if code == -signal.SIGKILL else f"failed with exit code {code}"
        tail = "" if echo else _tail(path)
        raise Failure(f"this {cause} (log: {path}):\n  {shlex.join(words)}{tail}")


def _run_logged(words: list[str], file: TextIO, environment: dict[str, str], echo: str | None, timeout: float) -> int:
    try:
        process = subprocess.Popen(
            words,
            cwd=TOP,
            env=environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            start_new_session=True,
        )
    except OSError as error:
        raise Failure(f"cannot run {words[0]}: {error.strerror}") from error
    timer = threading.Timer(timeout, _kill, [process])
    timer.start()
    try:
        assert process.stdout
        for line in process.stdout:
            file.write(line)
            if echo is not None:
                print(f"{echo}{line}", end="", flush=True)
        return process.wait()
    finally:
        timer.cancel()
        if process.poll() is None:
            _kill(process)


def _kill(process: subprocess.Popen[str]) -> None:
    # The whole session: a program's children hold its output open, and would be waited for.
    os.killpg(process.pid, signal.SIGKILL)


def _tail(path: Path) -> str:
    lines = path.read_text(errors="replace").splitlines()[1:][-TAIL_LINES:]
    return "".join(f"\n  | {line}" for line in lines)
