# SPDX-License-Identifier: GPL-3.0-or-later
"""One long computation, in a thread of its own so that Blender stays usable, or step by step."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Generator
from typing import Any

from .compat.core import core

Report = Callable[[float, str], bool]


class Job:
    """Runs `task(report)`; `report(fraction, stage)` is False once the job is cancelled."""

    def __init__(self, label: str, task: Callable[[Report], Any]) -> None:
        self.label = label
        self.fraction = 0.0
        self.stage = "Starting"
        self._task = task
        self._observe: Callable[[float], None] = _ignore
        self._result: Any = None
        self._error: BaseException | None = None
        self._cancelled = threading.Event()
        self._thread = threading.Thread(target=self._run, name="Fragmotion", daemon=True)

    def start(self) -> None:
        """Begin in the background."""
        self._thread.start()

    def run(self, observe: Callable[[float], None]) -> None:
        """Do it here and now; `observe` hears the fraction done."""
        self._observe = observe
        self._run()

    def cancel(self) -> None:
        """Ask the task to stop; it does at its next report."""
        self._cancelled.set()

    def wait(self, seconds: float | None = None) -> None:
        """Return when the thread has ended, or after so many seconds."""
        self._thread.join(seconds)

    @property
    def running(self) -> bool:
        return self._thread.is_alive()

    def result(self) -> Any:
        """What the task returned; raises what it raised, core.Cancelled where it was cancelled."""
        if self._cancelled.is_set():
            raise core.Cancelled("cancelled")
        if self._error is not None:
            raise self._error
        return self._result

    def _report(self, fraction: float, stage: str) -> bool:
        self.fraction, self.stage = fraction, stage
        self._observe(fraction)
        return not self._cancelled.is_set()

    def _run(self) -> None:
        try:
            self._result = self._task(self._report)
        except BaseException as error:
            self._error = error


class SteppedJob(Job):
    """One that needs Blender's own thread: a generator, which tells what share is done and returns the result, is gone
    through bit by bit."""

    def __init__(self, label: str, stage: str, steps: Generator[float, None, Any]) -> None:
        super().__init__(label, lambda _report: None)
        self.stage, self._steps, self._running = stage, steps, True

    def start(self) -> None:
        """Nothing is done but in `wait` and `run`."""

    def run(self, observe: Callable[[float], None]) -> None:
        """Go through all of it; `observe` hears the fraction done."""
        while self._running:
            self.wait(0)
            observe(self.fraction)

    def cancel(self) -> None:
        """Leave it, as its generator does when it is closed."""
        super().cancel()
        self._running = False
        self._steps.close()

    def wait(self, seconds: float | None = None) -> None:
        """Go on for so many seconds, a step at least, or to the end."""
        begin = time.perf_counter()
        while self._running:
            self._step()
            if seconds is not None and time.perf_counter() - begin >= seconds:
                break

    @property
    def running(self) -> bool:
        return self._running

    def _step(self) -> None:
        try:
            self.fraction = next(self._steps)
        except StopIteration as end:
            self._result, self._running = end.value, False
        except BaseException as error:
            self._error, self._running = error, False


def _ignore(_fraction: float) -> None:
    """In the background nobody is told: Blender may only be called from its own thread."""
