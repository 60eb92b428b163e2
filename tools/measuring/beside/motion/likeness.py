# SPDX-License-Identifier: MIT
"""How far half a second of motion is from the nearest half second of the takes and their mirror images, whoever made it
and however: six poses a tenth of a second apart, as the character frame halfway sees their joints, and the ways between
them. The distance is the root of the mean square over poses and joints, of places and of ways, m of a character of
1.8 m."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from fragmotion_command.evaluate.rotations import Array, turned

from tools.measuring.peers.kinematics.bodies import RATE, Body, Motion, facing, world

APART, POSES = round(0.1 * RATE), 6
REACH = APART * (POSES - 1)  # frames from a window's first to its last
_STRIDE = 2  # frames between the takes' windows
_CANDIDATES, _AXES = 12, 64  # windows that are compared in full, and principal components by which they are found
_SAMPLE, _BLOCK = 8000, 256  # windows


def windows(body: Body, motion: Motion, stride: int) -> tuple[Array, Array]:
    """[K,D] float32, and the first frame of each."""
    heads = world(body, motion.root, motion.rotations)[0] * body.scale
    first = np.arange(0, len(heads) - REACH, stride)
    joints = heads[first[:, None] + np.arange(POSES) * APART]
    middle = first + REACH // 2
    joints[..., :2] -= heads[middle, None, :1, :2]
    joints[..., :2] = turned(joints[..., :2], -facing(body, motion.rotations)[middle, None, None])
    places, ways = (_mean_square(part) for part in (joints, np.diff(joints, axis=1)))
    return np.concatenate((places, ways), 1).astype(np.float32), first


def _mean_square(vectors: Array) -> Array:
    """[K,P,B,3] as rows whose squares add up to the mean of the vectors'."""
    rows: Array = vectors.reshape(len(vectors), -1) / np.sqrt(vectors.shape[1] * vectors.shape[2])
    return rows


class Likeness:
    """Finds the takes' nearest windows."""

    def __init__(self, body: Body, captured: Sequence[Motion], mirrored: Sequence[Motion]) -> None:
        self._body = body
        pairs = [(i, m) for i, pair in enumerate(zip(captured, mirrored)) for m in pair if len(m.root) > REACH]
        each = [windows(body, motion, _STRIDE)[0] for _, motion in pairs]
        self._windows = np.concatenate(each)
        self._take = np.repeat([i for i, _ in pairs], [len(some) for some in each])
        self._mean = self._windows.mean(0)
        sample = self._windows[:: max(1, len(self._windows) // _SAMPLE)] - self._mean
        self._axes = np.linalg.svd(sample, full_matrices=False)[2][:_AXES].T.copy()
        self._reduced = (self._windows - self._mean) @ self._axes
        self._squares = (self._reduced**2).sum(1)
        apart = [self._from_others(i, motion) for i, motion in enumerate(captured) if len(motion.root) > REACH]
        self.takes = float(np.concatenate(apart).mean())
        """The mean distance of the takes, each from all others."""

    def _from_others(self, number: int, motion: Motion) -> Array:
        return self._nearest(windows(self._body, motion, APART)[0], number)

    def of(self, motion: Motion) -> tuple[Array, Array]:
        """m, a window each tenth of a second, and their first frames."""
        found, first = windows(self._body, motion, APART)
        return self._nearest(found), first

    def _nearest(self, queries: Array, without: int = -1) -> Array:
        blocks = np.array_split(queries, max(1, len(queries) // _BLOCK))
        return np.concatenate([self._nearest_of_block(block, without) for block in blocks])

    def _nearest_of_block(self, block: Array, without: int) -> Array:
        reduced = (block - self._mean) @ self._axes
        squares = self._squares - 2 * reduced @ self._reduced.T
        squares[:, self._take == without] = np.inf
        near = np.argpartition(squares, min(_CANDIDATES, squares.shape[1] - 1), axis=1)[:, :_CANDIDATES]
        exact = np.linalg.norm(self._windows[near] - block[:, None], axis=2)
        exact[self._take[near] == without] = np.inf
        nearest: Array = exact.min(1)
        return nearest
