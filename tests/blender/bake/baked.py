# SPDX-License-Identifier: MIT
"""What the tests of bakes share: what the core's player plays, and what Blender shows of a bake."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from types import ModuleType
from typing import Any, NamedTuple

import bpy
import making
import numpy as np

FIRST = 5


SEED = 3


RATE = 30


class Oracle(NamedTuple):
    """What the core's player plays: names of the bones below the hips, their heads [F,B,3] and rotations [F,B,3,3] in
    the world, and the player's performance."""

    names: list[str]
    heads: np.ndarray
    turned: np.ndarray
    performance: Any


def play(
    addon: ModuleType,
    obj: bpy.types.Object,
    trace: np.ndarray,
    rate: float = RATE,
    start: Any = None,
    policy: str = "",
    **feel: Any,
) -> Oracle:
    """The trace played from the armature's place in the fixture `obj`."""
    core, character = addon.compat.core.core, addon.character.building.load(obj)
    player = core.Player(character, SEED, policy=policy, **feel)
    player.reset(*(start or (2, -1, 0.7 + np.pi)))
    performance = player.run(trace, rate)
    clip = core.Clip(character.skeleton, "played", rate, performance.root_positions, performance.rotations)
    heads, rotations = clip.world_transforms(character.skeleton)
    body = making.body_bones(character.skeleton)
    names = [character.skeleton.names[index] for index in body]
    return Oracle(names, heads[:, body], making.to_matrices(rotations[:, body]), performance)


def seen_at(obj: bpy.types.Object, frames: Iterable[int], names: Sequence[str]) -> tuple[np.ndarray, np.ndarray]:
    """Heads [F,B,3] and rotations [F,B,3,3] of bones in the world as the scene shows them."""
    matrices = []
    for frame in frames:
        bpy.context.scene.frame_set(int(frame))
        posed = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
        matrices.append([np.array(posed.matrix_world @ posed.pose.bones[name].matrix) for name in names])
    seen = np.array(matrices)
    return seen[..., :3, 3], seen[..., :3, :3] / np.linalg.norm(seen[..., :3, :3], axis=-2, keepdims=True)


def assert_seen(obj: bpy.types.Object, oracle: Oracle, first: int = FIRST, step: int = 7) -> None:
    """The scene shows what was played."""
    rows = np.arange(0, len(oracle.heads), step)
    heads, turned = seen_at(obj, first + rows, oracle.names)
    assert heads.shape[0] > 10
    np.testing.assert_allclose(heads, oracle.heads[rows], atol=1e-4)
    np.testing.assert_allclose(turned, oracle.turned[rows], atol=1e-4)


def about_z(angles: np.ndarray) -> np.ndarray:
    """Matrices [F,3,3] that turn about the vertical."""
    turns = np.zeros((len(angles), 3, 3))
    turns[:, 0, 0] = turns[:, 1, 1] = np.cos(angles)
    turns[:, 1, 0] = np.sin(angles)
    turns[:, 0, 1] = -turns[:, 1, 0]
    turns[:, 2, 2] = 1
    return turns


def on_a_treadmill(oracle: Oracle) -> Oracle:
    """The same poses with the character frame where it was at first."""
    frames = oracle.performance.path
    back = about_z(frames[0, 2] - frames[:, 2])
    ground = np.column_stack((frames[:, :2], np.zeros(len(frames))))
    heads = ground[0] + np.einsum("fij,fbj->fbi", back, oracle.heads - ground[:, None])
    return oracle._replace(heads=heads, turned=np.einsum("fij,fbjk->fbik", back, oracle.turned))


def bake(**fields: Any) -> None:
    assert bpy.ops.fragmotion.bake(frame_start=FIRST, **fields) == {"FINISHED"}


def bake_recording(**fields: Any) -> None:
    bake(trace_source="RECORDING", **fields)


def markers_of(markers: Iterable[Any]) -> list[tuple[int, str]]:
    return sorted((marker.frame, marker.name) for marker in markers)
