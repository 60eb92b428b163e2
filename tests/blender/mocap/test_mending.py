# SPDX-License-Identifier: MIT
"""What the doctor found in a take is put right in its Action by the button beside it."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import making
import numpy as np
import pytest
from test_importing import import_folder

HELD = 30  # frames


@pytest.fixture
def walk(addon: ModuleType) -> Any:
    """A take of the sample, whose armature is active."""
    obj = making.open_sample()
    core, rig = addon.compat.core.core, addon.rig.rigs.make_rig(obj)
    action = next(action for action in bpy.data.actions if "walk" in action.name)
    clip = addon.mocap.sampling.sample(bpy.context, obj, action, rig)
    return core.Take.from_clip(clip, rig.skeleton)


def write(addon: ModuleType, path: Path, take: Any, rows: Any) -> None:
    """Write the rows of a take."""
    core = addon.compat.core.core
    part = core.Take(take.skeleton, take.name, take.rate, take.translations[rows], take.rotations[rows])
    core.write_bvh(part, path)


def choose(action: bpy.types.Action) -> Any:
    """Click the Action in the list, and give its findings."""
    bpy.context.window_manager.fragmotion.active_action = bpy.data.actions.find(action.name)
    return action.fragmotion.findings


def index_of(findings: Any, code: str) -> int:
    return [row.code for row in findings].index(code)


@pytest.fixture
def held(addon: ModuleType, walk: Any, tmp_path: Path) -> bpy.types.Action:
    """An Action of the sample at whose end nothing moves, as it came in."""
    last = len(walk.rotations) - 1
    write(addon, tmp_path / "held.bvh", walk, [*range(last), *[last] * HELD])
    import_folder(tmp_path, onto="ACTIVE", mend=False)
    return bpy.data.actions["held"]


def test_frames_that_do_not_move_are_cut_off(addon: ModuleType, walk: Any, held: bpy.types.Action) -> None:
    obj, findings = bpy.context.object, choose(held)
    names = [bone.name for bone in obj.pose.bones if bone.name != "root"]
    times = np.arange(1, 60, 9)
    before, first, last = making.blender_poses(obj, held, times, names), *held.frame_range
    index = index_of(findings, "frozen")
    assert findings[index].mendable and not findings[index].mended
    assert bpy.ops.fragmotion.mend_finding(index=index) == {"FINISHED"}
    assert choose(held)[index].mended
    step = addon.mocap.sampling.scene_rate(bpy.context.scene) / walk.rate
    assert held.frame_range[0] == first and held.frame_range[1] == pytest.approx(
        last - (HELD - 1) * step, abs=step + 0.01
    )
    after = making.blender_poses(obj, held, times, names)
    np.testing.assert_allclose(after[..., :3, 3], before[..., :3, 3], atol=1e-4)


def test_mending_twice_finds_nothing_left(held: bpy.types.Action) -> None:
    index = index_of(choose(held), "frozen")
    assert bpy.ops.fragmotion.mend_finding(index=index) == {"FINISHED"}
    frames = tuple(held.frame_range)
    assert bpy.ops.fragmotion.mend_finding(index=index) == {"FINISHED"}
    assert tuple(held.frame_range) == frames


def test_frames_that_are_left_out_keep_their_meaning(held: bpy.types.Action) -> None:
    index = index_of(choose(held), "frozen")
    held.fragmotion.left_out.add()
    before = making.contents()
    with pytest.raises(RuntimeError, match="take these in first"):
        bpy.ops.fragmotion.mend_finding(index=index)
    assert making.contents() == before and not held.fragmotion.findings[index].mended


def test_a_take_that_is_there_twice_is_unticked(addon: ModuleType, walk: Any, tmp_path: Path) -> None:
    for name in ("one", "two"):
        write(addon, tmp_path / f"{name}.bvh", walk, slice(None))
    import_folder(tmp_path, onto="ACTIVE")
    action = next(a for a in bpy.data.actions if any(row.code == "duplicate" for row in a.fragmotion.findings))
    assert action.fragmotion.use
    assert bpy.ops.fragmotion.mend_finding(index=index_of(choose(action), "duplicate")) == {"FINISHED"}
    assert not action.fragmotion.use


def test_what_cannot_be_mended_is_refused(held: bpy.types.Action) -> None:
    choose(held)
    with pytest.raises(RuntimeError, match="nothing here that could be mended"):
        bpy.ops.fragmotion.mend_finding(index=99)
