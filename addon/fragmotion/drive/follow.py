# SPDX-License-Identifier: GPL-3.0-or-later
"""A view that follows the character."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

_LAG = 0.15  # s, so that the sway of the hips does not shake the view


class FollowCamera:
    """Moves what a 3D view turns around; it is put back by `release`."""

    def __init__(self) -> None:
        self._view: Any = None
        self._home = self._here = (0.0, 0.0)

    def step(self, view: Any, place: tuple[float, float], seconds: float) -> None:
        """Go after the character with a view (a RegionView3D)."""
        if self._view != view:
            self._view, self._home, self._here = view, view.view_location.copy(), place
        share = 1 - math.exp(-seconds / _LAG)
        x, y = (share * (to - here) for to, here in zip(place, self._here))
        self._here = self._here[0] + x, self._here[1] + y
        view.view_location.x += x
        view.view_location.y += y

    def release(self, views: Iterable[Any]) -> None:
        """Let the view stand where it stood, if it is still among those that there are."""
        for view in views:
            if view == self._view:
                view.view_location = self._home
        self._view = None
