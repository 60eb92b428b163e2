# SPDX-License-Identifier: GPL-3.0-or-later
"""One class alone on its armature: fragment after fragment, each drawn at random and stitched on."""

from __future__ import annotations

import math
from contextlib import ExitStack, nullcontext, suppress
from itertools import count
from typing import TYPE_CHECKING

import bpy

from ..compat.core import core
from ..compat.data_blocks import is_alive
from ..errors import core_errors
from ..rig import posing
from ..rig.keys import from_quaternions
from ..rig.rigs import make_rig
from . import building

if TYPE_CHECKING:
    from fragmotion_core import Doubles

_STAND = (0.0, 0.0, 0.0, 0.0)
_FURTHEST = 3.0  # m that a character of 1.8 m goes before it begins again where the armature stood
_INSTANT = 1e-6  # s
_POSED = ("location", "rotation_quaternion", "rotation_euler", "rotation_axis_angle")


class Solo:
    """Plays a class from where the armature stands until `end`, which puts armature and scene back."""

    def __init__(self, context: bpy.types.Context, obj: bpy.types.Object, number: int, style: int = 0) -> None:
        character = building.load_whole(obj)
        context.view_layer.update()
        self._rig, self._obj, self._number, self._style = make_rig(obj), obj, number, style
        building.check_skeleton(obj, character, self._rig)
        place = obj.matrix_world
        self._name, self._data, self._bones = obj.name, obj.data, len(obj.pose.bones)
        self._place = (place.translation.x, place.translation.y, place.to_euler().z + math.pi)
        self._reach = _FURTHEST / character.space.scale
        self._order = [obj.data.bones.find(bone.name) for bone in obj.pose.bones]
        self._durations = character.in_style(style).fragment_durations
        self._character, self._seeds = character, count(1)
        self._begin()
        self._stack = ExitStack()
        self._stack.enter_context(posing.playing(context, obj, None))

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
        with core_errors(f"Armature '{self._name}'"):
            channels = self._rig.channels(root[None], rotations[None])
        self._pose(*channels)
        if math.dist(root[:2], self._place[:2]) > self._reach:
            self._begin()

    def trouble(self) -> str:
        """Why it cannot play on, empty where it can."""
        if not is_alive(self._obj):
            return f"Armature '{self._name}' was deleted"
        changed = self._obj.data != self._data or len(self._obj.pose.bones) != self._bones
        return f"The bones of armature '{self._obj.name}' were changed" if changed else ""

    def end(self) -> None:
        """Put armature and scene back; an armature that was deleted stays deleted."""
        with nullcontext() if is_alive(self._obj) else suppress(ReferenceError):
            self._stack.close()

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

    def _pose(self, locations: Doubles, rotations: Doubles) -> None:
        """Write a pose to all bones at once, of which Blender is told once."""
        values = {channel: posing.get_channel(self._obj, channel).reshape(len(self._order), -1) for channel in _POSED}
        values["location"][:] = locations[0, self._order]
        for row, (bone, turn) in enumerate(zip(self._obj.pose.bones, rotations[0, self._order])):
            channel, turned = from_quaternions(bone.rotation_mode, turn[None])
            values[channel][row] = turned[0]
        for channel, rows in values.items():
            self._obj.pose.bones.foreach_set(channel, rows.ravel())
        self._obj.update_tag()
