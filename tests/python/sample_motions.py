# SPDX-License-Identifier: MIT
"""Takes of the sample character as BVH files, which tests read back."""

from __future__ import annotations

from pathlib import Path

from test_sample_takes import gait, takes, write_bvh

NAMES = ("walk forward", "run forward", "turn left", "walk left right", "walk start stop", "run start stop")


def write_sample(folder: Path) -> list[Path]:
    """Walks, runs, turns, starts and stops: nothing sideways, backward, or that stands."""
    made = {take.name: take for take in takes.all_takes()}
    return [write_bvh(folder / f"{name.replace(' ', '_')}.bvh", gait.synthesize(made[name])) for name in NAMES]
