# SPDX-License-Identifier: GPL-3.0-or-later
"""One long computation in a thread of its own, so that Blender stays usable."""

from __future__ import annotations

import threading
from collections.abc import Callable
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


def _ignore(_fraction: float) -> None:
    """In the background nobody is told: Blender may only be called from its own thread."""
