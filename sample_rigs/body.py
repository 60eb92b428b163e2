# SPDX-License-Identifier: MIT
"""The sample character's proportions: bones and joints at rest, in metres.

Axes are the armature's: x is the character's left, -y its front, z up; the ground is z = 0 and the stature 1.8 m.
Everything is given for the left side and mirrored in x, so the rest pose is symmetric by construction.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

STATURE = 1.8
BALL_HEIGHT = 0.026  # radius of the sole under the ball of the foot, metres
HEEL_HEIGHT = 0.034  # radius of the heel, metres


class Bone(NamedTuple):
    """A bone at rest: joint positions in metres and the direction its local z axis is rolled towards."""

    name: str
    parent: str | None
    head: np.ndarray
    tail: np.ndarray
    roll_towards: np.ndarray
    connected: bool


_FRONT = (0.0, -1.0, 0.0)
_UP = (0.0, 0.0, 1.0)
_CENTRE = (
    ("root", None, (0, 0, 0), (0, -0.28, 0), _UP, False),
    ("hips", "root", (0, 0, 0.975), (0, 0, 1.09), _FRONT, False),
    ("spine", "hips", (0, 0, 1.09), (0, 0.005, 1.25), _FRONT, True),
    ("chest", "spine", (0, 0.005, 1.25), (0, 0.02, 1.475), _FRONT, True),
    ("neck", "chest", (0, 0.02, 1.475), (0, 0.0, 1.565), _FRONT, True),
    ("head", "neck", (0, 0.0, 1.565), (0, 0.0, 1.8), _FRONT, True),
)
_LEFT = (
    ("shoulder", "chest", (0.025, 0.005, 1.44), (0.175, 0.025, 1.45), _FRONT, False),
    ("upper_arm", "shoulder", (0.175, 0.025, 1.45), (0.365, 0.035, 1.2236), _FRONT, True),
    ("forearm", "upper_arm", (0.365, 0.035, 1.2236), (0.526, 0.010, 1.0236), _FRONT, True),
    ("hand", "forearm", (0.526, 0.010, 1.0236), (0.63, -0.012, 0.885), _FRONT, True),
    ("thigh", "hips", (0.095, 0.0, 0.945), (0.0975, -0.012, 0.51), _FRONT, False),
    ("shin", "thigh", (0.0975, -0.012, 0.51), (0.10, 0.02, 0.08), _FRONT, True),
    ("foot", "shin", (0.10, 0.02, 0.08), (0.10, -0.125, BALL_HEIGHT), _UP, True),
    ("toe", "foot", (0.10, -0.125, BALL_HEIGHT), (0.10, -0.20, BALL_HEIGHT), _UP, True),
)


def _bone(spec: tuple, side: str = "") -> Bone:
    """A bone of one of the tables above; side is "", ".L" or ".R" (mirrored)."""
    name, parent, head, tail, roll, connected = spec
    mirror = np.array([-1.0 if side == ".R" else 1.0, 1.0, 1.0])
    own = any(parent == row[0] for row in _LEFT)
    return Bone(
        name + side,
        parent + side if own and parent else parent,
        np.array(head, float) * mirror,
        np.array(tail, float) * mirror,
        np.array(roll, float) * mirror,
        connected,
    )


BONES: tuple[Bone, ...] = tuple(
    [_bone(row) for row in _CENTRE] + [_bone(row, side) for side in (".L", ".R") for row in _LEFT]
)
BY_NAME: dict[str, Bone] = {bone.name: bone for bone in BONES}
HEEL = np.array([0.0, 0.075, HEEL_HEIGHT])  # centre of the heel, from the ground point under the ankle's x


def head(name: str) -> np.ndarray:
    """Rest position of the bone's head [3], metres."""
    return BY_NAME[name].head


def length(name: str) -> float:
    """Rest length of the bone, metres."""
    bone = BY_NAME[name]
    return float(np.linalg.norm(bone.tail - bone.head))


def mid_hips() -> np.ndarray:
    """The head of the bone "hips" [3], metres: the point whose motion the takes describe."""
    return head("hips")
