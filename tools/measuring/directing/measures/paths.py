# SPDX-License-Identifier: MIT
"""How near a character keeps to paths, and how it arrives."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import fragmotion_core as core

from tools.measuring.directing.measures.courses import Course

SEEDS = range(1, 6)  # of the player


def follow_all(character: core.Character, courses: Sequence[Course]) -> list[dict[str, Any]]:
    """A row for each path and speed: asked is to be at its end when it can be there at this speed."""
    return [follow(character, course, speed) for course in courses for speed in speeds(character.space)]


def speeds(space: core.ControlSpace) -> dict[str, float]:
    """m/s by name: the character's walk, its run, and halfway."""
    return {"walk": space.walk, "jog": (space.walk + space.run) / 2, "run": space.run}


def follow(character: core.Character, course: Course, gait: str) -> dict[str, Any]:
    """Over some seeds: the mean of the mean distances, and the worst of everything else."""
    path, speed = core.Path(course.points, course.closed), speeds(character.space)[gait]
    asked = core.PathFollower(character.space, path, speed=speed).seconds_left
    walks = [core.follow_path(core.Player(character, seed), path, arrive=asked) for seed in SEEDS]
    return {
        "name": f"{course.name}, {gait}",
        "speed": speed,
        "mean_m": sum(walk.mean_distance for walk in walks) / len(walks),
        "max_m": max(walk.greatest_distance for walk in walks),
        "arrival_m": max(walk.arrival_distance for walk in walks),
        "arrival_s": max((walk.seconds - asked for walk in walks), key=abs),
        "arrived": all(walk.arrived for walk in walks),
        "length_m": path.length,
        "asked_s": asked,
    }
