# SPDX-License-Identifier: MIT
"""An armature to bake, and a recording of it."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import bpy
import numpy as np
import pytest
from baked import RATE, SEED


@pytest.fixture
def trace(addon: ModuleType) -> np.ndarray:
    """Four seconds of walking and turning."""
    return np.concatenate([np.tile([0, 1.2, 0, 0], (15, 1)), np.tile([0, 1.2, 1, 0], (25, 1))]).astype(float)


@pytest.fixture
def obj(obj: bpy.types.Object) -> bpy.types.Object:
    """The built armature, away from the world's origin, at 30 frames a second."""
    scene = bpy.context.scene
    scene.render.fps, scene.render.fps_base = RATE, 1.0
    scene.frame_set(1)
    obj.location, obj.rotation_euler.z = (2, -1, 0.5), 0.7
    return obj


@pytest.fixture
def recording(addon: ModuleType, obj: bpy.types.Object, trace: np.ndarray) -> Any:
    """A recording of the trace, selected."""
    return addon.recordings.recordings.add_recording(obj, trace, name="Stroll", seed=SEED, start=(2, -1, 0.7 + np.pi))
