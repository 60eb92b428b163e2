# SPDX-License-Identifier: MIT
"""Takes from files."""

from __future__ import annotations

from pathlib import Path

from .core import core
from .files import ENDINGS, UNIT


def read_take(path: Path, unit: float = UNIT) -> core.Take:
    """The take of a file, an AMC's on the skeleton that lies beside it; ValueError names what is wrong."""
    if path.suffix.lower() not in ENDINGS:
        raise ValueError(f"{path}: not motion capture that can be read ({', '.join(ENDINGS)})")
    return core.read_bvh(path, unit) if path.suffix.lower() == ".bvh" else core.read_asf_amc(core.find_asf(path), path)


def led_by_feet(clip: core.Clip, skeleton: core.Skeleton) -> core.Clip:
    """The clip; one that goes on the spot on the way that its feet tell."""
    way = clip.led_by_feet(skeleton)
    return way[0] if way else clip
