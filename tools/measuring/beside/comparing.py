# SPDX-License-Identifier: MIT
"""All figures of a comparison, as the JSON file holds them."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import fragmotion_core as core
import numpy as np

from tools.measuring.beside import measures
from tools.measuring.beside.costs import policy_costs
from tools.measuring.beside.motion.likeness import Likeness
from tools.measuring.beside.motion.response import response_times
from tools.measuring.beside.setting import SECONDS, Setting, sessions
from tools.measuring.beside.systems import Fragments, Matching, System, matching
from tools.measuring.peers.motion_matching.constants import Constants
from tools.shell import say

TEST_SEEDS = 1000  # how far the tests' seeds are from the teacher's


def compare(setting: Setting, tuned: Constants, seed: int, seconds: float = SECONDS) -> dict[str, Any]:
    """Measure every system on a session of each simulated player; says what it is doing."""
    say("likeness: the takes' own")
    likeness = Likeness(setting.body, *setting.takes)
    traces = sessions(setting.space, seed + TEST_SEEDS, core.PLAYERS, seconds)
    found: dict[str, Any] = {"takes": measures.takes_figures(setting), "systems": {}}
    for name, make in every_system(setting, tuned).items():
        say(f"playing: {name}")
        system = make()
        figures = measures.measure(setting, system, traces, likeness, measures.SEEDS)
        found["systems"][name] = {**figures, **_costs(setting, system), **_responses(setting, system, seed)}
    return {**_describe(setting, seed), **found}


def every_system(setting: Setting, tuned: Constants) -> dict[str, Callable[[], System]]:
    """What makes each, by its name."""
    return {
        "ours": lambda: Fragments(setting),
        "ours, responsiveness 1": lambda: Fragments(setting, responsiveness=1.0),
        "matching, published constants": lambda: matching(setting, Constants(), filled=False),
        "matching, tuned, gaps filled": lambda: matching(setting, tuned, filled=True),
    }


def _responses(setting: Setting, system: System, seed: int) -> measures.Figures:
    half, most = np.percentile(response_times(setting, system, seed), [50, 95])
    return {"response_p50_s": float(half), "response_p95_s": float(most)}


def _costs(setting: Setting, system: System) -> measures.Figures:
    if not isinstance(system, Matching):
        return policy_costs(setting.character)
    return {
        "memory_mb": system.matcher.database.bytes / 1e6,
        "search_microseconds_a_frame": 1e6 * system.search_seconds / system.frames,
    }


def _describe(setting: Setting, seed: int) -> dict[str, Any]:
    space = setting.space
    return {
        "seed": seed,
        "count": len(setting.takes.captured),
        "filled": len(setting.made),
        "players": list(core.PLAYERS),
        "walk": space.walk,
        "run": space.run,
        "turn_rate": math.degrees(space.turn_rate),
    }
