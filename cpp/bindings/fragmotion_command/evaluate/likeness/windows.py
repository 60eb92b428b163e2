# SPDX-License-Identifier: MIT
"""Motions as windows of 0.8 s, and how far sets of these are from each other.

A window is eight poses a tenth of a second apart, seen from the hips and the heading halfway: the places of all bones,
the hips' height over its mean, and a fifth of the velocities, that of the hips less its mean, so that 1 m/s off counts
as much as 0.2 m.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.spatial.distance import cdist

from ..rotations import Array, turned
from .poses import RATE, Body, heading

LENGTH = 48  # frames
APART = 18  # frames from a window to the next
COMPONENTS = 30
_STEP = 6  # frames between the poses of a window
_VELOCITIES = 0.2  # s
_BLOCK = 256  # windows whose distances are held at a time

Span = tuple[int, int]


def beginnings(spans: Sequence[Span]) -> list[int]:
    """The first frames of the windows of spans of frames."""
    return [first for begin, end in spans for first in range(begin, end - LENGTH, APART)]


def windows(body: Body, heads: Array, spans: Sequence[Span]) -> Array:
    """[N,D] of a motion's places [F,B,3]."""
    first = np.array(beginnings(spans), int)
    frames = first[:, None] + np.arange(0, LENGTH, _STEP)
    facing = heading(body, heads)[first + LENGTH // 2]
    places = heads[frames]
    hips = places[:, :, body.hips]
    seen = np.delete(places - hips[:, :, None], body.hips, axis=2)
    seen[..., :2] = turned(seen[..., :2], -facing[:, None, None])
    per_second = RATE / _STEP
    velocity = turned(np.diff(hips[..., :2], axis=1), -facing[:, None]) * per_second
    parts = (
        seen,
        hips[..., 2] - hips[..., 2].mean(1, keepdims=True),
        _VELOCITIES * (velocity - velocity.mean(1, keepdims=True)),
        _VELOCITIES * np.diff(seen, axis=1) * per_second,
    )
    return np.concatenate([part.reshape(len(first), int(np.prod(part.shape[1:]))) for part in parts], 1)


def principal_axes(values: Array, mean: Array) -> Array:
    """[D,30]: along which values differ most from a mean."""
    away = values - mean
    axes: Array = np.linalg.eigh(away.T @ away)[1][:, ::-1][:, :COMPONENTS]
    return axes


def frechet(some: Array, others: Array) -> float:
    """The Frechet distance of the Gaussians that fit two sets: of their means, squared, and of their spreads."""
    apart = some.mean(0) - others.mean(0)
    spread, other = np.cov(some.T), np.cov(others.T)
    sizes, axes = np.linalg.eigh(spread)
    root = (axes * np.sqrt(sizes.clip(0))) @ axes.T
    shared = np.sqrt(np.linalg.eigvalsh(root @ other @ root).clip(0)).sum()
    return float(apart @ apart + np.trace(spread + other) - 2 * shared)


def nearest(some: Array, others: Array) -> float:
    """The mean distance from each of some to the nearest of others."""
    blocks = np.array_split(some, -(-len(some) // _BLOCK))
    return float(np.concatenate([cdist(block, others).min(1) for block in blocks]).mean())
