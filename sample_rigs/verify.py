# SPDX-License-Identifier: MIT
"""Measure the takes: foot slide, ground contact, knees. Run `python3 sample_rigs/verify.py` (needs NumPy, not Blender).

Positions come from forward kinematics of the bone rotations, not from the plan, so the leg IK is measured too.
"""

from __future__ import annotations

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

import body
import gait
import numpy as np
import rotations as rot
from takes import FPS, all_takes, move_takes

MAX_SLIDE = 0.02  # m/s
MAX_HEIGHT = 0.005  # m


def heads(motion: gait.Motion) -> dict[str, np.ndarray]:
    """World positions [N, 3] of every bone's head, by forward kinematics."""
    found = {"root": motion.root, "hips": motion.hips}
    for bone in body.BONES[2:]:
        parent = bone.parent or ""
        arm = bone.head - body.head(parent)
        found[bone.name] = found[parent] + rot.apply(motion.world[parent], arm)
    return found


def contacts(motion: gait.Motion, side: str) -> dict[str, np.ndarray]:
    """Height-corrected contact points [N, 3]: sole under heel, ball and toe tip; z = 0 on the ground."""
    at = heads(motion)
    foot, toe = at["foot" + side], at["toe" + side]
    heel = foot + rot.apply(motion.world["foot" + side], body.HEEL - body.head("foot.L") * [0, 1, 1])
    tip_arm = body.BY_NAME["toe.L"].tail - body.head("toe.L")
    tip = toe + rot.apply(motion.world["toe" + side], tip_arm)
    down = np.array([0, 0, 1.0])
    return {"heel": heel - down * body.HEEL_HEIGHT, "ball": toe - down * body.BALL_HEIGHT,
            "tip": tip - down * body.BALL_HEIGHT}  # fmt: skip


def measure(motion: gait.Motion) -> dict[str, float]:
    """Worst slide of a planted contact point (m/s), worst heights (m) and knee figures (degrees) of a take."""
    slide = height = 0.0
    lowest, bend, pop = 0.0, [], 0.0
    for side in (".L", ".R"):
        points = contacts(motion, side)
        planted = motion.planted[side]
        for name in ("heel", "ball"):
            z = points[name][:, 2]
            down = planted & (z < 0.004)  # this point carries the foot
            both = down[1:] & down[:-1]
            speed = np.linalg.norm(np.diff(points[name][:, :2], axis=0), axis=1) * FPS
            slide = max(slide, float(speed[both].max(initial=0)))
        ground = np.minimum(points["heel"][:, 2], points["ball"][:, 2])
        height = max(height, float(np.abs(ground[planted]).max(initial=0)))
        lowest = min(lowest, *(float(p[:, 2].min()) for p in points.values()))
        knee = _knee(motion, side)
        bend += [knee.min(), knee.max()]
        pop = max(pop, float(np.abs(np.diff(knee, 2)).max()))
    return {"slide": slide, "height": height, "lowest": lowest, "knee_min": min(bend), "knee_max": max(bend),
            "knee_pop": pop, "jerk": _worst_turn(motion), "legs": _leg_distance(motion)}  # fmt: skip


def _knee(motion: gait.Motion, side: str) -> np.ndarray:
    """Flexion of the knee [N], degrees; negative would be bent backwards."""
    bones = [body.BY_NAME[name + side] for name in ("thigh", "shin")]
    thigh, shin = (rot.apply(motion.world[b.name], b.tail - b.head) / body.length(b.name) for b in bones)
    across = rot.apply(motion.world["thigh" + side], np.array([1.0, 0, 0]))
    return np.degrees(np.arctan2(np.sum(np.cross(thigh, shin) * across, axis=1), np.sum(thigh * shin, axis=1)))


def _worst_turn(motion: gait.Motion) -> float:
    """Largest change from frame to frame of any bone's local rotation, degrees."""
    worst = 0.0
    for bone in body.BONES:
        q = rot.to_quaternions(motion.local(bone.name))
        dots = np.clip(np.abs(np.sum(q[1:] * q[:-1], axis=1)), 0, 1)
        worst = max(worst, float(np.degrees(2 * np.arccos(dots)).max()))
    return worst


def _leg_distance(motion: gait.Motion) -> float:
    """Least distance between the two lower legs' axes, sampled, metres."""
    at = heads(motion)
    part = np.linspace(0, 1, 9)[:, None, None]
    shins = [at["shin" + s] * (1 - part) + at["foot" + s] * part for s in (".L", ".R")]
    feet = [np.stack([at["foot" + s], at["toe" + s]]) for s in (".L", ".R")]
    left, right = (np.concatenate(pair) for pair in zip(shins, feet))
    return float(np.linalg.norm(left[:, None] - right[None], axis=3).min())


def main() -> int:
    """Print a table and fail if a planted foot slides or leaves the ground."""
    failed = 0
    for take in [*all_takes(), *move_takes()]:
        motion = gait.synthesize(take)
        found = measure(motion)
        bad = found["slide"] > MAX_SLIDE or found["height"] > MAX_HEIGHT or found["lowest"] < -MAX_HEIGHT
        failed += bad
        print(f"{take.name:20s}", " ".join(f"{key} {value:7.4f}" for key, value in found.items()), "BAD" if bad else "")
    print("slide m/s, heights m, knees degrees;", "all good" if not failed else f"{failed} takes fail")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
