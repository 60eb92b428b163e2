# SPDX-License-Identifier: GPL-3.0-or-later
"""A crowd whose members keep clear of each other: their traces are made together, when the first one is asked for."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from mathutils import Matrix

from ..compat.core import core
from ..errors import core_errors
from ..jobs import Report

if TYPE_CHECKING:
    from fragmotion_core import Doubles, PaintedArea, Path, Player

RADIUS = 0.4
"""m of a 1.8 m character, which each has to itself, and off the edge of an area."""

_NO_ROOM = 1e-6  # of one who pays no heed

Spot = tuple[float, float, float]


class Together:
    """What the members share: the outlines of what stands around, m, how long they go, s, how paths are followed,
    whether they heed each other at all, the area that none leaves, and who else is about, as core.keep_clear() says."""

    def __init__(
        self,
        obstacles: Sequence[Any],
        seconds: float,
        follow: dict[str, Any],
        heeds: bool = True,
        area: PaintedArea | None = None,
        passers_by: Sequence[Doubles] = (),
    ) -> None:
        self._obstacles, self._seconds, self._follow, self._area = obstacles, seconds, follow, area
        self._passers_by = passers_by
        self._radius = RADIUS if heeds else _NO_ROOM
        self._members: list[Member] = []
        self._traces: list[Doubles] = []

    def add(self, wish: Path | Doubles, start: Spot, moved: Matrix) -> Member:
        """One who would do this alone (as core.keep_clear() says) from a character frame on, and is to be moved."""
        member = Member(self, len(self._members), wish, start, moved)
        self._members.append(member)
        return member

    def trace(self, number: int, rate: float, report: Report) -> Doubles:
        """What a member does, so many frames a second."""
        if not self._traces:
            members = self._members
            with core_errors("Populate"):
                self._traces = core.keep_clear(
                    [member.player for member in members],
                    [member.wish for member in members],
                    [_world(member.moved) for member in members],
                    obstacles=self._obstacles,
                    seconds=self._seconds,
                    rate=rate,
                    progress=report,
                    radius=self._radius / members[0].player_scale,
                    area=self._area,
                    passers_by=self._passers_by,
                    **self._follow,
                )
        return self._traces[number]


class Member:
    """One of a crowd, as a paths.following.Walk: who enters it is its player."""

    player: Player
    player_scale: float

    def __init__(self, crowd: Together, number: int, wish: Path | Doubles, start: Spot, moved: Matrix) -> None:
        self._crowd, self._number = crowd, number
        self.wish, self._start, self.moved = wish, start, moved

    def enter(self, player: Player, scale: float) -> None:
        """It is this player, in its style, of a body that is so much smaller than 1.8 m."""
        self.player, self.player_scale = player, scale
        self._begin()

    def trace(self, _player: Player, rate: float, report: Report) -> Doubles:
        """What it does [T,4]; then the player stands at the beginning again, to be run at this rate."""
        trace = self._crowd.trace(self._number, rate, report)
        self._begin()
        return trace

    def _begin(self) -> None:
        self.player.reset(*self._start, style=self.player.playing_style)


def _world(moved: Matrix) -> tuple[float, float, float, float]:
    """Where the origin goes, how it is turned, and by how much all is larger."""
    x, y, _ = moved.translation
    return x, y, math.remainder(moved.to_euler().z, 2 * math.pi), moved.to_scale().x
