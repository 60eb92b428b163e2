# SPDX-License-Identifier: GPL-3.0-or-later
"""What is kept while the user records: the controls, 10 a second, and the poses that are shown."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...recordings.recordings import TRACE_RATE
from ...rig.motion import Motion
from ..input.steering import Control
from .actor import Actor

if TYPE_CHECKING:
    from fragmotion_core import Doubles


class Recorder:
    """A trace that grows, and the motion with it.

    Each control is held until the next one is due, so that the player is told just what the trace says. A jump that is
    pressed and let go meanwhile goes into the next control.
    """

    def __init__(self, actor: Actor, rate: int) -> None:
        """From where the actor is now, in so many steps a second."""
        self.start = actor.frame
        self._actor, self._rate = actor, rate
        self._controls: list[Control] = []
        self._jumped = False
        self._poses: list[tuple[Doubles, Doubles]] = []
        self._frames: list[tuple[float, float, float]] = []
        self._classes: list[int] = []
        self.add(actor.step(Control(), 0.0))

    def hold(self, control: Control) -> Control:
        """The control for the next step."""
        self._jumped = self._jumped or control.jump > 0
        if (len(self._poses) - 1) * TRACE_RATE >= len(self._controls) * self._rate:
            self._controls.append(control._replace(jump=float(self._jumped)))
            self._jumped = False
        return self._controls[-1]

    def add(self, pose: tuple[Doubles, Doubles]) -> None:
        """The step has led to this pose."""
        if self._actor.character is not None:
            self._classes.append(self._actor.player.playing[0])
        self._poses.append(pose)
        self._frames.append(self._actor.frame)

    @property
    def seconds(self) -> float:
        return len(self._controls) / TRACE_RATE

    @property
    def trace(self) -> Doubles:
        """[T,4]"""
        return np.array(self._controls, float).reshape(-1, 4)

    @property
    def shown(self) -> tuple[Doubles, Motion] | None:
        """The times [F] in seconds and the poses that were shown; None where the body only slid."""
        if not self._classes:
            return None
        roots, rotations = zip(*self._poses)
        motion = Motion(np.array(roots), np.array(rotations), np.array(self._frames), np.array(self._classes, np.int32))
        return np.arange(len(roots)) / self._rate, motion
