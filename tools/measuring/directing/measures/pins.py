# SPDX-License-Identifier: MIT
"""How near a character comes to where it is pinned, in how many tries and how long."""

from __future__ import annotations

import math
import time
from typing import Any

import fragmotion_core as core
import numpy as np

RATE = 60
"""Frames a second at which pins are looked for."""

_PLAYERS = ("walker", "explorer", "runner")
_SECONDS = 20.0
_AT = (8.0, 15.0)  # s
_STRETCH = 4.0  # s before a pin in which controls change
_ASKED = ((0.1, 5.0), (0.3, 10.0), (0.6, 20.0))  # m and degrees from where the trace leads


def pins(character: core.Character) -> list[dict[str, Any]]:
    """Pins at several distances from where simulated players would be, each with what is left after the search, and
    its tries and seconds."""
    return [
        _pin(character, trace, seconds, asked, number)
        for number, player in enumerate(_PLAYERS, 1)
        for trace in [core.simulate_trace(player, _SECONDS, number, character.space)]
        for seconds in _AT
        for asked in _ASKED
    ]


def _pin(
    character: core.Character, trace: core.Doubles, seconds: float, asked: tuple[float, float], number: int
) -> dict[str, Any]:
    """One of them, in a direction that its `number` draws."""
    distance, degrees = asked
    random = np.random.default_rng([number, round(10 * seconds), round(100 * distance)])
    angle = random.uniform(0, 2 * math.pi)
    away = (distance * math.cos(angle), distance * math.sin(angle), random.choice((-1, 1)) * math.radians(degrees))
    target = core.Player(character).run(trace, RATE).path[round(seconds * RATE)] + away
    begin = time.perf_counter()
    pin = core.find_pin(character, np.zeros(3), trace, seconds, target, begin=seconds - _STRETCH)
    return {
        "asked_m": distance,
        "left_m": pin.distance,
        "left_degrees": math.degrees(pin.angle),
        "tries": pin.tries,
        "seconds": time.perf_counter() - begin,
    }
