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


def rotate(x: float, y: float, angle: float) -> tuple[float, float]:
    """A vector turned counter-clockwise by an angle in radians."""
    cosine, sine = math.cos(angle), math.sin(angle)
    return cosine * x - sine * y, sine * x + cosine * y


class Steering:
    """The core's steering, from an Intent to a Control."""

    def __init__(self, space: ControlSpace, walk_turns: bool, run_turns: bool) -> None:
        """Whether the character turns well as it walks, and as it runs."""
        self._core = core.Steering(space, walk_turns, run_turns)

    def control(self, intent: Intent, heading: float, view: float | None) -> Control:
        """The control for a character that faces `heading`; `view` is where the screen's up points on the ground, None
        to steer by the character. Both are in radians, counter-clockwise from +Y."""
        if intent.control is not None:
            return intent.control
        return Control(*self._core.control(intent.right, intent.ahead, intent.turn, intent.jump, heading, view))


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
