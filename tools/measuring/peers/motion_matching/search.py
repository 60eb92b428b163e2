# SPDX-License-Identifier: MIT
"""The search: the frame of the database whose features are nearest to those that are wanted, exactly."""

from __future__ import annotations

import numpy as np
from fragmotion_command.evaluate.rotations import Array
from scipy.spatial import cKDTree

from tools.measuring.peers.motion_matching.library import Database

_FEW = 4  # frames that are looked at before more are


class Search:
    """Finds frames of one database."""

    def __init__(self, database: Database, ignored: int, transition_cost: float) -> None:
        """`ignored`: frames on either side of the one that plays that are not gone to."""
        self._features = database.features.astype(float)
        self._frames = np.flatnonzero(database.allowed)
        self._tree = cKDTree(self._features[self._frames], balanced_tree=False, compact_nodes=False)
        self._ignored, self._transition_cost = ignored, transition_cost

    def best(self, query: Array, playing: int, ends: bool) -> int:
        """The frame of the least squared distance from the query [27]; every other than the one that plays costs the
        transition's more. The one that plays is only left for a better one, unless its take ends there."""
        stays = np.inf if ends else float(np.sum((query - self._features[playing]) ** 2))
        if stays <= self._transition_cost:
            return playing
        found = self._nearest(query, playing, float(np.sqrt(stays - self._transition_cost)))
        return playing if found is None else found

    def _nearest(self, query: Array, playing: int, within: float) -> int | None:
        """As many frames are asked for as, at last, cannot all be ignored."""
        for count in (_FEW, 2 * self._ignored):
            distances, found = self._tree.query(query, count, distance_upper_bound=within)
            near = self._frames[found[np.isfinite(distances)]]
            others = near[np.abs(near - playing) >= self._ignored]
            if len(others):
                return int(others[0])
            if len(near) < count:
                return None
        return None
