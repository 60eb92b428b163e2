# SPDX-License-Identifier: GPL-3.0-or-later
"""The style in which an actor goes on."""

from __future__ import annotations

from .actor import Actor
from .recorder import Taken


class Styling:
    """What style the user wants, and what the player was told."""

    def __init__(self, actor: Actor) -> None:
        self._actor = actor
        self.names: list[str] = list(actor.character.style_names) if actor.character is not None else []
        """In the order of their numbers; none where the character has no styles."""
        self.wanted = 0
        self._told = 0

    def want(self, style: int) -> None:
        """Go on in this style from the next step."""
        self.wanted = style

    def step_by(self, step: int) -> None:
        """Go on in the next style, or the one before it; after the last comes the first."""
        if self.names:
            self.wanted = (self.wanted + step) % len(self.names)

    def reset(self, style: int) -> None:
        """The player begins anew in this style."""
        self.wanted = self._told = style

    def forget_told(self) -> None:
        """Tell the player anew what it may wait for: a recording begins."""
        self._told = self._actor.style

    def tell(self, taken: Taken | None) -> None:
        """Let the player change to what is wanted; while it is recorded, with the controls."""
        style = self.wanted if taken is None else taken.hold_style(self.wanted)
        if style != self._told:
            self._actor.player.change_style(style)
            self._told = style

    @property
    def words(self) -> str:
        """The style that plays, and the one that waits for its moment; empty where there are no styles."""
        if not self.names:
            return ""
        playing, waiting = self.names[self._actor.style], self._actor.player.waiting_style
        return playing if waiting < 0 else f"{playing}, then {self.names[waiting]}"
