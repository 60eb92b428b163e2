# SPDX-License-Identifier: MIT
"""How exactly feet stand on slopes and stairs, whether they slide there, how smoothly the hips go up and down, and how
fast the legs turn.

The same player plays the same trace on the plane and on the ground. A foot is planted where its ball is still and its
sole is on its floor on the plane; it is in contact where it is planted and its ball is still on the ground, too.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import fragmotion_core as core
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Bools = NDArray[np.bool_]
Height = Callable[[float, float], float]

ANGLE, RISE, TREAD = math.radians(20), 0.18, 0.30
RATE, SEED = 60, 1
_WALKER = 10.0  # s
_STILL = 0.1  # m/s of a 1.8 m character's ball
_LOW = 0.02  # m of its sole over its floor
_ALLOWED = 0.02  # m that a foot in contact may be in or over the ground
_WEIGHED = 0.025  # m: as MotionMetrics weighs skating


class Shown(NamedTuple):
    """Of a performance: hips' heights [F], m, soles, heel, ball and tip of both feet [F,2,3,3], m, and how both thighs
    are turned [F,2,4]."""

    hips: Array
    soles: Array
    thighs: Array


def slope(x: float, y: float) -> float:
    """A plane that rises along y."""
    return math.tan(ANGLE) * y


def stairs(x: float, y: float) -> float:
    """Steps that rise along y."""
    return RISE * math.floor(y / TREAD)


GROUNDS: dict[str, tuple[Height, float]] = {
    "slope up": (slope, 0.0),
    "slope down": (slope, math.pi),
    "slope across": (slope, math.pi / 2),
    "stairs up": (stairs, 0.0),
    "stairs down": (stairs, math.pi),
}
"""The heights of each ground and the heading in which it is gone."""


def asked(height: Height) -> Callable[[float, float, float], tuple[float, ...]]:
    """The ground as core.Player asks for it."""
    normal = (0.0, -math.sin(ANGLE), math.cos(ANGLE)) if height is slope else (0.0, 0.0, 1.0)
    return lambda x, y, _z: (height(x, y), *normal)


def make_trace(space: core.ControlSpace, seed: int = SEED) -> Array:
    """Stand, walk, stop and run straight on, and then do what a simulated walker does."""
    parts = [(10, 0.0), (40, space.walk), (10, 0.0), (30, space.run), (10, 0.0)]
    straight = np.concatenate([np.tile((0.0, speed, 0.0, 0.0), (count, 1)) for count, speed in parts])
    return np.concatenate((straight, core.simulate_trace("walker", _WALKER, seed, space)))


def ground(character: core.Character, seed: int = SEED) -> list[dict[str, Any]]:
    """A row for each ground: the greatest distance of a foot in contact from it, above or in it, m; the share of the
    planted feet's frames in which they are within 2 cm of it, and the longest time that one is not, s; the skating of
    feet, the 99th percentile of the hips' vertical acceleration and the fastest turn of a thigh, over those on the
    plane."""
    trace = make_trace(character.space, seed)
    rows = []
    for name, (height, heading) in GROUNDS.items():
        plane, seen = (show(character, trace, heading, on, seed) for on in (None, asked(height)))
        lowest = _lowest(character, plane)
        over, planted = np.abs(_over(seen, lowest, height)), _planted(character, plane, lowest)
        contact = planted & (_speeds(character, seen, 3) < _STILL)
        rows.append(
            {
                "name": name,
                "depth_m": float(over[contact].max()),
                "within_2_cm": float((over <= _ALLOWED)[planted].mean()),
                "late_s": _longest(planted & (over > _ALLOWED)) / RATE,
                "skate_ratio": _skating(seen, lowest, height) / _skating(plane, lowest, lambda _x, _y: 0.0),
                "hips_ratio": _acceleration(seen.hips) / _acceleration(plane.hips),
                "thigh_ratio": _furthest_turn(seen.thighs) / _furthest_turn(plane.thighs),
            }
        )
    return rows


def show(character: core.Character, trace: Array, heading: float, on: Any, seed: int) -> Shown:
    """What a trace shows on the ground, or the plane (None)."""
    player = core.Player(character, seed)
    player.stand_on(on)
    player.reset(0.0, 0.1, heading)
    played = player.run(trace, RATE)
    clip = core.Clip(character.skeleton, "played", RATE, played.root_positions, played.rotations)
    heads, rotations = clip.world_transforms(character.skeleton)
    sides = [_sole(character.skeleton, heads, rotations, side) for side in ("left", "right")]
    thighs = [character.skeleton.names.index(character.skeleton.roles[f"{side}_thigh"]) for side in ("left", "right")]
    return Shown(played.root_positions[:, 2], np.stack(sides, 1), rotations[:, thighs])


def _sole(skeleton: core.Skeleton, heads: Array, rotations: Array, side: str) -> Array:
    """Heel, ball and tip of a foot [F,3,3]."""
    foot = skeleton.names.index(skeleton.roles[f"{side}_foot"])
    end = skeleton.names.index(skeleton.roles.get(f"{side}_toe", skeleton.roles[f"{side}_foot"]))
    w, u, tip = rotations[:, end, :1], rotations[:, end, 1:], np.asarray(skeleton.tips[end])
    front = heads[:, end] + tip + 2 * np.cross(u, np.cross(u, tip) + w * tip)
    return np.stack([heads[:, foot], heads[:, end] if end != foot else front, front], 1)


def _speeds(character: core.Character, shown: Shown, axes: int) -> Array:
    """[F,2]: of the balls, along so many axes, m/s of a 1.8 m character."""
    ball = shown.soles[:, :, 1, :axes]
    steps: Array = np.linalg.norm(np.diff(ball, axis=0, prepend=ball[:1]), axis=-1)
    return steps * RATE * 1.8 / character.skeleton.stature


def _lowest(character: core.Character, plane: Shown) -> Array:
    """[2,3]: heights of heels, balls and tips where they stand, m: those that still feet are over but for a tenth."""
    still = _speeds(character, plane, 2) < _STILL
    return np.stack([np.percentile(plane.soles[still[:, side], side, :, 2], 10, axis=0) for side in (0, 1)])


def _planted(character: core.Character, plane: Shown, lowest: Array) -> Bools:
    """[F,2]: the feet that stand, on the plane."""
    low = (plane.soles[..., :2, 2] - lowest[:, :2]).min(-1) * 1.8 / character.skeleton.stature
    return np.asarray((_speeds(character, plane, 2) < _STILL) & (np.abs(low) < _LOW))


def _over(shown: Shown, lowest: Array, height: Height) -> Array:
    """[F,2]: how high the lowest point of each sole is over the ground, square to it, m."""
    upright = math.cos(ANGLE) if height is slope else 1.0
    return np.asarray((upright * _clearance(shown, height) - lowest).min(-1))


def _clearance(shown: Shown, height: Height) -> Array:
    under = np.vectorize(height, otypes=[float])(shown.soles[..., 0], shown.soles[..., 1])
    return np.asarray(shown.soles[..., 2] - under)


def _longest(flags: Bools) -> int:
    """The most frames in a row that a foot is flagged."""
    most = count = 0
    for flag in np.concatenate((flags, np.zeros_like(flags[:1]))).T.ravel():
        count = count + 1 if flag else 0
        most = max(most, count)
    return most


def _skating(shown: Shown, lowest: Array, height: Height) -> float:
    """The mean speed of balls, weighed by how low they are, m/s."""
    speed = np.linalg.norm(np.diff(shown.soles[:, :, 1, :2], axis=0), axis=-1) * RATE
    over = (_clearance(shown, height)[1:] - lowest)[:, :, 1]
    return float((speed * np.clip(2 - np.exp2(over / _WEIGHED), 0, 1)).mean())


def _acceleration(heights: Array) -> float:
    """The 99th percentile of a vertical acceleration, m/s^2."""
    return float(np.percentile(np.abs(np.diff(heights, 2)), 99)) * RATE**2


def _furthest_turn(rotations: Array) -> float:
    """How far any of them turns in a frame at most, rad."""
    cosines = np.abs((rotations[1:] * rotations[:-1]).sum(-1))
    return float(2 * np.arccos(np.clip(cosines, 0, 1)).max())
