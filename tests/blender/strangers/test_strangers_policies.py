# SPDX-License-Identifier: MIT
"""A .blend from a stranger chooses no path to write to or to read from."""

from __future__ import annotations

import hashlib
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import making
import odd_files
import pytest
from forging import EVIL, files_in, forging, opened

NAMES = (
    "{folder}/victim.policy",
    "//../victim.policy",
    "//sub/victim.policy",
    "//sub\\victim.policy",
    "//victim.sh",
    "\\\\host\\share\\victim.policy",
    "//",
    "",
)


def forge(addon: ModuleType, folder: Path, **fields: Any) -> Path:
    """The file with its armature's fields changed, in a folder with one more beside a victim."""
    place = folder / "place"
    (place / "sub").mkdir(parents=True)
    for key, value in fields.items():
        setattr(bpy.context.object.fragmotion, key, value)
    with forging(addon):
        bpy.ops.wm.save_as_mainfile(filepath=str(place / "hero.blend"))
    return place / "hero.blend"


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("content", ["evil", "policy"])
def test_a_file_never_says_where_or_what_is_written(
    addon: ModuleType, obj: bpy.types.Object, tmp_path: Path, name: str, content: str
) -> None:
    policy = bytes(obj.fragmotion.policy)
    data = EVIL if content == "evil" else policy
    named = name.format(folder=tmp_path)
    path = forge(addon, tmp_path, policy=data, policy_file=named, keep_policy="BESIDE")
    (tmp_path / "victim.policy").write_bytes(b"precious")
    expected = {"victim.policy": b"precious"}
    obj = opened(addon, path)
    assert files_in(tmp_path) == expected
    for target in (path, tmp_path / "other.blend"):
        bpy.ops.wm.save_as_mainfile(filepath=str(target))
    bpy.ops.wm.save_mainfile()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "copy.blend"), copy=True)
    found = files_in(tmp_path)
    assert {key: found.pop(key) for key in expected} == expected
    if content == "evil":
        assert found == {} and bytes(obj.fragmotion.policy) == EVIL
        assert "no policy" in addon.character.storing.troubles[obj.name]
    else:
        digest = hashlib.sha256(policy).hexdigest()[:16]
        own = {f"place/hero.Rig.{digest}.policy", f"other.Rig.{digest}.policy", f"copy.Rig.{digest}.policy"}
        own |= (
            {f"hero.Rig.{digest}.policy"} if bpy.app.version < (4, 0, 0) else set()
        )  # it tells no add-on the new name
        assert own >= set(found) >= {f"other.Rig.{digest}.policy"} and set(found.values()) == {policy}


@pytest.mark.parametrize("name", NAMES)
def test_a_file_never_says_what_is_read(addon: ModuleType, obj: bpy.types.Object, tmp_path: Path, name: str) -> None:
    policy = bytes(obj.fragmotion.policy)
    named, digest = name.format(folder=tmp_path), hashlib.sha256(policy).hexdigest()
    path = forge(addon, tmp_path, policy=b"", policy_digest=digest, policy_file=named)
    for victim in (tmp_path / "victim.policy", path.parent / "sub" / "victim.policy", path.parent / "victim.sh"):
        victim.write_bytes(policy)
    opened(addon, path)
    for keep in ("PACKED", "BESIDE"):
        bpy.context.object.fragmotion.keep_policy = keep
        with pytest.raises(RuntimeError, match=r"only a policy file in the folder of its own \.blend is read"):
            bpy.ops.fragmotion.bake(seconds=1)
        bpy.ops.wm.save_mainfile()
        assert not bpy.context.object.fragmotion.policy and "Rig" in addon.character.storing.troubles


def as_link(path: Path, policy: bytes) -> None:
    other = path.parents[1] / "elsewhere"
    other.write_bytes(policy)
    odd_files.make_link(path, other)


def as_pipe(path: Path, _policy: bytes) -> None:
    odd_files.make_pipe(path)


def as_folder(path: Path, _policy: bytes) -> None:
    path.mkdir()


def as_device(path: Path, _policy: bytes) -> None:
    odd_files.make_link(path, "/dev/zero")


@pytest.mark.parametrize(
    ("make", "cause"),
    [(as_link, "is a link"), (as_pipe, "a device or a pipe"), (as_folder, "is a folder"), (as_device, "is a link")],
)
def test_only_a_regular_file_beside_it_is_read(
    addon: ModuleType, obj: bpy.types.Object, tmp_path: Path, make: Callable[[Path, bytes], None], cause: str
) -> None:
    policy = bytes(obj.fragmotion.policy)
    digest = hashlib.sha256(policy).hexdigest()
    path = forge(addon, tmp_path, policy=b"", policy_digest=digest, policy_file="//x.policy")
    make(path.parent / "x.policy", policy)
    opened(addon, path)
    with pytest.raises(RuntimeError, match=cause):
        bpy.ops.fragmotion.bake(seconds=1)


def test_a_file_beside_it_that_is_too_large_is_not_read(
    addon: ModuleType, obj: bpy.types.Object, tmp_path: Path
) -> None:
    path = forge(addon, tmp_path, policy=b"", policy_digest="0", policy_file="//x.policy")
    with (path.parent / "x.policy").open("wb") as file:
        file.truncate(addon.files.LARGEST + 1)
    opened(addon, path)
    with pytest.raises(RuntimeError, match=r"x\.policy' is no policy file: it is larger than 1024 MB"):
        bpy.ops.fragmotion.bake(seconds=1)


def test_what_is_in_the_way_of_a_policy_file_is_left_alone(
    addon: ModuleType, obj: bpy.types.Object, tmp_path: Path
) -> None:
    policy = bytes(obj.fragmotion.policy)
    path = forge(addon, tmp_path, keep_policy="BESIDE")
    own = path.with_name(f"hero.Rig.{hashlib.sha256(policy).hexdigest()[:16]}.policy")
    victim = tmp_path / "victim"
    for in_the_way in ("other", "link"):
        own.unlink(missing_ok=True)
        victim.write_bytes(policy)
        own.write_bytes(b"other") if in_the_way == "other" else odd_files.make_link(own, victim)
        obj = opened(addon, path)
        bpy.ops.wm.save_mainfile()
        assert bytes(obj.fragmotion.policy) == policy and "Rig" in addon.character.storing.troubles
        assert victim.read_bytes() == policy and own.read_bytes() == (b"other" if in_the_way == "other" else policy)


def test_pipes_that_are_chosen_are_refused(addon: ModuleType, obj: bpy.types.Object, tmp_path: Path) -> None:
    pipes = [tmp_path / name for name in ("x.policy", "x.csv", "x.bvh")]
    for pipe in pipes:
        odd_files.make_pipe(pipe)
    policy, trace, take = map(str, pipes)
    calls = (
        lambda: bpy.ops.fragmotion.load_policy(filepath=policy),
        lambda: bpy.ops.fragmotion.import_recordings(filepath=trace),
        lambda: bpy.ops.fragmotion.bake(trace_source="FILE", trace_file=trace),
        lambda: bpy.ops.fragmotion.import_mocap("EXEC_DEFAULT", directory=str(tmp_path), files=[{"name": "x.bvh"}]),
    )
    before = making.contents()
    for call in calls:
        with pytest.raises(RuntimeError, match="is a device or a pipe: only regular files are read"):
            call()
    assert making.contents() == before and take
