# SPDX-License-Identifier: GPL-3.0-or-later
"""A take played on its armature, on loop, as Build sees it: to be looked at before it is learned from."""

from __future__ import annotations

import bpy

from ..errors import core_errors
from ..mocap.sampling import sample
from ..rig.posing import check_free
from ..rig.rigs import carriers, make_rig
from .state.borrowed import Borrowed

current: TakeShown | None = None
"""The take that is shown now; the panel and other operators ask for it."""


class TakeShown:
    """Plays an Action from construction until `end`, which gives the armature back. The playhead stays where it is.

    UserError where the Action cannot be played; then nothing has changed.
    """

    def __init__(self, context: bpy.types.Context, obj: bpy.types.Object, action: bpy.types.Action) -> None:
        check_free(obj)
        context.view_layer.update()
        self._rig = make_rig(obj)
        carriers(obj, self._rig)
        clip = sample(context, obj, action, self._rig)
        self._rate, self._roots, self._rotations = clip.rate, clip.root_positions, clip.rotations
        self.armature, self.name = str(obj.name), str(action.name)
        self.elapsed = 0.0
        """Seconds from the take's beginning to what is shown."""
        self._shown_on = Borrowed(obj)
        try:
            self.step(0.0)
        except BaseException:
            self.end()
            raise

    @property
    def seconds(self) -> float:
        """How long the take is."""
        return len(self._roots) / self._rate

    def step(self, seconds: float) -> None:
        """Play on, from the end to the beginning again, and pose the armature."""
        self.elapsed = (self.elapsed + seconds) % self.seconds
        frame = min(int(self.elapsed * self._rate), len(self._roots) - 1)
        with core_errors(f"Take '{self.name}'"):
            locations, turns = self._rig.channels(self._roots[frame][None], self._rotations[frame][None])
        self._shown_on.pose(locations[0], turns[0])

    def trouble(self) -> str:
        """Why it cannot play on, empty where it can."""
        return self._shown_on.trouble()

    def end(self) -> None:
        """Give the armature back as it was; one that was deleted stays deleted."""
        self._shown_on.give_back()


def show(context: bpy.types.Context, obj: bpy.types.Object, action: bpy.types.Action) -> None:
    """Show a take, in place of the one that is shown; UserError where it cannot be."""
    global current
    stop()
    current = TakeShown(context, obj, action)


def stop() -> None:
    """Show no take any more."""
    global current
    shown, current = current, None
    if shown is not None:
        shown.end()
