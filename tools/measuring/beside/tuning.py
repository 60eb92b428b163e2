# SPDX-License-Identifier: MIT
"""Looks for the constants with which motion matching does best: by random changes of the best so far, on players'
sessions that the comparison does not use. Seven measures count, each over that of ours at responsiveness 1."""

from __future__ import annotations

import dataclasses
import statistics
import time
from pathlib import Path
from typing import Any

import numpy as np

from tools.measuring.beside import measures
from tools.measuring.beside.motion.likeness import Likeness
from tools.measuring.beside.setting import Setting, sessions
from tools.measuring.beside.systems import Fragments, Matching
from tools.measuring.peers.motion_matching.constants import Constants, load, save
from tools.measuring.peers.motion_matching.matcher import Matcher
from tools.shell import say

MEASURES = (
    "velocity_error_percent",
    "drift_percent",
    "turn_error",
    "foot_skate_ratio",
    "unlikeness",
    "velocity_step_p99",
    "hips_curve_p99",
)
_PLAYERS = ("explorer", "runner", "twitcher", "circler", "walker")
_SECONDS, _SEED_OFFSET = 40.0, 5000
_SCALED = (
    "foot_place",
    "foot_velocity",
    "hip_velocity",
    "places",
    "directions",
    "search",
    "blend",
    "velocity_halflife",
    "turn_halflife",
    "place_halflife",
    "heading_halflife",
    "ratio",
    "farthest",
    "unlock",
    "lock_halflife",
)
_CHOICES: dict[str, list[Any]] = {
    "ends": [20, 40, 60],
    "goes_on": [False, True],
    "transition_cost": [0.0, 0.05, 0.2, 0.5, 1.0, 2.0],
    "contact": [(0.15, 0.0, 10.0), (0.3, 0.1, 0.045), (0.5, 0.2, 0.045)],  # speed, share and height
}
_LEAST_SEARCH, _MOST_UNLOCK = 0.03, 0.3
_STEP = 0.4  # of the logarithm of a constant


def changed(constants: Constants, random: np.random.Generator) -> Constants:
    """One to four of them, at random."""
    values: dict[str, Any] = {}
    for name in random.choice([*_SCALED, *_CHOICES], size=random.integers(1, 5), replace=False):
        values.update(_changed_one(constants, str(name), random))
    made = dataclasses.replace(constants, **values)
    search, unlock = max(made.search, _LEAST_SEARCH), min(made.unlock, _MOST_UNLOCK)
    return dataclasses.replace(made, search=search, unlock=unlock)


def _changed_one(constants: Constants, name: str, random: np.random.Generator) -> dict[str, Any]:
    if name in _CHOICES:
        choice = _CHOICES[name][int(random.integers(len(_CHOICES[name])))]
        return (
            dict(zip(("contact_speed", "contact_share", "contact_height"), choice))
            if name == "contact"
            else {name: choice}
        )
    published, own = getattr(Constants(), name), getattr(constants, name)
    return {name: float(np.clip(own * np.exp(_STEP * random.standard_normal()), published / 9, published * 5))}


def tune(setting: Setting, minutes: float, path: Path, seed: int) -> None:
    """Write the best constants that are found within so many minutes to a file; if it is there, begin with it."""
    likeness = Likeness(setting.body, *setting.takes)
    traces = sessions(setting.space, seed + _SEED_OFFSET, _PLAYERS, _SECONDS)
    ours = measures.measure(setting, Fragments(setting, 1.0), traces, likeness, [0])
    material = setting.material(filled=True)

    def cost(constants: Constants) -> float:
        found = measures.measure(setting, Matching(setting, Matcher(material, constants)), traces, likeness, [0])
        return statistics.fmean(found[name] / ours[name] for name in MEASURES)

    end = time.monotonic() + 60 * minutes
    random = np.random.default_rng(seed)
    best = load(path) if path.exists() else Constants()
    least, tries = cost(best), 1
    say(f"constants to begin with: {least:.4f} of ours")
    while time.monotonic() < end:
        constants = changed(best, random)
        found, tries = cost(constants), tries + 1
        if found < least:
            best, least = constants, found
            save(path, best, tries, least)
            say(f"try {tries}: {least:.4f}")
    save(path, best, tries, least)
