# SPDX-License-Identifier: MIT
"""BVH files out of the core: what another reader of the format sees in them is the take."""

from __future__ import annotations

from pathlib import Path

import fragmotion_core as core
import numpy as np
import pytest
from bodies import random_rolls, remade
from conftest import BANDAI, Array, make_skeleton, walking_arrays
from scipy.spatial.transform import Rotation


def heads_in(path: Path) -> dict[str, Array]:
    """Joint -> places [F,3] in the file's own axes and units, by a reader that knows nothing of the core."""
    hierarchy, motion = path.read_text().split("MOTION\n")
    rows = np.array([line.split() for line in motion.splitlines()[2:]], float)
    places: dict[str, Array] = {}
    turns: dict[str, Rotation] = {}
    chain: list[str] = []
    offset, column = np.zeros(3), 0
    for line in hierarchy.splitlines():
        words = line.split()
        if words[0] in {"ROOT", "JOINT", "End"}:
            name = words[1]
        elif words[0] == "{":
            chain.append(name)
        elif words[0] == "}":
            chain.pop()
        elif words[0] == "OFFSET":
            offset = np.array(words[1:], float)
        elif words[0] == "CHANNELS":
            values, column = rows[:, column : column + len(words) - 2], column + len(words) - 2
            place = values[:, :3] if words[2] == "Xposition" else np.tile(offset, (len(rows), 1))
            turn = Rotation.from_euler("ZXY", values[:, -3:], degrees=True)
            above = chain[-2] if len(chain) > 1 else None
            places[name] = places[above] + turns[above].apply(place) if above else place
            turns[name] = turns[above] * turn if above else turn
    assert column == rows.shape[1]
    return places


def assert_holds(path: Path, take: core.Take, unit: float) -> None:
    """The file's joints stand where the take's bones do."""
    heads, _ = take.world_transforms()
    for name, places in heads_in(path).items():
        upright = unit * np.column_stack([places[:, 0], -places[:, 2], places[:, 1]])
        np.testing.assert_allclose(upright, heads[:, take.skeleton.names.index(name)], atol=1e-4)


@pytest.mark.parametrize("unit", [0.01, 1.0])
def test_a_clip_of_any_rest_frames_goes_out(tmp_path: Path, unit: float) -> None:
    plain = make_skeleton()
    skeleton = remade(plain, rolls=random_rolls(plain))
    take = core.Take.from_clip(core.Clip(skeleton, "walk", 30.0, *walking_arrays()), skeleton)
    core.write_bvh(take, tmp_path / "walk.bvh", unit)
    assert_holds(tmp_path / "walk.bvh", take, unit)


def test_a_real_take_goes_out(tmp_path: Path) -> None:
    path = BANDAI / "dataset-1_walk_normal_001.bvh"
    if not path.exists():
        pytest.skip("no motion capture beside the project")
    take = core.read_bvh(path)
    core.write_bvh(take, tmp_path / "walk.bvh")
    assert_holds(tmp_path / "walk.bvh", take, 0.01)


def test_a_performance_goes_out(tmp_path: Path, character: core.Character, traces: list[Array]) -> None:
    performance = core.Player(character).run(traces[0][:20], 30)
    played = core.Clip(character.skeleton, "played", 30, performance.root_positions, performance.rotations)
    take = core.Take.from_clip(played, character.skeleton)
    core.write_bvh(take, tmp_path / "played.bvh")
    heads, _ = played.world_transforms(character.skeleton)
    np.testing.assert_allclose(take.world_transforms()[0], heads, atol=1e-9)
    assert_holds(tmp_path / "played.bvh", take, 0.01)


def test_takes_of_one_skeleton_are_told() -> None:
    one = make_skeleton()
    wider = make_skeleton(offsets=[[0.9, 0, 1], *one.offsets[1:]])  # the hips rest elsewhere
    longer = make_skeleton(offsets=1.01 * one.offsets)
    rolled = remade(one, rolls=random_rolls(one))
    assert core.group_skeletons([one, longer, wider, rolled]) == [[0, 2], [1], [3]]


def test_a_clip_of_other_bones_is_refused() -> None:
    skeleton = make_skeleton()
    clip = core.Clip(skeleton, "walk", 30.0, *walking_arrays())
    few = core.Skeleton(["a"], [-1], [[1, 0, 0, 0]], [[0, 0, 0]], [[0, 0, 1]])
    with pytest.raises(ValueError, match="walk"):
        core.Take.from_clip(clip, few)
