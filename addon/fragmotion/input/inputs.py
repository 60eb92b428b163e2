# SPDX-License-Identifier: GPL-3.0-or-later
"""All that a user can drive with, in one place."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from .arbiter import Arbiter
from .keyboard import Keyboard
from .pads import STYLE_BUTTONS, Pad, Pads
from .screen_stick import ScreenStick
from .sdl import SdlMissing
from .steering import REST, Intent
from .tracing import TraceInput
from .walk_target import WalkTarget


class Inputs:
    """Keyboard, on-screen stick, trace, clicks and the pads that are connected. Open until `close`."""

    def __init__(self, preferences: Any, rate: int, moves: Sequence[tuple[str, str]] = ()) -> None:
        """`moves`: the key and the button of each."""
        self.keyboard = Keyboard(preferences.keys(), [key for key, _ in moves])
        self.stick, self.trace, self.target = ScreenStick(), TraceInput(rate), WalkTarget()
        self._move_of = {button: move for move, (_, button) in enumerate(moves)}
        self._arbiter = Arbiter((self.keyboard, self.stick, self.trace, self.target))
        self._pads: Pads | None = None
        self._record_pressed = False
        self._spent: set[int] = set()  # moves that are held still, but count no more
        self._style_pressed: set[str] = set()
        self.shown = REST
        """The last intent, for drawing."""
        self.messages: list[str] = []
        """What the user should be told; who tells it clears it."""
        try:
            self._pads = Pads(preferences)
        except SdlMissing as missing:
            self.messages.append(str(missing))

    def poll(self) -> bool:
        """Look at the pads; say whether a record button has gone down."""
        if self._pads is None:
            return False
        come, gone = self._pads.poll()
        for pad in come:
            self._arbiter.add(pad)
        for pad in gone:
            drove = self._arbiter.current is pad
            self._arbiter.remove(pad)
            self.messages.append(f"{pad.label} is gone{': the character stands' if drove else ''}")
        pressed = any(pad.state.record for pad in self._pads.pads)
        self._record_pressed, before = pressed, self._record_pressed
        return pressed and not before

    def intent(self) -> Intent:
        """What the input says that was touched last."""
        self.shown = self._arbiter.intent()
        return self.shown

    def moves(self) -> set[int]:
        """The moves that any input holds now."""
        by_user = self._moves_by_user()
        self._spent &= by_user
        return (by_user - self._spent) | self.trace.moves()

    def spend_moves(self) -> None:
        """Let the moves that the user holds now count no more until they are let go and pressed again."""
        self._spent = self._moves_by_user()

    def _moves_by_user(self) -> set[int]:
        pressed = {button for pad in self.pads for button in pad.state.buttons}
        return self.keyboard.moves() | {self._move_of[button] for button in pressed if button in self._move_of}

    def play(self, trace: Any, moves: Any = (), styles: Any = (), looks: Any = (), reaches: Any = ()) -> None:
        """Let a trace [T,4] drive with the moves [M,3] that were started, the styles [S,2] that were changed, the
        looks and the reaches in it, until it ends or another input is touched."""
        self.trace.play(trace, moves, styles, looks, reaches)
        self._arbiter.take(self.trace)

    def walk(self, space: Any, frame: tuple[float, float, float], place: tuple[float, float], runs: bool) -> None:
        """Let the character go to a place, until it is there or another input is touched."""
        if self.target.go(space, frame, place, runs):
            self._arbiter.take(self.target)

    def style_step(self) -> int:
        """By how many styles to go on, or back, as pads' buttons say that have gone down since this was last asked; a
        button that starts a move does that alone."""
        pressed = {button for pad in self.pads for button in pad.state.buttons}
        fresh, self._style_pressed = pressed - self._style_pressed, pressed
        return sum(STYLE_BUTTONS.get(button, 0) for button in fresh if button not in self._move_of)

    @property
    def label(self) -> str:
        """The input that drives, in words."""
        return "" if self._arbiter.current is None else self._arbiter.current.label

    @property
    def by_pad(self) -> bool:
        """Whether a pad drives."""
        return isinstance(self._arbiter.current, Pad)

    @property
    def pads(self) -> list[Pad]:
        """The pads that are connected."""
        return [] if self._pads is None else self._pads.pads

    def close(self) -> None:
        """Let go of the pads and of SDL."""
        if self._pads is not None:
            self._pads.close()
        self._pads = None
