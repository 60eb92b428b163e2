# SPDX-License-Identifier: MIT
"""Programs with a time: their output line by line, and the end of all that they started."""

from __future__ import annotations

import os
import signal
import subprocess
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from enum import Enum
from pathlib import Path
from queue import Empty, Queue
from typing import Union
from uuid import uuid4

# What a program starts can leave its session and its parents, as Wine's server does, but it keeps their environment.
_MARK = "FRAGMOTION_STARTED_BY"
LINGER = 60.0  # s for what a program started to end after it
_ENDING = 10.0  # s at most to kill what starts more of itself meanwhile


class OutOfTime(Exception):
    """A program took too long."""


class _Event(Enum):
    ENDED = "the program has ended"
    CLOSED = "nothing holds its output any more"


_Events = Queue[Union[str, _Event]]


def run_for(
    seconds: float, words: Sequence[str], folder: Path, environment: Mapping[str, str], hear: Callable[[str], None]
) -> int:
    """Run a program, tell each line that it and its children write, and return its exit code when all have closed
    their output, or a minute after its end. Raises OutOfTime after `seconds`. Where children keep the output open, and
    where anything is raised, all that the program started is killed.
    """
    mark = uuid4().hex
    process = subprocess.Popen(
        words,
        cwd=folder,
        env={**environment, _MARK: f"{environment.get(_MARK, '')} {mark}"},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        start_new_session=True,
    )
    is_over = False
    try:
        is_over = _follow(process, seconds, hear)
    finally:
        if not is_over:
            _end(process, mark.encode())
    return process.returncode


def _follow(process: subprocess.Popen[str], seconds: float, hear: Callable[[str], None]) -> bool:
    """Tell the lines until the program has ended; whether its children have closed their output soon after."""
    events: _Events = Queue()
    # Threads, since nothing ends a read of what a program beyond our reach holds open.
    for follow in (_read, _wait):
        threading.Thread(target=follow, args=(process, events), daemon=True).start()
    awaited, deadline = set(_Event), time.monotonic() + seconds
    while awaited:
        event = _next(events, deadline)
        if event is None:
            if _Event.ENDED in awaited:
                raise OutOfTime
            return False
        if isinstance(event, str):
            hear(event)
            continue
        awaited.remove(event)
        if event is _Event.ENDED:
            deadline = time.monotonic() + LINGER
    return True


def _next(events: _Events, deadline: float) -> str | _Event | None:
    left = deadline - time.monotonic()
    try:
        return events.get(timeout=left) if left > 0 else None
    except Empty:
        return None


def _read(process: subprocess.Popen[str], events: _Events) -> None:
    assert process.stdout
    for line in process.stdout:
        events.put(line)
    events.put(_Event.CLOSED)


def _wait(process: subprocess.Popen[str], events: _Events) -> None:
    process.wait()
    events.put(_Event.ENDED)


def _end(process: subprocess.Popen[str], mark: bytes) -> None:
    """Kill a program and all that carry its mark, until none is left."""
    process.kill()
    process.wait()
    deadline = time.monotonic() + _ENDING
    while (left := _marked(mark)) and time.monotonic() < deadline:
        for number in left:
            with suppress(ProcessLookupError):
                os.kill(number, signal.SIGKILL)


def _marked(mark: bytes) -> list[int]:
    return [int(folder.name) for folder in Path("/proc").glob("[0-9]*") if mark in _environment(folder)]


def _environment(folder: Path) -> bytes:
    # Another user's is not ours to read; of a program that has ended there is none.
    try:
        return (folder / "environ").read_bytes()
    except OSError:
        return b""
