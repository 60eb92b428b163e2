# SPDX-License-Identifier: MIT
"""For Linux's Python and Windows': `make_character.py FOLDER NAME` makes a character of the folder's BVH files, and
saves it and its poses there under the name."""

from __future__ import annotations

import sys
from pathlib import Path

import fragmotion_core as core


def make(folder: Path, name: str) -> None:
    """Write NAME.policy, and NAME.poses: what a player of it shows in ten seconds."""
    takes = [core.read_bvh(path) for path in sorted(folder.glob("*.bvh"), key=lambda path: path.name)]
    skeleton = takes[0].skeleton
    options = core.BuildOptions()
    options.policies = ["anticipate", "iterate", "svm", "greedy"]
    clips = [core.Clip.from_take(take, skeleton) for take in takes]
    character = core.build(skeleton, clips, [core.simulate_trace("explorer", 60, 1)], options)
    (folder / f"{name}.policy").write_bytes(character.to_bytes())
    performance = core.Player(character).run(core.simulate_trace("walker", 10, 2), 60)
    (folder / f"{name}.poses").write_bytes(performance.root_positions.tobytes() + performance.rotations.tobytes())


if __name__ == "__main__":
    make(Path(sys.argv[1]), sys.argv[2])
