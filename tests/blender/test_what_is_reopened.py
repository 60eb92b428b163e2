# SPDX-License-Identifier: MIT
"""Nothing that the program itself wrote is reset when its file is opened again."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import bpy
import making
import numpy as np
import pytest

MANY = 300
DAY = 24 * 3600 * 10  # controls: no recording is longer


def test_many_moves_looks_and_changes_of_style_are_there_after_reopening(addon: ModuleType, tmp_path: Path) -> None:
    recordings = addon.recordings.recordings
    moves = [recordings.StartedMove(control, "a move with a long name", 3) for control in range(MANY)]
    styles = [recordings.StyleChange(control, "a style with a long name") for control in range(MANY)]
    looks = [addon.recordings.looks.LookChange(control, 2, 0.5, control, 1.5) for control in range(MANY)]
    obj = making.add_armature()
    trace = np.zeros((MANY, 4))
    reaches = [
        addon.recordings.reaches.ReachChange(control, control % 2, 0.5, 1, 0.5, 0.4, 1.5) for control in range(MANY)
    ]
    asked = {"moves": moves, "style": "calm", "styles": styles, "looks": looks, "reaches": reaches}
    recordings.add_recording(obj, trace, name="Long", **asked)
    path = str(tmp_path / "long.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    reopened = bpy.data.objects["Rig"].fragmotion.recordings["Long"]
    assert recordings.asked_of(reopened) == recordings.Asked(**asked)


@pytest.mark.thorough
def test_a_day_of_changes_of_style_is_there_after_reopening(addon: ModuleType, tmp_path: Path) -> None:
    recordings = addon.recordings.recordings
    styles = [recordings.StyleChange(control, "ab"[control % 2]) for control in range(DAY)]
    obj = making.add_armature()
    recordings.add_recording(obj, np.zeros((DAY, 4)), name="Day", styles=styles)
    path = str(tmp_path / "day.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    assert recordings.styles_of(bpy.data.objects["Rig"].fragmotion.recordings["Day"]) == styles


def test_many_moves_of_the_character_stay_told_after_reopening(addon: ModuleType, tmp_path: Path) -> None:
    obj = making.add_armature()
    for number in range(MANY):
        obj.fragmotion.moves.add().name = f"a move with a long name {number}"
    obj.fragmotion.moves_told = told = addon.character.moves._told(obj)
    path = str(tmp_path / "moves.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    assert bpy.data.objects["Rig"].fragmotion.moves_told == told
