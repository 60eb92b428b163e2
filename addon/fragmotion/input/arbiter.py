# SPDX-License-Identifier: GPL-3.0-or-later
"""All inputs at once: the last one touched drives."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol

from .steering import REST, Intent

_MOVED = 0.1  # of the stick's or the turn's range: less is a hand that trembles


class Source(Protocol):
    """An input."""

    @property
    def label(self) -> str:
        """What the user calls it."""

    def intent(self) -> Intent:
        """What it says now."""

    def release(self) -> None:
        """Another one drives now: let go of everything."""


class Arbiter:
    """Which of the sources drives."""

    def __init__(self, sources: Iterable[Source]) -> None:
        self._last = {source: REST for source in sources}
        self.current: Source | None = None

    def add(self, source: Source) -> None:
        """One more input, untouched."""
        self._last[source] = REST

    def remove(self, source: Source) -> None:
        """An input is gone."""
        self._last.pop(source, None)
        if self.current is source:
            self.current = None

    def take(self, source: Source) -> None:
        """Let a source drive."""
        if self.current is not None and self.current is not source:
            self.current.release()
        self.current = source

    def intent(self) -> Intent:
        """What the source says that was last touched; a source is touched where it moves and does not just let go."""
        for source, last in self._last.items():
            now = source.intent()
            if _differ(now, last):
                self._last[source] = now
                if now != REST and now.control is None:
                    self.take(source)
        return REST if self.current is None else self.current.intent()


def _differ(now: Intent, last: Intent) -> bool:
    moved = max(abs(now.right - last.right), abs(now.ahead - last.ahead), abs(now.turn - last.turn))
    return moved > _MOVED or now.jump != last.jump or (now == REST and last != REST)
