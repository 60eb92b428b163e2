# SPDX-License-Identifier: GPL-3.0-or-later
"""The keys of F-curves, which both the clip of an Action and its digest are made of."""

from __future__ import annotations

from collections.abc import Iterator
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
    if _kept is None:
        return _read(curve)
    key = curve.as_pointer()
    if key not in _kept:
        _kept[key] = _read(curve)
    return _kept[key]


def _read(curve: bpy.types.FCurve) -> NDArray[np.float32]:
    points = np.empty((len(curve.keyframe_points), 2), np.float32)
    curve.keyframe_points.foreach_get("co", points.ravel())
    return points
