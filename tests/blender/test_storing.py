# SPDX-License-Identifier: MIT
"""A policy is kept inside the .blend or beside it, as chosen, and is never lost between the two."""

from __future__ import annotations

import shutil
from pathlib import Path
from types import ModuleType

import bpy
import making
import pytest


@pytest.fixture
def blend(obj: bpy.types.Object, tmp_path: Path) -> Path:
    """The built file, saved with its policy beside it."""
    path = tmp_path / "first" / "hero.blend"
    path.parent.mkdir()
    obj.fragmotion.keep_policy = "BESIDE"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


def reopened(addon: ModuleType, path: Path) -> bpy.types.Object:
    addon.building.forget()
    return making.open_armature(path)


def bakes(obj: bpy.types.Object) -> bool:
    making.activate(obj)
    return bpy.ops.fragmotion.bake(seconds=1) == {"FINISHED"}


def test_a_policy_beside_the_file_is_read_from_there(
    addon: ModuleType, built: Path, blend: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    policy = bytes(reopened(addon, built).fragmotion.policy)
    assert len(policy) > 100_000
    files = list(blend.parent.glob("*.policy"))
    assert [file.read_bytes() for file in files] in ([policy], [])  # 3.4 does not tell where a first save goes
    obj = reopened(addon, blend)
    bpy.ops.wm.save_mainfile()
    (file,) = blend.parent.glob("*.policy")
    assert file.read_bytes() == policy
    assert obj.fragmotion.policy == b"" and obj.fragmotion.policy_file == f"//{file.name}"
    assert blend.stat().st_size < built.stat().st_size
    obj = reopened(addon, blend)
    assert addon.building.load(obj).to_bytes() == policy
    file.unlink()
    assert addon.building.load(obj) is addon.building.load(obj), "it is decoded once"
    obj = reopened(addon, blend)
    with pytest.raises(RuntimeError, match=r"kept in '.*\.policy', which cannot be read.*put the file back"):
        bpy.ops.fragmotion.bake(seconds=1)
    file.write_bytes(policy[:-1] + b"?")
    with pytest.raises(RuntimeError, match=r"\.policy' is not the policy that armature '.*' was saved with"):
        bpy.ops.fragmotion.bake(seconds=1)
    file.write_bytes(policy)
    assert bakes(obj)


def test_a_policy_comes_back_inside_when_that_is_chosen(addon: ModuleType, built: Path, blend: Path) -> None:
    bpy.ops.wm.save_mainfile()
    obj = reopened(addon, blend)
    obj.fragmotion.keep_policy = "PACKED"
    bpy.ops.wm.save_mainfile()
    for file in blend.parent.glob("*.policy"):
        file.unlink()
    obj = reopened(addon, blend)
    assert bytes(obj.fragmotion.policy) == bytes(reopened(addon, built).fragmotion.policy)


@pytest.mark.parametrize("copy", [False, True])
def test_a_policy_follows_its_file_into_another_folder(
    addon: ModuleType, blend: Path, tmp_path: Path, copy: bool
) -> None:
    bpy.ops.wm.save_mainfile()
    other = tmp_path / "second" / "hero.blend"
    other.parent.mkdir()
    reopened(addon, blend)
    bpy.ops.wm.save_as_mainfile(filepath=str(other), copy=copy)
    addon.building.forget()
    assert bakes(bpy.data.objects[making.ARMATURE]), "the open file has lost its policy"
    if copy and bpy.app.version < (4, 0, 0):
        return  # it tells no add-on where a copy goes
    shutil.rmtree(blend.parent)
    assert bakes(reopened(addon, other))


def test_a_build_after_a_save_is_kept_and_a_copy_of_the_armature_keeps_the_former(
    addon: ModuleType, blend: Path
) -> None:
    bpy.ops.wm.save_mainfile()
    obj = reopened(addon, blend)
    former = addon.building.load(obj).to_bytes()
    twin = obj.copy()
    twin.name = "Twin"
    bpy.context.scene.collection.objects.link(twin)
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=20, seconds=5) == {"FINISHED"}
    latter = bytes(obj.fragmotion.policy)
    assert latter != former
    bpy.ops.wm.save_mainfile()
    obj = reopened(addon, blend)
    assert addon.building.load(obj).to_bytes() == latter
    assert addon.building.load(bpy.data.objects["Twin"]).to_bytes() == former


def test_where_the_file_cannot_be_written_the_policy_stays_inside(
    addon: ModuleType, obj: bpy.types.Object, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "hero.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    obj.fragmotion.keep_policy = "BESIDE"

    def fail(*_: object) -> None:
        raise OSError("the disk is full")

    monkeypatch.setattr(addon.storing.os, "replace", fail)
    bpy.ops.wm.save_mainfile()
    monkeypatch.undo()
    assert addon.storing.troubles == {obj.name: "the disk is full"}
    assert [file.name for file in tmp_path.iterdir() if "policy" in file.name] == []
    assert bakes(reopened(addon, path))


def test_without_a_file_a_copy_leaves_the_policy_inside(
    addon: ModuleType, obj: bpy.types.Object, tmp_path: Path
) -> None:
    obj.fragmotion.keep_policy = "BESIDE"
    policy = bytes(obj.fragmotion.policy)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "copy.blend"), copy=True)
    addon.building.forget()
    assert addon.building.load(obj).to_bytes() == policy
