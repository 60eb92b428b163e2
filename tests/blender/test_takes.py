# SPDX-License-Identifier: MIT
"""Takes stay with their armature, to the bit, whatever is done to the file."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import making
import numpy as np
import pytest


def make_trace(length: int = 50, seed: int = 1) -> np.ndarray:
    """A trace whose numbers have no short decimal form."""
    trace = making.waves(length, 4, seed)
    trace[:, 3] = np.abs(trace[:, 3])
    return trace


@pytest.fixture
def obj(addon: ModuleType) -> bpy.types.Object:
    """An armature with two takes."""
    armature = making.add_armature()
    addon.takes.add_take(armature, make_trace(), name="Stroll", seed=7, policy="svm", start=(1, 2, 0.5), quality=0.75)
    addon.takes.add_take(armature, make_trace(120, 2)).train = True
    return armature


def assert_kept(addon: ModuleType, obj: bpy.types.Object) -> None:
    """The armature has the fixture's takes."""
    stroll, other = obj.fragmotion.takes
    assert (stroll.name, stroll.seed, stroll.policy, tuple(stroll.start)) == ("Stroll", 7, "svm", (1, 2, 0.5))
    assert (stroll.seconds, stroll.quality, stroll.train) == (5, 0.75, False)
    assert (other.name, other.seconds, other.train) == ("Take", 12, True)
    np.testing.assert_array_equal(addon.takes.trace_of(stroll), make_trace())
    np.testing.assert_array_equal(addon.takes.trace_of(other), make_trace(120, 2))
    assert addon.takes.trained_on(obj) == [other]
    assert addon.takes.active_take(obj) == other


def append(path: Path, link: bool) -> bpy.types.Object:
    """The file's only armature, appended or linked into an empty file."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    with bpy.data.libraries.load(str(path), link=link) as (_, wanted):
        wanted.objects = ["Rig"]
    bpy.context.scene.collection.objects.link(wanted.objects[0])
    return wanted.objects[0]


def test_takes_survive_saving_and_loading(addon: ModuleType, obj: bpy.types.Object, tmp_path: Path) -> None:
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "kept.blend"))
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "kept.blend"))
    assert_kept(addon, bpy.data.objects["Rig"])


def test_takes_survive_append_and_making_a_link_local(addon: ModuleType, obj: bpy.types.Object, tmp_path: Path) -> None:
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "kept.blend"))
    assert_kept(addon, append(tmp_path / "kept.blend", link=False))
    linked = append(tmp_path / "kept.blend", link=True)
    assert_kept(addon, linked)
    assert_kept(addon, linked.make_local())


def test_takes_survive_a_renamed_armature_and_go_with_its_copy(addon: ModuleType, obj: bpy.types.Object) -> None:
    obj.name = obj.data.name = "Hero"
    assert_kept(addon, obj)
    copy = obj.copy()
    assert_kept(addon, copy)
    copy.fragmotion.takes.remove(0)
    assert_kept(addon, obj)
    making.activate(obj)
    assert bpy.ops.object.duplicate() == {"FINISHED"}
    assert_kept(addon, bpy.context.active_object)


def test_takes_survive_undo_and_redo(addon: ModuleType, obj: bpy.types.Object) -> None:
    bpy.ops.ed.undo_push(message="two takes")
    addon.takes.add_take(obj, make_trace(3))
    bpy.ops.ed.undo_push(message="three takes")
    bpy.ops.ed.undo()
    assert_kept(addon, bpy.data.objects["Rig"])
    bpy.ops.ed.redo()
    takes = bpy.data.objects["Rig"].fragmotion.takes
    assert [take.name for take in takes] == ["Stroll", "Take", "Take.001"]
    np.testing.assert_array_equal(addon.takes.trace_of(takes[2]), make_trace(3))


@pytest.mark.parametrize(
    "trace",
    [np.zeros((0, 4)), np.zeros((5, 3)), np.zeros(4), [[0, np.nan, 0, 0]], [[0, 1, 2, 0]], [[0, 1, 0, -0.1]]],
)
def test_what_is_no_trace_is_refused_and_changes_nothing(addon: ModuleType, obj: bpy.types.Object, trace: Any) -> None:
    with pytest.raises(addon.errors.UserError, match="A take"):
        addon.takes.add_take(obj, trace)
    with pytest.raises(addon.errors.UserError, match="A take"):
        addon.takes.set_trace(obj.fragmotion.takes[0], trace)
    assert_kept(addon, obj)


@pytest.mark.parametrize(
    "damage", [b"", b"not packed", lambda data: data[:-6], lambda data: data[:9] + b"?" + data[10:]]
)
def test_a_damaged_take_says_so(addon: ModuleType, obj: bpy.types.Object, damage: Any) -> None:
    take = obj.fragmotion.takes[0]
    take.controls = damage(take.controls) if callable(damage) else damage
    with pytest.raises(addon.errors.UserError, match="Take 'Stroll' is damaged: delete it"):
        addon.takes.trace_of(take)
