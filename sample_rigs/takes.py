# SPDX-License-Identifier: MIT
"""The takes of the sample character: what each does, not how. Metres, seconds, degrees; 30 frames a second."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from manners import MANNERS

FPS = 30
WALK_SPEED = 1.2  # m/s
RUN_SPEED = 3.3  # m/s
TURN_RATE = 70.0  # degrees/s, positive left
JUMP_APEX = 0.35  # rise of the centre of mass, metres
GRAVITY = 9.81  # m/s^2
FLIGHT_FRAMES = round(2 * math.sqrt(2 * JUMP_APEX / GRAVITY) * FPS)

_DIRECTIONS = {
    "forward": 0.0,
    "forward left": 45.0,
    "left": 90.0,
    "back left": 135.0,
    "back": 180.0,
    "back right": -135.0,
    "right": -90.0,
    "forward right": -45.0,
}


@dataclass(frozen=True)
class Take:
    """One take. knots holds (second, speed, turn rate), eased in between; direction is that of travel, left positive.

    stepping is the span of seconds in which the feet step, None for a take that never does. jump is None, "both" (from
    a stand, take-off at jump_at seconds) or "one" (from one foot, in the gait cycle that is running at jump_at). manner
    is one of MANNERS; gesture is one of GESTURES, over standing.
    """

    name: str
    seconds: float
    knots: tuple[tuple[float, float, float], ...]
    direction: float = 0.0
    stepping: tuple[float, float] | None = (-math.inf, math.inf)
    jump: str | None = None
    jump_at: float = 0.0
    gesture: str = ""
    manner: str = ""


def _steady(name: str, seconds: float, speed: float, turn: float = 0.0, direction: float = 0.0) -> Take:
    return Take(name, seconds, ((0.0, speed, turn),), direction)


def _travelling() -> list[Take]:
    """Walks (5 cycles) and runs (8 cycles) in eight directions, facing forward all the time."""
    walks = [_steady(f"walk {name}", 5.0, WALK_SPEED, 0, angle) for name, angle in _DIRECTIONS.items()]
    runs = [_steady(f"run {name}", 16 / 3, RUN_SPEED, 0, angle) for name, angle in _DIRECTIONS.items()]
    return walks + runs


def _turning() -> list[Take]:
    """Turns on the spot, walking and running."""
    takes = []
    for side, rate in (("left", TURN_RATE), ("right", -TURN_RATE)):
        takes.append(_steady(f"turn {side}", 5.4, 0.0, rate))
        takes.append(_steady(f"walk turn {side}", 5.0, WALK_SPEED, rate))
        takes.append(_steady(f"run turn {side}", 16 / 3, RUN_SPEED, rate))
    return takes


def _jumping() -> list[Take]:
    walk, run = ((0.0, WALK_SPEED, 0.0),), ((0.0, RUN_SPEED, 0.0),)
    return [
        Take("jump up", 4.0, ((0.0, 0.0, 0.0),), 0, None, "both", 1.5),
        Take("walk jump", 4.5, walk, 0, jump="one", jump_at=2.0),
        Take("run jump", 4.0, run, 0, jump="one", jump_at=2.0),
    ]


def _changing() -> list[Take]:
    """Starts, stops and changes of gait and direction."""
    walk, run, turn = WALK_SPEED, RUN_SPEED, TURN_RATE
    return [
        Take("walk start stop", 6.0, ((1.0, 0, 0), (1.8, walk, 0), (3.9, walk, 0), (4.7, 0, 0)), 0, (1.0, 4.4)),
        Take("back start stop", 6.0, ((1.0, 0, 0), (1.8, walk, 0), (3.9, walk, 0), (4.7, 0, 0)), 180, (1.0, 4.4)),
        Take("run start stop", 7.0, ((1.0, 0, 0), (2.7, run, 0), (3.9, run, 0), (5.6, 0, 0)), 0, (1.0, 5.3)),
        Take("walk run walk", 6.5, ((1.2, walk, 0), (2.4, run, 0), (3.9, run, 0), (5.1, walk, 0)), 0),
        Take("walk left right", 6.0, ((1.2, walk, 0), (1.8, walk, turn), (3.0, walk, turn), (4.2, walk, -turn)), 0),
        Take("turn start stop", 5.0, ((1.0, 0, 0), (1.4, 0, turn), (3.2, 0, turn), (3.7, 0, 0)), 0, (1.0, 3.5)),
    ]


def move_takes() -> list[Take]:
    """What a key starts, each from a stand to a stand."""
    seconds = {"wave": 3.0, "kick": 2.1, "sit": 3.9}
    return [Take(name, long, ((0.0, 0.0, 0.0),), 0, None, gesture=name) for name, long in seconds.items()]


def _styled(manner: str) -> list[Take]:
    """A style: what its mirror image and synthesis make whole."""
    pace = MANNERS[manner].pace
    walk, run = pace * WALK_SPEED, pace * RUN_SPEED
    takes = [
        Take("stand", 2.0, ((0.0, 0.0, 0.0),), 0, None),
        *(_steady(f"walk {name}", 2.7, walk, 0, _DIRECTIONS[name]) for name in ("forward", "left", "back")),
        _steady("run forward", 2.7, run),
        _steady("turn left", 2.7, 0.0, TURN_RATE),
        Take("walk start stop", 4.4, ((0.6, 0, 0), (1.4, walk, 0), (2.8, walk, 0), (3.6, 0, 0)), 0, (0.6, 3.3)),
        Take("jump up", 3.4, ((0.0, 0.0, 0.0),), 0, None, "both", 1.2),
    ]
    return [replace(take, name=f"{manner} {take.name}", manner=manner) for take in takes]


def all_takes() -> list[Take]:
    """Every take of the sample, the idle first, and then those of its styles."""
    stand = Take("stand", 4.0, ((0.0, 0.0, 0.0),), 0, None)
    styled = [take for manner in MANNERS if manner for take in _styled(manner)]
    return [stand, *_travelling(), *_turning(), *_jumping(), *_changing(), *styled]
