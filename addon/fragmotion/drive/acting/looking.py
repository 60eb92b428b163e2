# SPDX-License-Identifier: GPL-3.0-or-later
"""Where an actor looks, and what it holds."""

from __future__ import annotations

from ...recordings.looks import Aim
from ...recordings.reaches import EMPTY, Holds, changes
from .actor import Actor
from .recorder import Taken


class Looking:
    """What the player was told of where to look."""

    def __init__(self, actor: Actor) -> None:
        self._actor = actor
        self._told = Aim()

    def reset(self) -> None:
        """The player begins anew, and looks as captured."""
        self._told = Aim()

    def tell(self, wanted: Aim, taken: Taken | None) -> None:
        """Let the player look there; while it is recorded, from the next control on."""
        aim = wanted if taken is None else taken.hold_look(wanted)
        if aim != self._told and self._actor.character is not None:
            self._actor.player.look(*aim)
            self._told = aim


class Holding:
    """What the player was told of what its hands reach for."""

    def __init__(self, actor: Actor) -> None:
        self._actor = actor
        self._told = EMPTY

    def reset(self) -> None:
        """The player begins anew, with empty hands."""
        self._told = EMPTY

    def tell(self, wanted: Holds, taken: Taken | None) -> None:
        """Let the hands reach for that; while it is recorded, from the next control on."""
        holds = wanted if taken is None else taken.hold_hands(wanted)
        if self._actor.character is None:
            return
        for change in changes(0, self._told, holds):
            self._actor.player.reach(change.hand, *change.hold)
        self._told = holds
