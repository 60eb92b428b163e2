# SPDX-License-Identifier: GPL-3.0-or-later
"""A player whose body is shown taller or shorter than it has learned to be."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ..compat.core import core

if TYPE_CHECKING:
    from fragmotion_core import Character, Performance


class StretchedPlayer(core.Player):  # type: ignore[name-defined]
    """Looks at places and reaches for them where they are seen, of an object that stretches its body upwards by
    `rise`: what is heard of heights is as of the body that has learned, in metres."""

    def __init__(self, character: Character, rise: float, **options: Any) -> None:
        super().__init__(character, **options)
        self._rise = rise

    def look(self, look: int, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> None:
        """As the core's."""
        super().look(look, x, y, z / self._rise)

    def reach(
        self, hand: int, weight: float, carried: bool = False, x: float = 0.0, y: float = 0.0, z: float = 0.0
    ) -> None:
        """As the core's."""
        super().reach(hand, weight, carried, x, y, z / self._rise)

    def run(
        self,
        *of_core: Any,
        looks: Sequence[Sequence[float]] | None = None,
        reaches: Sequence[Sequence[float]] | None = None,
        **others: Any,
    ) -> Performance:
        """As the core's."""
        lowered = {
            name: [(*change[:-1], change[-1] / self._rise) for change in changes]
            for name, changes in (("looks", looks), ("reaches", reaches))
            if changes is not None
        }
        played: Performance = super().run(*of_core, **others, **lowered)
        return played
