# SPDX-License-Identifier: MIT
"""An armature with a recording of it that was seen while it was made."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import making
import numpy as np
import pytest


@pytest.fixture(scope="package")
def built(addon: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A file with a small character, which goes where it is told."""
    folder = tmp_path_factory.mktemp("built")
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    making.write_gaits(folder)
    assert bpy.ops.fragmotion.import_mocap(directory=str(folder)) == {"FINISHED"}
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=24, seconds=20.0, synthesize=False) == {"FINISHED"}
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "built.blend"))
    return folder / "built.blend"


@pytest.fixture
def trace(addon: ModuleType) -> np.ndarray:
    """Twelve seconds of a walker."""
    trace: np.ndarray = addon.compat.core.core.simulate_trace("walker", 12.0, 5)
    return trace


@pytest.fixture
def recording(addon: ModuleType, obj: bpy.types.Object, trace: np.ndarray) -> Any:
    """A recording of the trace with what was shown, selected; the scene has 24 frames a second and Bake begins at 5."""
    bpy.context.scene.render.fps, bpy.context.scene.render.fps_base = 24, 1.0
    obj.fragmotion.bake.frame_start = 5
    made = addon.recordings.recordings.add_recording(obj, trace, name="Stroll", seed=3, start=(2, -1, 0.5))
    motion = addon.edits.replaying.replay(obj, addon.character.building.load(obj), made, trace, 3)
    addon.recordings.recordings.set_shown(made, np.arange(len(motion.classes)) / 60, motion)
    return made
