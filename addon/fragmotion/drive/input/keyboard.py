# SPDX-License-Identifier: GPL-3.0-or-later
"""The keyboard as a stick."""

from __future__ import annotations

import math
from collections.abc import Mapping

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
}
"""What a key does, and the key that does it unless the user chose another."""

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

    def __init__(self, keys: Mapping[str, str]) -> None:
        self._action_of = {**SPARE_KEYS, **{key: action for action, key in keys.items()}}
        self._held: set[str] = set()

    def action_of(self, key: str) -> str | None:
        """What a key does, if anything."""
        return self._action_of.get(key)

    def press(self, key: str) -> None:
        """A key that does something goes down."""
        self._held.add(key)

    def let_go(self, key: str) -> None:
        """Any key comes up."""
        self._held.discard(key)

    def release(self) -> None:
        """All keys come up."""
        self._held.clear()

    def intent(self) -> Intent:
        held = {self._action_of[key] for key in self._held}
        right, ahead = ("right" in held) - ("left" in held), ("forward" in held) - ("back" in held)
        turn, jump = ("turn_left" in held) - ("turn_right" in held), "jump" in held
        if not (right or ahead):
            return REST._replace(turn=turn, jump=jump)
        push = (1 if "run" in held else HALF) / math.hypot(right, ahead)
        return Intent(push * right, push * ahead, turn, jump)
