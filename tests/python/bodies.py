# SPDX-License-Identifier: MIT
"""Skeletons that are the same body in other bones, and bodies of other proportions, for tests of retargeting."""

from __future__ import annotations

from collections.abc import Callable

import fragmotion_core as core
import numpy as np
from conftest import Array


def times(a: Array, b: Array) -> Array:
    """Products of quaternions (w, x, y, z)."""
    w, v, x, u = a[..., :1], a[..., 1:], b[..., :1], b[..., 1:]
    return np.concatenate([w * x - (v * u).sum(-1, keepdims=True), w * u + x * v + np.cross(v, u)], -1)


def inverse(a: Array) -> Array:
    """Of unit quaternions."""
    return a * [1, -1, -1, -1]


def turned(rotation: Array, vectors: Array) -> Array:
    """Vectors turned by quaternions."""
    pure = np.concatenate([np.zeros_like(vectors[..., :1]), vectors], -1)
    return times(times(rotation, pure), inverse(rotation))[..., 1:]


def about(axis: Array | list[float], degrees: float) -> Array:
    """The rotation about an axis."""
    half = np.radians(degrees) / 2
    return np.concatenate([[np.cos(half)], np.sin(half) * np.asarray(axis, float) / np.linalg.norm(axis)])


def rest_rotations(skeleton: core.Skeleton) -> Array:
    """World rotations [B,4] at rest."""
    world = np.array(skeleton.rest_rotations)
    for bone, parent in enumerate(skeleton.parents):
        if parent >= 0:
            world[bone] = times(world[parent], world[bone])
    return world


def remade(
    skeleton: core.Skeleton,
    world: Array | None = None,
    size: float = 1.0,
    rename: Callable[[str], str] = str,
    stretch: Callable[[str], float] = lambda name: 1.0,
    rolls: Array | None = None,
) -> core.Skeleton:
    """The skeleton resting in other world rotations, of another size, with other names and with bones (their children's
    offsets) of other lengths. `rolls` [B,4]: how bones' frames are turned within the bones."""
    world = rest_rotations(skeleton) if world is None else world
    rolls = np.tile([1.0, 0, 0, 0], (len(world), 1)) if rolls is None else rolls
    framed = times(world, rolls)
    offsets, tips, local = np.array(skeleton.offsets), np.array(skeleton.tips), framed.copy()
    for bone, parent in enumerate(skeleton.parents):
        factor = size * stretch(skeleton.names[bone])
        tips[bone] = turned(inverse(rolls[bone]), size * tips[bone])
        offsets[bone] *= factor
        if parent >= 0:
            offsets[bone] = turned(inverse(rolls[parent]), offsets[bone])
            local[bone] = times(inverse(framed[parent]), framed[bone])
    names = [rename(name) for name in skeleton.names]
    roles = {role: rename(bone) for role, bone in skeleton.roles.items()}
    return core.Skeleton(names, skeleton.parents, local, offsets, tips, roles)


def map_of(body: core.Body, rename: Callable[[str], str] = str) -> dict[str, str]:
    """The roles of a body's bones under other names."""
    return {role: rename(bone) for role, bone in body.roles.items()}


def random_rolls(skeleton: core.Skeleton, seed: int = 1) -> Array:
    """Any rotations."""
    rolls = np.random.default_rng(seed).normal(size=(len(skeleton.names), 4))
    return np.asarray(rolls / np.linalg.norm(rolls, axis=1, keepdims=True))


def posed(skeleton: core.Skeleton, world: Array, turns: dict[str, Array]) -> Array:
    """World rotations with bones, and what hangs on them, turned about world axes."""
    whole = np.tile([1.0, 0, 0, 0], (len(world), 1))
    for bone, parent in enumerate(skeleton.parents):
        if parent >= 0:
            whole[bone] = whole[parent]
        if skeleton.names[bone] in turns:
            whole[bone] = times(turns[skeleton.names[bone]], whole[bone])
    return times(whole, world)


def angles(a: Array, b: Array) -> Array:
    """Between rotations, degrees."""
    return np.asarray(np.degrees(2 * np.arccos(np.clip(np.abs((a * b).sum(-1)), 0, 1))))
