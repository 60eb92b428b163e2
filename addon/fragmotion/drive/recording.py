# SPDX-License-Identifier: GPL-3.0-or-later
"""What is kept while the user records: the controls, 10 a second, and how well they were followed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..takes import TRACE_RATE
from .steering import Control

if TYPE_CHECKING:
    from fragmotion_core import Doubles


class Recording:
    """A trace that grows.

    Each control is held until the next one is due, so that the player is told just what the trace says and a replay
    shows what was seen. A jump that is pressed and let go meanwhile goes into the next control.
    """

    def __init__(self, start: tuple[float, float, float]) -> None:
        self.start = start
        self._steps = 0
        self._controls: list[Control] = []
        self._jumped = False

    def hold(self, control: Control, rate: int) -> Control:
        """The control for the next of `rate` steps a second."""
        self._jumped = self._jumped or control.jump > 0
        if self._steps * TRACE_RATE >= len(self._controls) * rate:
            self._controls.append(control._replace(jump=float(self._jumped)))
            self._jumped = False
        self._steps += 1
        return self._controls[-1]

    @property
    def seconds(self) -> float:
        return len(self._controls) / TRACE_RATE

    @property
    def trace(self) -> Doubles:
        """[T,4]"""
        return np.array(self._controls, float).reshape(-1, 4)
