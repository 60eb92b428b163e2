# SPDX-License-Identifier: GPL-3.0-or-later
"""What is shown on an armature beside a drive, on loop: to be looked at before it is learned from, or played."""

from __future__ import annotations

import bpy

from ..mocap.sampling import rig_as_posed
from ..rig.posing import check_free
from .posed_armature import PosedArmature

current: Preview | None = None
"""What is shown now; panels and other operators ask for it."""


class Preview:
    """Plays something from construction until `end`, which gives the armature back. The playhead stays where it is.

    UserError where it cannot be played; then nothing has changed.
    """

    name: str
    """What is shown, for a message: Take 'NAME'."""

    def __init__(self, context: bpy.types.Context, obj: bpy.types.Object) -> None:
        check_free(obj)
        context.view_layer.update()
        self.obj, self._rig = obj, rig_as_posed(obj)

    def _begin(self) -> None:
        """Let the armature show the first pose: the last that may fail."""
        self._armature = PosedArmature(self.obj, self._rig)
        try:
            self.step(0.0)
        except BaseException:
            self.end()
            raise

    def step(self, seconds: float) -> None:
        """Play on and pose the armature; UserError where it cannot be posed."""
        raise NotImplementedError

    def trouble(self) -> str:
        """Why it cannot play on, empty where it can."""
        return self._armature.trouble()

    def end(self) -> None:
        """Give the armature back as it was; one that was deleted stays deleted."""
        self._armature.give_back()


def show(preview: Preview) -> None:
    """Have this shown from now on; nothing else is."""
    global current
    current = preview


def stop() -> None:
    """Show nothing any more. The operator that lets it play ends itself when it is woken next."""
    global current
    preview, current = current, None
    if preview is not None:
        preview.end()
