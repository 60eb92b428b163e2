# SPDX-License-Identifier: GPL-3.0-or-later
"""The keyboard as a stick."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from .steering import HALF, REST, Intent

DEFAULT_KEYS = {
    "forward": "W",
    "back": "S",
    "left": "A",
    "right": "D",
    "run": "LEFT_SHIFT",
    "turn_left": "Q",
    "turn_right": "E",
    "jump": "SPACE",
    "record": "R",
    "previous_style": "LEFT_BRACKET",
    "next_style": "RIGHT_BRACKET",
}
"""What a key does, and the key that does it unless the user chose another."""

STYLE_STEPS = {"previous_style": -1, "next_style": 1}
"""What changes the style, and by how many."""

NO_KEY = "NONE"

SPARE_KEYS = {
    "UP_ARROW": "forward",
    "DOWN_ARROW": "back",
    "LEFT_ARROW": "left",
    "RIGHT_ARROW": "right",
    "RIGHT_SHIFT": "run",
}
"""Keys that do it as well, unless the user gave them something else to do."""


class Keyboard:
    """The keys that are held down."""

    label = "Keyboard"

    def __init__(self, keys: Mapping[str, str], moves: Sequence[str] = ()) -> None:
        """`keys`: what a key does, and the key; `moves`: the key of each move."""
        self._move_of = {key: move for move, key in enumerate(moves) if key != NO_KEY}
        starts = {key: f"move {move}" for key, move in self._move_of.items()}
        self._action_of = {**SPARE_KEYS, **starts, **{key: action for action, key in keys.items()}}
        self._held: set[str] = set()
        self._tapped: set[int] = set()

    def action_of(self, key: str) -> str | None:
        """What a key does, if anything."""
        return self._action_of.get(key)

    def press(self, key: str) -> None:
        """A key that does something goes down."""
        self._held.add(key)
        if key in self._move_of:
            self._tapped.add(self._move_of[key])

    def let_go(self, key: str) -> None:
        """Any key comes up."""
        self._held.discard(key)

    def release(self) -> None:
        """All keys come up."""
        self._held.clear()

    def moves(self) -> set[int]:
        """The moves whose keys are held, or were pressed since this was last asked."""
        tapped, self._tapped = self._tapped, set()
        return tapped | {self._move_of[key] for key in self._held if key in self._move_of}

    def intent(self) -> Intent:
        held = {self._action_of[key] for key in self._held}
        right, ahead = ("right" in held) - ("left" in held), ("forward" in held) - ("back" in held)
        turn, jump = ("turn_left" in held) - ("turn_right" in held), "jump" in held
        if not (right or ahead):
            return REST._replace(turn=turn, jump=jump)
        push = (1 if "run" in held else HALF) / math.hypot(right, ahead)
        return Intent(push * right, push * ahead, turn, jump)
