# SPDX-License-Identifier: MIT
"""A file with a small character, to be forged."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import making
import numpy as np
import pytest


def _shown(addon: ModuleType, bones: int) -> tuple[np.ndarray, Any]:
    rotations = np.tile((1.0, 0, 0, 0), (60, bones, 1))
    return np.arange(60) / 60, addon.rig.motion.Motion(
        np.zeros((60, 3)), rotations, np.zeros((60, 3)), np.zeros(60, int)
    )


@pytest.fixture(scope="module")
def built(addon: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A file with a small character."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    obj = making.add_armature()
    for seed in range(3):
        action = making.add_action(obj, 60, seed=seed, name=f"take {seed}")
        action.use_fake_user = action.fragmotion.use = True
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=6, seconds=5) == {"FINISHED"}
    addon.recordings.recordings.add_recording(
        obj, making.waves(20, 4, 1) ** 2, name="Seen", shown=_shown(addon, len(obj.data.bones))
    )
    path = tmp_path_factory.mktemp("built") / "built.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path
