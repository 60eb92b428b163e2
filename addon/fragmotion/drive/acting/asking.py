# SPDX-License-Identifier: GPL-3.0-or-later
"""What an actor's player is asked for beside its control."""

from __future__ import annotations

from ...recordings.looks import Aim
from ...recordings.reaches import Holds
from .actor import Actor
from .looking import Holding, Looking
from .punch import Punch
from .recorder import Taken
from .styling import Styling


class Asking:
    """The moves that are held, the style, where to look and what hands hold: the user's, and those of a recording that
    is recorded over."""

    def __init__(self, actor: Actor) -> None:
        self._actor = actor
        self.styling, self._looking, self._holding = Styling(actor), Looking(actor), Holding(actor)
        self._held: set[int] = set()
        self._own_held: set[int] = set()  # those that the recording holds
        self._own_style = 0  # that it was in last

    def begin(self, style: int) -> None:
        """The player begins anew, in this style, which a recording may be in."""
        self.styling.reset(style)
        self.start_afresh()
        self._own_style = style

    def start_afresh(self) -> None:
        """The player begins anew, in the style that it plays."""
        self._looking.reset()
        self._holding.reset()
        self._held = set()

    def is_touched(self, held: set[int]) -> bool:
        """Whether the user asks for anything that the recording does not."""
        return bool(held) or self.styling.wanted != self._own_style

    def tell(self, held: set[int], aim: Aim, holds: Holds, taken: Taken | None, punch: Punch | None) -> None:
        """Tell the player what the next step asks for, where the user holds these moves: first what a recording does
        that is recorded over. `taken` keeps what the user does."""
        if punch is not None:
            self._own_held = self._hold_moves(self._own_held, punch.moves)
        if punch is not None and not punch.takes:
            held = set()
            self.styling.want(punch.style)
            self._own_style = punch.style
        self._held = self._hold_moves(self._held, held if taken is None else taken.hold_moves(held))
        self.styling.tell(taken)
        self._looking.tell(aim, taken if punch is None else None)
        self._holding.tell(holds, taken if punch is None else None)

    def hand_back(self) -> None:
        """The rest of the recording plays: what it holds is the user's from now on."""
        self._held, self._own_held = self._hold_moves(self._held, set()) | self._own_held, set()

    def _hold_moves(self, before: set[int], held: set[int]) -> set[int]:
        """Let go of the moves that are not held any more, and start those that are held since this step."""
        for move in sorted(before - held):
            self._actor.player.release_move(move)
        for move in sorted(held - before):
            self._actor.player.start_move(move)
        return held
