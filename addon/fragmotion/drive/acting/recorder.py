# SPDX-License-Identifier: GPL-3.0-or-later
"""What is kept while the user records: the controls, 10 a second, and the poses that are shown."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from ...character.moves import names_of
from ...input.steering import Control
from ...recordings.asked import StartedMove
from ...recordings.looks import Aim, LookChange
from ...recordings.reaches import EMPTY, Holds, ReachChange, changes
from ...recordings.recordings import TRACE_RATE
from ...recordings.styles import StyleChange
from ...rig.motion import Motion
from .actor import Actor

if TYPE_CHECKING:
    from fragmotion_core import Character, Doubles


class Taken:
    """What the user does, as a trace that grows, with moves, styles and looks beside it.

    Each control is held until the next one is due, so that the player is told just what the trace says. A jump that is
    pressed and let go meanwhile goes into the next control.
    """

    def __init__(self, character: Character | None, style: int, rate: int) -> None:
        """By a character, or what slides, that goes on in a style; in so many steps a second."""
        self._rate, self._steps = rate, 0
        self._controls: list[Control] = []
        self._jumped = False
        self._begins = False  # whether this step is the first of its control
        self._names = names_of(character)
        self._started: list[StartedMove] = []
        self._held: dict[int, int] = {}  # the moves that are held, and which of those started each is
        self._tapped: set[int] = set()
        self.style_names = list(character.style_names) if character is not None else []
        self.style_now = style
        self.styles: list[StyleChange] = []
        """Those to which it changed."""
        self._aim = Aim()
        self.looks: list[LookChange] = []
        """Where it looked."""
        self._holds = EMPTY
        self.reaches: list[ReachChange] = []
        """What hands reached for."""

    def hear(self, jump: bool, held: set[int]) -> None:
        """What is pressed before its first control goes into that, also where it is let go meanwhile."""
        self._jumped = self._jumped or jump
        self._tapped |= held

    def hold(self, control: Control) -> Control:
        """The control for the next step."""
        self._jumped = self._jumped or control.jump > 0
        self._begins = self._steps * TRACE_RATE >= len(self._controls) * self._rate
        self._steps += 1
        if self._begins:
            self._controls.append(control._replace(jump=float(self._jumped)))
            self._jumped = False
        return self._controls[-1]

    def hold_moves(self, held: set[int]) -> set[int]:
        """The moves that are held in the next step, whose control `hold` has told: they change with the controls."""
        self._tapped |= held - self._held.keys()
        if self._begins:
            now = held | self._tapped
            self._let_go(self._held.keys() - now)
            for move in sorted(now - self._held.keys()):
                self._held[move] = len(self._started)
                self._started.append(StartedMove(len(self._controls) - 1, self._names[move], 0))
            self._tapped = set()
        return set(self._held)

    def _let_go(self, moves: Iterable[int]) -> None:
        now = len(self._controls) - 1
        for move in list(moves):
            index = self._held.pop(move)
            self._started[index] = self._started[index]._replace(held=now - self._started[index].control)

    def hold_style(self, wanted: int) -> int:
        """The style of the next step, whose control `hold` has told: it changes with the controls."""
        if self._begins and wanted != self.style_now:
            self.style_now = wanted
            self.styles.append(StyleChange(len(self._controls) - 1, self.style_names[wanted]))
        return self.style_now

    def hold_look(self, wanted: Aim) -> Aim:
        """Where to look in the next step, whose control `hold` has told: it changes with the controls."""
        if self._begins and not self._aim.is_like(wanted):
            self._aim = wanted
            self.looks.append(LookChange(len(self._controls) - 1, *wanted))
        return self._aim

    def hold_hands(self, wanted: Holds) -> Holds:
        """What hands reach for in the next step, likewise."""
        if self._begins:
            new = changes(len(self._controls) - 1, self._holds, wanted)
            self.reaches += new
            self._holds = wanted if new else self._holds
        return self._holds

    @property
    def seconds(self) -> float:
        return len(self._controls) / TRACE_RATE

    @property
    def moves(self) -> list[StartedMove]:
        """Those that were started; what is held still is held to the end."""
        controls, held = len(self._controls), set(self._held.values())
        return [
            move._replace(held=controls - move.control) if index in held else move
            for index, move in enumerate(self._started)
        ]

    @property
    def trace(self) -> Doubles:
        """[T,4]"""
        return np.array(self._controls, float).reshape(-1, 4)


class Recorder(Taken):
    """What the user does from a moment on, and the motion with it."""

    def __init__(self, actor: Actor, rate: int) -> None:
        """From where the actor is now, in so many steps a second."""
        super().__init__(actor.character, actor.style, rate)
        self.start = actor.frame
        self._actor = actor
        self.style = self.style_names[self.style_now] if self.style_names else ""
        """The one in which it begins."""
        self._poses: list[tuple[Doubles, Doubles]] = []
        self._frames: list[tuple[float, float, float]] = []
        self._classes: list[int] = []
        self.add(actor.step(Control(), 0.0))

    def add(self, pose: tuple[Doubles, Doubles]) -> None:
        """The step has led to this pose."""
        if self._actor.character is not None:
            self._classes.append(self._actor.player.playing[0])
        self._poses.append(pose)
        self._frames.append(self._actor.frame)

    @property
    def shown(self) -> tuple[Doubles, Motion] | None:
        """The times [F] in seconds and the poses that were shown; None where the body only slid."""
        if not self._classes:
            return None
        roots, rotations = zip(*self._poses)
        motion = Motion(np.array(roots), np.array(rotations), np.array(self._frames), np.array(self._classes, np.int32))
        return np.arange(len(roots)) / self._rate, motion
