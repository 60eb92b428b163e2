# SPDX-License-Identifier: GPL-3.0-or-later
"""From what the user's hands say to the control that the core gets, in the character frame."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from ..compat.core import core

if TYPE_CHECKING:
    from fragmotion_core import ControlSpace

HALF = 0.5
"""How far the stick is pushed for a walk; fully pushed it is a run."""

_RUNS = 0.75  # of the stick's way; the speed beyond is nearer to a run
_ON_THE_SPOT = math.radians(100)  # off by more, a character that turns well stops for it
_BEHIND = math.radians(160)  # off by more, a turn goes on to the side on which it began


class Control(NamedTuple):
    """Velocity to the right and forward in m/s, turn (1 is left at the character's turn rate; more where it has to face
    about), and jump 0 or 1, as the character sees it."""

    right: float = 0.0
    forward: float = 0.0
    turn: float = 0.0
    jump: float = 0.0


class Intent(NamedTuple):
    """What the hands say: a stick within the unit circle, a turn from -1 to 1 (left), a jump button.

    A `control` goes to the core as it is, whatever the rest says: that of a trace.
    """

    right: float = 0.0
    ahead: float = 0.0
    turn: float = 0.0
    jump: bool = False
    control: Control | None = None


REST = Intent()


def respond(x: float, y: float, dead_zone: float, curve: float) -> tuple[float, float]:
    """A stick's raw position to one within the unit circle: nothing in the dead zone, then rising as a power of what is
    left of the way (1 is a straight line, 2 is finer near the middle)."""
    length = math.hypot(x, y)
    if length <= dead_zone:
        return 0.0, 0.0
    share = min((length - dead_zone) / (1 - dead_zone), 1.0) ** curve
    return x / length * share, y / length * share


def speed(push: float, walk: float, run: float) -> float:
    """m/s of a stick pushed 0 .. 1: a walk half way, a run at the end, straight lines between."""
    return walk * push / HALF if push <= HALF else walk + (run - walk) * (push - HALF) / (1 - HALF)


def rotate(x: float, y: float, angle: float) -> tuple[float, float]:
    """A vector turned counter-clockwise by an angle in radians."""
    cosine, sine = math.cos(angle), math.sin(angle)
    return cosine * x - sine * y, sine * x + cosine * y


class Steering:
    """Steers by the view or by the character.

    By the view, the stick says where on the screen to go. A character that turns well as it goes turns there and goes
    ahead, on the spot first where that is behind it. One that does not goes there at once, sidewards or backwards if
    need be, and so does any while the user turns it. By the character, the stick says where to go as the character sees
    it, and it turns only as the user turns it.
    """

    def __init__(self, space: ControlSpace, walk_turns: bool, run_turns: bool) -> None:
        """Whether the character turns well as it walks, and as it runs."""
        self._space, self._walk_turns, self._run_turns = space, walk_turns, run_turns
        self._side = 1.0  # of the turn under way

    def control(self, intent: Intent, heading: float, view: float | None) -> Control:
        """The control for a character that faces `heading`; `view` is where the screen's up points on the ground, None
        to steer by the character. Both are in radians, counter-clockwise from +Y."""
        if intent.control is not None:
            return intent.control
        push, turn, jump = min(math.hypot(intent.right, intent.ahead), 1.0), intent.turn, float(intent.jump)
        if push == 0:
            return Control(turn=turn, jump=jump)
        pace = speed(push, self._space.walk, self._space.run)
        right, forward = rotate(intent.right / push, intent.ahead / push, 0.0 if view is None else view - heading)
        if turn == 0 and view is not None:
            off = math.atan2(-right, forward)
            turn = self._turn_to(off)
            if self._run_turns if push > _RUNS else self._walk_turns:
                right, forward = 0.0, float(abs(off) < _ON_THE_SPOT)
        return Control(pace * right, pace * forward, turn, jump)

    def _turn_to(self, off: float) -> float:
        """The turn that brings round what is off by an angle, positive to the left."""
        if abs(off) < _BEHIND:
            self._side = math.copysign(1.0, off)
        return self._side * self._space.turn_towards(abs(off))


def view_heading(rotation: list[list[float]]) -> float:
    """Where the screen's up points on the ground, radians from +Y, for the rows of a view matrix's rotation.

    That is where the view looks, and from straight above it is the top edge of the screen.
    """
    (_, up, back) = rotation
    lean = 1.0 if back[2] >= 0 else -1.0  # from below, up leans towards the viewer
    return math.atan2(-(lean * up[0] - back[0]), lean * up[1] - back[1])


def describe(control: Control, space: ControlSpace) -> str:
    """A control in words: "run forward, turn left, jump"."""
    pace = math.hypot(control.right, control.forward)
    words = ["stand"]
    if pace > space.speeds[0] / 2:
        faster = sum(pace >= (slow + fast) / 2 for slow, fast in zip(space.speeds, space.speeds[1:]))
        names = core.DIRECTIONS[:: len(core.DIRECTIONS) // space.directions]
        way = round(math.atan2(-control.right, control.forward) / (2 * math.pi) * len(names)) % len(names)
        words = [f"{space.gaits[faster]} {names[way].replace(' ', '-')}"]
    if abs(control.turn) >= HALF:
        words.append("turn left" if control.turn > 0 else "turn right")
    if control.jump >= HALF:
        words.append("jump")
    return ", ".join(words)
