# SPDX-License-Identifier: MIT
"""A dog in a BVH file as labs write them: in metres, bones named as a man's, and all along +X at rest."""

from __future__ import annotations

import math
from pathlib import Path

RATE, THIGH, SHIN, PAW, TRUNK, HEIGHT = 60, 0.18, 0.17, 0.03, 0.45, 0.33  # frames a second, m
_JOINTS = (
    ("Hips", 0, (0, 0, 0)),
    ("Spine", 1, (TRUNK, 0, 0)),
    ("Head", 2, (0.2, 0, 0)),
    ("LeftArm", 2, (0, 0, -0.06)),
    ("LeftForeArm", 3, (THIGH, 0, 0)),
    ("LeftHand", 4, (SHIN, 0, 0)),
    ("RightArm", 2, (0, 0, 0.06)),
    ("RightForeArm", 3, (THIGH, 0, 0)),
    ("RightHand", 4, (SHIN, 0, 0)),
    ("LeftUpLeg", 1, (0, 0, -0.06)),
    ("LeftLeg", 2, (THIGH, 0, 0)),
    ("LeftFoot", 3, (SHIN, 0, 0)),
    ("RightUpLeg", 1, (0, 0, 0.06)),
    ("RightLeg", 2, (THIGH, 0, 0)),
    ("RightFoot", 3, (SHIN, 0, 0)),
)  # name, depth, offset
_PHASES = {"LeftUpLeg": 0.0, "LeftArm": 0.25, "RightUpLeg": 0.5, "RightArm": 0.75}  # a walk of four beats


def write_dog(path: Path, speed: float, seconds: float = 6, stride: float = 0.6) -> None:
    """A dog that goes along +X (file axes) at `speed` m/s, a stride in `stride` s, on planted feet; 0: it stands."""
    rows = [_pose(frame / RATE, speed, stride) for frame in range(round(seconds * RATE) + 1)]
    motion = f"MOTION\nFrames: {len(rows)}\nFrame Time: {1 / RATE:.7f}\n"
    path.write_text(_hierarchy() + motion + "".join(" ".join(f"{v:.5f}" for v in row) + "\n" for row in rows))


def _hierarchy() -> str:
    text, depth = "HIERARCHY\n", 0
    for index, (name, level, offset) in enumerate(_JOINTS):
        text += "}\n" * (depth - level) + f"{'JOINT' if level else 'ROOT'} {name}\n{{\n"
        text += "OFFSET {} {} {}\n".format(*offset)
        places = "" if level else "Xposition Yposition Zposition "
        text += f"CHANNELS {3 if level else 6} {places}Zrotation Xrotation Yrotation\n"
        is_end = index + 1 == len(_JOINTS) or _JOINTS[index + 1][1] <= level
        text += f"End Site\n{{\nOFFSET {PAW} 0 0\n}}\n" if is_end else ""
        depth = level + 1
    return text + "}\n" * depth


def _pose(t: float, speed: float, stride: float) -> list[float]:
    row = [speed * t, HEIGHT, 0.0, *[0.0] * 3]
    turns: list[float] = []
    for name, _, _ in _JOINTS[1:]:
        if name in _PHASES:
            turns = _leg(t / stride + _PHASES[name], speed * stride, bends=1 if "Arm" in name else -1)
        row += [turns.pop(0) if turns else 0.0, 0.0, 0.0]
    return row


def _leg(cycles: float, way: float, bends: int) -> list[float]:
    """Degrees about Z of thigh, shin and paw with the wrist where it stands for 0.65 of a stride, and swings after."""
    phase, stance = cycles % 1, 0.65
    swing = max(0.0, (phase - stance) / (1 - stance))
    ahead = (
        way * (stance / 2 - phase) if swing == 0 else way * stance * (swing - 0.5 - math.sin(2 * math.pi * swing) / 9)
    )
    lift = 0.05 * math.sin(math.pi * swing) ** 2 if way else 0.0
    x, y = ahead, HEIGHT - PAW - lift
    far = min(math.hypot(x, y), 0.999 * (THIGH + SHIN))
    at_top = math.acos((THIGH**2 + far**2 - SHIN**2) / (2 * THIGH * far))
    at_knee = math.pi - math.acos((THIGH**2 + SHIN**2 - far**2) / (2 * THIGH * SHIN))
    thigh = math.atan2(-y, x) - bends * at_top
    shin = bends * at_knee
    return [math.degrees(turn) for turn in (thigh, shin, -math.pi / 2 - thigh - shin)]
