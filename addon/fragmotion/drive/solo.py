# SPDX-License-Identifier: GPL-3.0-or-later
"""One class alone on its armature: fragment after fragment, each drawn at random and stitched on."""

from __future__ import annotations

import math
from itertools import count

import bpy

from ..character import building
from ..compat.core import core
from ..errors import core_errors
from ..rig.posing import check_free
from ..rig.rigs import make_rig
from .state.borrowed import Borrowed

_STAND = (0.0, 0.0, 0.0, 0.0)
_FURTHEST = 3.0  # m that a character of 1.8 m goes before it begins again where the armature stood
_INSTANT = 1e-6  # s


class Solo:
    """Plays a class from where the armature stands until `end`, which gives it back. The playhead stays where it is."""

    def __init__(self, context: bpy.types.Context, obj: bpy.types.Object, number: int, style: int = 0) -> None:
        character = building.load_whole(obj)
        check_free(obj)
        context.view_layer.update()
        self._rig, self._number, self._style = make_rig(obj), number, style
        building.check_skeleton(obj, character, self._rig)
        place = obj.matrix_world
        self._place = (place.translation.x, place.translation.y, place.to_euler().z + math.pi)
        self._reach = _FURTHEST / character.space.scale
        self._durations = character.in_style(style).fragment_durations
        self._character, self._seeds = character, count(1)
        self._begin()
        self._armature = Borrowed(obj)

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
        with core_errors(f"Armature '{self._armature.name}'"):
            locations, turns = self._rig.channels(root[None], rotations[None])
        self._armature.pose(locations[0], turns[0])
        if math.dist(root[:2], self._place[:2]) > self._reach:
            self._begin()

    def trouble(self) -> str:
        """Why it cannot play on, empty where it can."""
        return self._armature.trouble()

    def end(self) -> None:
        """Give the armature back as it was; one that was deleted stays deleted."""
        self._armature.give_back()

    def _begin(self) -> None:
        """Begin again where the armature stood, with other fragments than before: a reset player draws the same."""
        self._player = core.Player(self._character, seed=next(self._seeds))
        self._player.reset(*self._place, style=self._style)
        self._next()

    def _next(self) -> None:
        """Go over to another fragment of the class; it is left just before its end, where the policy would choose."""
        self._player.force(self._number)
        self._player.step(_STAND, _INSTANT)
        self._left = float(self._durations[self.playing[1]]) - 2 * _INSTANT
