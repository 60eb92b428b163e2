# SPDX-License-Identifier: GPL-3.0-or-later
"""One class alone on its armature: fragment after fragment, each drawn at random and stitched on."""

from __future__ import annotations

import math
from itertools import count

import bpy

from ..character import building
from ..compat.core import core
from .previews import Preview

_STAND = (0.0, 0.0, 0.0, 0.0)
_FURTHEST = 3.0  # m that a character of 1.8 m goes before it begins again where the armature stood
_INSTANT = 1e-6  # s


class ClassPreview(Preview):
    """Plays a class from where the armature stands."""

    def __init__(self, context: bpy.types.Context, obj: bpy.types.Object, number: int, style: int = 0) -> None:
        super().__init__(context, obj)
        character = building.load_whole(obj)
        building.check_skeleton(obj, character, self._rig)
        place = obj.matrix_world
        self._place = (place.translation.x, place.translation.y, place.to_euler().z + math.pi)
        self._reach = _FURTHEST / character.space.scale
        self._durations = character.in_style(style).fragment_durations
        self._character, self._number, self._style, self._seeds = character, number, style, count(1)
        self.name = f"Class {number}"
        self._begin_again()
        self._begin()

    @property
    def playing(self) -> tuple[int, int]:
        """The class and the fragment that play."""
        number, fragment = self._player.playing
        return int(number), int(fragment)

    def step(self, seconds: float) -> None:
        """Play on and pose the armature; UserError where it comes to stand too far from the world's origin."""
        while seconds > self._left:
            self._player.step(_STAND, self._left)
            seconds -= self._left
            self._next()
        root, rotations = self._player.step(_STAND, seconds)
        self._left -= seconds
        self._armature.pose(root, rotations)
        if math.dist(root[:2], self._place[:2]) > self._reach:
            self._begin_again()

    def _begin_again(self) -> None:
        """Begin where the armature stood, with other fragments than before: a reset player draws the same."""
        self._player = core.Player(self._character, seed=next(self._seeds))
        self._player.reset(*self._place, style=self._style)
        self._next()

    def _next(self) -> None:
        """Go over to another fragment of the class; it is left just before its end, where the policy would choose."""
        self._player.force(self._number)
        self._player.step(_STAND, _INSTANT)
        self._left = float(self._durations[self.playing[1]]) - 2 * _INSTANT
