# SPDX-License-Identifier: GPL-3.0-or-later
"""The keys of F-curves, which both the clip of an Action and its digest are made of."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING

import bpy
import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

_kept: dict[int, NDArray[np.float32]] | None = None


@contextmanager
def read_once() -> Iterator[None]:
    """Inside, while no curve changes, each curve's keys are read from Blender once."""
    global _kept
    _kept = {}
    try:
        yield
    finally:
        _kept = None


def points_of(curve: bpy.types.FCurve) -> NDArray[np.float32]:
    """[K,2]: scene frames and values of the curve's keys; not to be changed."""
    kept = None if _kept is None else _kept.get(curve.as_pointer())
    return points_of_alike([curve], len(curve.keyframe_points))[0] if kept is None else kept


def points_of_alike(curves: Sequence[bpy.types.FCurve], count: int) -> NDArray[np.float32]:
    """[C,K,2]: points_of() of curves that have `count` keys each."""
    points = np.empty((len(curves), count, 2), np.float32)
    for curve, row in zip(curves, points.reshape(len(curves), 2 * count)):
        curve.keyframe_points.foreach_get("co", row)
    if _kept is not None:
        _kept.update((curve.as_pointer(), row) for curve, row in zip(curves, points))
    return points
