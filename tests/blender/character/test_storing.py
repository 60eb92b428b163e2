# SPDX-License-Identifier: MIT
"""A policy is kept inside the .blend or beside it, as chosen, and is never lost between the two."""

from __future__ import annotations

import os
import shutil
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType

import bpy
import making
import numpy as np
import odd_files
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
    addon.character.building.forget()
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
    file = next(blend.parent.glob("hero.*.policy"))
    assert file.read_bytes() == policy
    assert obj.fragmotion.policy == b"" and obj.fragmotion.policy_file == f"//{file.name}"
    assert blend.stat().st_size < built.stat().st_size
    obj = reopened(addon, blend)
    assert addon.character.building.load(obj).to_bytes() == policy
    file.unlink()
    assert addon.character.building.load(obj) is addon.character.building.load(obj), "it is decoded once"
    obj = reopened(addon, blend)
    with pytest.raises(RuntimeError, match=r"beside the \.blend, but '.*\.policy' cannot be read.*put the file back"):
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


@pytest.mark.thorough
@pytest.mark.parametrize("copy", [False, True])
def test_a_policy_follows_its_file_into_another_folder(
    addon: ModuleType, blend: Path, tmp_path: Path, copy: bool
) -> None:
    bpy.ops.wm.save_mainfile()
    other = tmp_path / "second" / "hero.blend"
    other.parent.mkdir()
    reopened(addon, blend)
    bpy.ops.wm.save_as_mainfile(filepath=str(other), copy=copy)
    addon.character.building.forget()
    assert bakes(bpy.data.objects[making.ARMATURE]), "the open file has lost its policy"
    if copy and bpy.app.version < (4, 0, 0):
        return  # it tells no add-on where a copy goes
    shutil.rmtree(blend.parent)
    assert bakes(reopened(addon, other))


@pytest.mark.thorough
def test_a_build_after_a_save_is_kept_and_a_copy_of_the_armature_keeps_the_former(
    addon: ModuleType, blend: Path
) -> None:
    bpy.ops.wm.save_mainfile()
    obj = reopened(addon, blend)
    former = addon.character.building.load(obj).to_bytes()
    twin = obj.copy()
    twin.name = "Twin"
    bpy.context.scene.collection.objects.link(twin)
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=20, seconds=5) == {"FINISHED"}
    latter = bytes(obj.fragmotion.policy)
    assert latter != former
    bpy.ops.wm.save_mainfile()
    obj = reopened(addon, blend)
    assert addon.character.building.load(obj).to_bytes() == latter
    assert addon.character.building.load(bpy.data.objects["Twin"]).to_bytes() == former


def test_where_the_file_cannot_be_written_the_policy_stays_inside(
    addon: ModuleType, obj: bpy.types.Object, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "hero.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    obj.fragmotion.keep_policy = "BESIDE"

    def fail(*_: object) -> None:
        raise OSError("the disk is full")

    monkeypatch.setattr(addon.character.storing.os, "replace", fail)
    bpy.ops.wm.save_mainfile()
    monkeypatch.undo()
    assert addon.character.storing.troubles == {obj.name: "the disk is full"}
    assert [file.name for file in tmp_path.iterdir() if "policy" in file.name] == []
    assert bakes(reopened(addon, path))


def test_an_error_that_nobody_foresaw_is_told_and_the_file_is_saved(
    addon: ModuleType, obj: bpy.types.Object, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "hero.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    obj.fragmotion.keep_policy = "BESIDE"
    for error, told in ((MemoryError(), "not enough memory"), (RuntimeError("no luck"), "no luck")):

        def fail(*_: object, error: Exception = error) -> None:
            raise error

        monkeypatch.setattr(addon.character.storing, "write_new", fail)
        bpy.ops.wm.save_mainfile()
        assert told in addon.character.storing.troubles[obj.name]
    monkeypatch.undo()
    assert bakes(reopened(addon, path))


@pytest.mark.skipif(os.name == "nt", reason="Windows opens no folder")
def test_a_new_file_and_its_name_are_on_the_disk(
    addon: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    settled = []
    monkeypatch.setattr(addon.files.os, "fsync", lambda file: settled.append(os.fstat(file).st_ino))
    addon.files.write_new(tmp_path / "x.policy", b"?")
    assert settled == [(tmp_path / "x.policy").stat().st_ino, tmp_path.stat().st_ino]


def test_without_a_file_a_copy_leaves_the_policy_inside(
    addon: ModuleType, obj: bpy.types.Object, tmp_path: Path
) -> None:
    obj.fragmotion.keep_policy = "BESIDE"
    policy = bytes(obj.fragmotion.policy)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "copy.blend"), copy=True)
    addon.character.building.forget()
    assert addon.character.building.load(obj).to_bytes() == policy


@pytest.fixture
def small(addon: ModuleType, tmp_path: Path) -> Path:
    """A file with a small character beside it, its backups off, and made large."""
    addon.character.building.forget()
    obj = making.add_armature(name="Hero")
    for seed in range(2):
        action = making.add_action(obj, 40, seed=seed, name=f"take {seed}")
        action.use_fake_user = action.fragmotion.use = True
    bpy.context.scene["ballast"] = np.random.default_rng(1).bytes(2_000_000)  # nothing compresses it
    obj.fragmotion.keep_policy = "BESIDE"
    rebuild(obj)
    bpy.context.preferences.filepaths.save_version = 0
    for _ in range(2):  # 3.4 does not tell where a first save goes
        bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "small.blend"))
    return tmp_path / "small.blend"


def rebuild(obj: bpy.types.Object, seed: int = 1) -> bytes:
    """Another character, which is to be kept beside the file."""
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", True, classes=4, seconds=2, seed=seed) == {"FINISHED"}
    return bytes(bpy.data.objects["Hero"].fragmotion.policy)


def open_small(addon: ModuleType, path: Path) -> bpy.types.Object:
    addon.character.building.forget()
    bpy.ops.wm.open_mainfile(filepath=str(path))
    making.activate(bpy.data.objects["Hero"])
    return bpy.data.objects["Hero"]


def policies_in(folder: Path) -> list[bytes]:
    return sorted(path.read_bytes() for path in folder.glob("*.policy"))


@contextmanager
def full_disk(room: int) -> Iterator[None]:
    """No file grows beyond so many bytes."""
    resource = pytest.importorskip("resource", reason="Windows sets no limit to the size of files")
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    before = signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (room, limits[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        signal.signal(signal.SIGXFSZ, before)


@pytest.mark.parametrize("room", [1_000_000, 50_000])  # the policy fits, but not the .blend; neither fits
def test_a_save_that_fails_loses_neither_the_former_character_nor_the_new_one(
    addon: ModuleType, small: Path, room: int
) -> None:
    obj = open_small(addon, small)
    former = addon.character.building.load(obj).to_bytes()
    new = rebuild(obj, seed=2)
    assert new != former and 50_000 < len(new) < 1_000_000 < small.stat().st_size
    saved = small.read_bytes()
    with full_disk(room), pytest.raises(RuntimeError):
        bpy.ops.wm.save_mainfile()
    assert small.read_bytes() == saved and former in policies_in(small.parent)
    assert not list(small.parent.glob("*.tmp"))
    addon.character.building.forget()
    assert addon.character.building.load(obj).to_bytes() == new, "the open file has lost the new character"
    for path in small.parent.glob("*.policy"):
        if path.read_bytes() == new:
            path.unlink()  # what was written for the save that failed is not needed
    assert addon.character.building.load(obj).to_bytes() == new
    bpy.ops.wm.save_mainfile()
    assert policies_in(small.parent) == [new]
    assert addon.character.building.load(open_small(addon, small)).to_bytes() == new


def test_the_file_of_a_save_that_failed_opens_its_character(addon: ModuleType, small: Path) -> None:
    obj = open_small(addon, small)
    former = addon.character.building.load(obj).to_bytes()
    rebuild(obj, seed=2)
    with full_disk(1_000_000), pytest.raises(RuntimeError):
        bpy.ops.wm.save_mainfile()
    assert addon.character.building.load(open_small(addon, small)).to_bytes() == former


@pytest.mark.parametrize("copy", [False, True])
def test_a_save_elsewhere_that_fails_changes_nothing(addon: ModuleType, small: Path, copy: bool) -> None:
    obj = open_small(addon, small)
    new = rebuild(obj, seed=2)
    with pytest.raises(RuntimeError):
        bpy.ops.wm.save_as_mainfile(filepath=str(small.parent / "missing" / "other.blend"), copy=copy)
    addon.character.building.forget()
    assert addon.character.building.load(obj).to_bytes() == new
    bpy.ops.wm.save_mainfile()
    assert addon.character.building.load(open_small(addon, small)).to_bytes() == new


def test_the_former_policy_is_let_go_of_after_the_save_and_undo_brings_it_back(addon: ModuleType, small: Path) -> None:
    obj = open_small(addon, small)
    bpy.ops.ed.undo_push(message="before")
    former = addon.character.building.load(obj).to_bytes()
    new = rebuild(obj, seed=2)
    bpy.ops.wm.save_mainfile()
    assert policies_in(small.parent) == [new]
    bpy.ops.ed.undo()
    addon.character.building.forget()
    assert addon.character.building.load(bpy.data.objects["Hero"]).to_bytes() == former
    bpy.ops.wm.save_mainfile()
    assert policies_in(small.parent) == [former]
    assert addon.character.building.load(open_small(addon, small)).to_bytes() == former


def test_a_backup_of_the_file_keeps_its_policy(addon: ModuleType, small: Path) -> None:
    obj = open_small(addon, small)
    bpy.context.preferences.filepaths.save_version = 1
    before = addon.character.building.load(obj).to_bytes()
    for seed in (2, 3):
        former, before = before, rebuild(obj, seed=seed)
        bpy.ops.wm.save_mainfile()
    assert policies_in(small.parent) == sorted((former, before))
    assert addon.character.building.load(open_small(addon, small.with_suffix(".blend1"))).to_bytes() == former
    assert addon.character.building.load(open_small(addon, small)).to_bytes() == before


def test_armatures_of_like_names_have_backups_of_their_own(addon: ModuleType, small: Path) -> None:
    obj = open_small(addon, small)
    bpy.context.preferences.filepaths.save_version = 1
    twin = obj.copy()
    bpy.context.scene.collection.objects.link(twin)
    kept = set()
    for seed in (2, 3):
        for each, name in ((obj, "Hero.1"), (twin, "Hero:1")):
            making.activate(each)
            each.name = "Hero"  # for rebuild
            kept.add(rebuild(each, seed=seed if each == obj else seed + 10))
            each.name = name
        bpy.ops.wm.save_mainfile()
    assert kept <= set(policies_in(small.parent))


def test_saving_the_startup_file_lets_go_of_nothing(addon: ModuleType, small: Path) -> None:
    obj = open_small(addon, small)
    bpy.context.preferences.filepaths.save_version = 0
    before = addon.character.building.load(obj).to_bytes()
    rebuild(obj, seed=2)
    bpy.ops.wm.save_homefile()
    assert before in policies_in(small.parent)
    assert addon.character.building.load(open_small(addon, small)).to_bytes() == before


def test_a_file_saved_over_a_link_has_its_policy_beside_it(addon: ModuleType, small: Path, tmp_path: Path) -> None:
    link = tmp_path / "links" / "small.blend"
    link.parent.mkdir()
    odd_files.make_link(link, small)
    expected = rebuild(open_small(addon, link), seed=2)
    bpy.ops.wm.save_mainfile()
    assert addon.character.building.load(open_small(addon, link)).to_bytes() == expected


def test_a_backup_that_is_saved_itself_takes_nothing_from_its_file(addon: ModuleType, small: Path) -> None:
    bpy.context.preferences.filepaths.save_version = 0
    before = addon.character.building.load(open_small(addon, small)).to_bytes()
    backup = small.with_suffix(".blend1")
    shutil.copy(small, backup)
    rebuild(open_small(addon, backup), seed=2)
    bpy.ops.wm.save_as_mainfile(filepath=str(backup), check_existing=False)
    assert addon.character.building.load(open_small(addon, small)).to_bytes() == before


def test_a_policy_beside_a_file_of_any_name_is_read_again(addon: ModuleType, small: Path) -> None:
    odd = small.with_name("walk 12:30.blend")
    expected = addon.character.building.load(open_small(addon, small)).to_bytes()
    bpy.ops.wm.save_as_mainfile(filepath=str(odd))
    bpy.ops.wm.save_mainfile()
    assert addon.character.building.load(open_small(addon, odd)).to_bytes() == expected


def test_only_files_that_were_written_for_this_blend_are_let_go_of(addon: ModuleType, small: Path) -> None:
    (own,) = small.parent.glob("*.policy")
    data, digest = own.read_bytes(), own.name.split(".")[-2]
    others = {
        f"small.v2.Hero.{digest}.policy": data,  # small.v2.blend's
        f"other.Hero.{digest}.policy": data,
        "small.Hero.0123456789abcdef.policy": b"not what its name says",
        "small.Hero.policy": data,
        "Hero.policy": data,
    }
    for name, content in others.items():
        (small.parent / name).write_bytes(content)
    link = small.with_name("small.Link.0123456789abcdef.policy")
    odd_files.make_link(link, own)
    rebuild(open_small(addon, small), seed=2)
    bpy.ops.wm.save_mainfile()
    assert not own.exists() and link.is_symlink()
    assert {name: (small.parent / name).read_bytes() for name in others} == others


def test_a_policy_beside_a_file_of_an_earlier_version_is_read_and_gets_a_name_of_its_own(
    addon: ModuleType, small: Path
) -> None:
    (own,) = small.parent.glob("*.policy")
    obj = open_small(addon, small)
    own.rename(small.with_name("Hero.policy"))
    obj.fragmotion.policy_file = "//Hero.policy"
    policy = addon.character.building.load(obj).to_bytes()
    bpy.ops.wm.save_mainfile()
    assert own.read_bytes() == policy and small.with_name("Hero.policy").exists()
    assert obj.fragmotion.policy_file == f"//{own.name}"
