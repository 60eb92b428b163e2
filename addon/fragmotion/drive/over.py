# SPDX-License-Identifier: GPL-3.0-or-later
"""A drive by a recording over which the user is recorded."""

from __future__ import annotations

import bpy

from ..edits.replaying import play_again
from ..errors import UserError
from ..input.inputs import Inputs
from ..input.steering import REST, Intent
from ..recordings.curves import renew_curves
from ..recordings.recordings import TRACE_RATE
from .acting.actor import Actor
from .acting.asking import Asking
from .acting.punch import Punch
from .hud import timeline


class Over:
    """Lets the user take over in a stretch, and keeps that."""

    def __init__(self, obj: bpy.types.Object, punch: Punch, actor: Actor, asking: Asking, inputs: Inputs) -> None:
        self._obj, self.punch = obj, punch
        self._actor, self._asking, self._inputs = actor, asking, inputs

    def offer(self, intent: Intent, held: set[int]) -> None:
        """Let the user take over by a stick, a move or another style."""
        if self.punch.offer(intent != REST or self._asking.is_touched(held), intent.jump, held):
            self._actor.take_over()

    def keep(self) -> tuple[bool, str]:
        """Give the recording what was recorded over it, and let the rest play; whether there was anything, and what the
        user should be told. It goes on playing where it was recorded as it is."""
        punch, recording = self.punch, self._obj.fragmotion.recordings.get(self.punch.own.name)
        if recording is None:
            return False, ""
        timeline.tag_redraw()
        try:
            if punch.begun:
                play_again(self._obj, recording, punch.trace, punch.first, punch.asked)
        except UserError as error:
            return False, str(error)
        self._go_on()
        if not punch.begun:
            return False, f"Nothing was touched: '{recording.name}' is as it was"
        renew_curves(self._obj, recording)
        first, end = punch.first / TRACE_RATE, punch.first / TRACE_RATE + punch.taken.seconds
        return True, f"Kept: '{recording.name}' is recorded over from {first:.1f} s to {end:.1f} s"

    def _go_on(self) -> None:
        """Let the rest of the recording play."""
        self._asking.hand_back()
        self._inputs.spend_moves()
        self._inputs.play(*self.punch.rest)
        self._actor.take_over()
