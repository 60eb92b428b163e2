# SPDX-License-Identifier: GPL-3.0-or-later
"""A take played on its armature, on loop, as Build sees it: to be looked at before it is learned from."""

from __future__ import annotations

import bpy

from ..mocap.sampling import sample
from ..rig.rigs import carriers
from .previews import Preview


class TakePreview(Preview):
    """Plays an Action from its beginning, again and again."""

    def __init__(self, context: bpy.types.Context, obj: bpy.types.Object, action: bpy.types.Action) -> None:
        super().__init__(context, obj)
        carriers(obj, self._rig)
        clip = sample(context, obj, action, self._rig)
        self._rate, self._roots, self._rotations = clip.rate, clip.root_positions, clip.rotations
        self.name, self._elapsed = f"Take '{action.name}'", 0.0
        self._begin()

    @property
    def seconds(self) -> float:
        """How long the take is."""
        return len(self._roots) / self._rate

    def step(self, seconds: float) -> None:
        """Play on, from the end to the beginning again, and pose the armature."""
        self._elapsed = (self._elapsed + seconds) % self.seconds
        frame = min(int(self._elapsed * self._rate), len(self._roots) - 1)
        self._armature.pose(self._roots[frame], self._rotations[frame])
