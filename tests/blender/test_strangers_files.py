# SPDX-License-Identifier: MIT
"""A .blend from a stranger chooses no path to write to or to read from; what is damaged in it is said in a sentence."""

from __future__ import annotations

import hashlib
import os
import struct
import tracemalloc
import zlib
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import making
import numpy as np
import pytest

EVIL = b"#!/bin/sh\nharm\n"
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


def _shown(addon: ModuleType, bones: int) -> tuple[np.ndarray, Any]:
    rotations = np.tile((1.0, 0, 0, 0), (60, bones, 1))
    return np.arange(60) / 60, addon.rig.motion.Motion(
        np.zeros((60, 3)), rotations, np.zeros((60, 3)), np.zeros(60, int)
    )


@contextmanager
def forging(addon: ModuleType) -> Iterator[None]:
    """Files are saved as by a program that is not ours."""
    addon.character.storing.unregister()
    yield
    addon.character.storing.register()


def opened(addon: ModuleType, path: Path) -> Any:
    addon.character.building.forget()
    bpy.ops.wm.open_mainfile(filepath=str(path))
    return bpy.context.view_layer.objects.active


def files_in(folder: Path) -> dict[str, bytes]:
    """All files but the .blends."""
    paths = (path for path in folder.rglob("*") if path.is_file() and ".blend" not in path.name)
    return {str(path.relative_to(folder)): path.read_bytes() for path in paths}


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
    path.symlink_to(other)


def as_pipe(path: Path, _policy: bytes) -> None:
    os.mkfifo(path)


def as_folder(path: Path, _policy: bytes) -> None:
    path.mkdir()


def as_device(path: Path, _policy: bytes) -> None:
    path.symlink_to("/dev/zero")


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
        own.write_bytes(b"other") if in_the_way == "other" else own.symlink_to(victim)
        obj = opened(addon, path)
        bpy.ops.wm.save_mainfile()
        assert bytes(obj.fragmotion.policy) == policy and "Rig" in addon.character.storing.troubles
        assert victim.read_bytes() == policy and own.read_bytes() == (b"other" if in_the_way == "other" else policy)


def test_pipes_that_are_chosen_are_refused(addon: ModuleType, obj: bpy.types.Object, tmp_path: Path) -> None:
    pipes = [tmp_path / name for name in ("x.policy", "x.csv", "x.bvh")]
    for pipe in pipes:
        os.mkfifo(pipe)
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


@pytest.mark.parametrize("listed", [0, 1, 5, 7])
def test_classes_that_are_not_the_policys_are_said(addon: ModuleType, obj: bpy.types.Object, listed: int) -> None:
    rows = obj.fragmotion.classes
    while len(rows) > listed:
        rows.remove(0)
    while len(rows) < listed:
        rows.add()
    inspector = bpy.context.window_manager.fragmotion.inspector
    for cached in (False, True):  # from the policy, and by what the file says of it
        if cached:
            character = addon.character.building.load_whole(obj)
            addon.character.building._cache[obj.fragmotion.digest, ()] = character
        with pytest.raises(addon.errors.UserError, match=f"lists {listed} classes, but its policy has 6: press Build"):
            addon.character.inspector.explain(obj, *addon.character.inspector.decision(obj, inspector, 0)[:2])
        with pytest.raises(RuntimeError, match="press Build again"):
            bpy.ops.fragmotion.bake(seconds=1)
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=6, seconds=5) == {"FINISHED"}
    assert addon.character.inspector.explain(obj, *addon.character.inspector.decision(obj, inspector, 0)[:2])


def test_a_policy_of_another_tree_of_the_armature_says_so(
    addon: ModuleType, obj: bpy.types.Object, tmp_path: Path
) -> None:
    path = str(tmp_path / "mine.policy")
    assert bpy.ops.fragmotion.save_policy(filepath=path) == {"FINISHED"}
    with making.editing(obj) as bones:
        bones["upper_arm.L"].parent = None
    with pytest.raises(RuntimeError, match=r"bone 'upper_arm.L' does not hang on 'root'.*several bones have no parent"):
        bpy.ops.fragmotion.load_policy(filepath=path)


@pytest.mark.parametrize(("field", "value"), [("start", (1e20, 0, 0)), ("shown_bones", -1)])
def test_an_impossible_recording_is_damaged_and_starts_no_drive(
    addon: ModuleType, obj: bpy.types.Object, field: str, value: Any
) -> None:
    recording = addon.recordings.recordings.add_recording(obj, np.tile((0, 1.2, 0, 0), (20, 1)))
    recording.shown = b"x"
    with suppress(ValueError):  # out of the property's bounds, which a file need not keep
        setattr(recording, field, value)
    with pytest.raises(addon.errors.UserError, match="is damaged"):
        addon.recordings.recordings.trace_of(recording) if field == "start" else addon.recordings.recordings.shown_of(
            recording
        )
    assert addon.drive.session.current is None


def test_bone_names_of_another_encoding_are_taken_for_latin_1(
    addon: ModuleType, obj: bpy.types.Object, tmp_path: Path
) -> None:
    take = making.write_bvh(tmp_path / "walk.bvh")
    take.write_bytes(take.read_bytes().replace(b"LeftFoot", b"Fu\xdf"))
    assert bpy.ops.fragmotion.import_mocap(directory=str(tmp_path)) == {"FINISHED"}
    assert "Fu\xdf" in bpy.context.object.data.bones
    bpy.context.view_layer.objects.active = obj
    before = making.contents()
    forged = tmp_path / "forged.policy"
    forged.write_bytes(with_checksum(bytes(obj.fragmotion.policy).replace(b"foot.L", b"fu\xdf  L")))
    refused(bpy.ops.fragmotion.load_policy, "fu\xdf", filepath=str(forged))
    assert making.contents() == before


def refused(operator: Callable[..., set[str]], message: str, **fields: Any) -> None:
    with pytest.raises(RuntimeError, match=message) as failure:
        operator("EXEC_DEFAULT", **fields)
    assert str(failure.value).count("Error") == 1 and "Traceback" not in str(failure.value)


def with_checksum(policy: bytes) -> bytes:
    """A policy file with its checksum (FNV-1a) put right."""
    value = 0xCBF29CE484222325
    for byte in policy[20:-8]:
        value = (value ^ byte) * 0x100000001B3 & 0xFFFFFFFFFFFFFFFF
    return policy[:-8] + struct.pack("<Q", value)


def shown(rows: np.ndarray) -> bytes:
    return zlib.compress(rows.astype("<f4").tobytes())


@pytest.mark.parametrize("column", [0, 1, 4, 7, 9])
@pytest.mark.parametrize("value", [np.nan, np.inf, -1.0, 1e30])
def test_a_recording_with_impossible_numbers_is_damaged_or_baked(
    addon: ModuleType, obj: bpy.types.Object, column: int, value: float
) -> None:
    recording = obj.fragmotion.takes[0]
    rows = np.frombuffer(zlib.decompress(recording.shown), "<f4").reshape(60, -1).copy()
    rows[-1, column] = value
    recording.shown = shown(rows)
    possible = np.isfinite(value) and column not in (0, 7)
    if possible:
        addon.recordings.recordings.shown_of(recording)
        return
    refused(bpy.ops.fragmotion.bake, "Recording 'Seen' is damaged: delete it", trace_source="RECORDING", recording=0)


def test_a_recording_without_rotations_or_rows_is_damaged(addon: ModuleType, obj: bpy.types.Object) -> None:
    recording = obj.fragmotion.takes[0]
    rows = np.frombuffer(zlib.decompress(recording.shown), "<f4").reshape(60, -1).copy()
    rows[3, 8:] = 0
    for data in (shown(rows), zlib.compress(b""), shown(np.zeros((1, 3)))):
        recording.shown = data
        refused(
            bpy.ops.fragmotion.bake, "Recording 'Seen' is damaged: delete it", trace_source="RECORDING", recording=0
        )
    recording.shown_bones = -2  # no columns at all
    refused(bpy.ops.fragmotion.bake, "Recording 'Seen' is damaged: delete it", trace_source="RECORDING", recording=0)
    recording.shown = b""
    for trace in (np.full((5, 4), np.nan), np.full((5, 4), 7.0), np.zeros((0, 4))):
        recording.controls = zlib.compress(trace.tobytes())
        refused(
            bpy.ops.fragmotion.bake, "Recording 'Seen' is damaged: delete it", trace_source="RECORDING", recording=0
        )


def test_a_recording_that_claims_more_poses_than_were_shown_takes_no_memory(
    addon: ModuleType, obj: bpy.types.Object
) -> None:
    recording = obj.fragmotion.takes[0]
    recording.shown = zlib.compress(bytes(1 << 27))
    tracemalloc.start()
    try:
        with pytest.raises(addon.errors.UserError, match="Recording 'Seen' is damaged: delete it"):
            addon.recordings.recordings.shown_of(recording)
        assert tracemalloc.get_traced_memory()[1] < 1 << 22
    finally:
        tracemalloc.stop()


@pytest.mark.parametrize("rate", ["fast", 0.0, -30, np.nan, np.inf, 1e300, [1, 2], b"\xff"])
def test_a_take_whose_rate_is_none_plays_at_the_scenes(addon: ModuleType, obj: bpy.types.Object, rate: Any) -> None:
    action = bpy.data.actions["take 0"]
    usual = addon.mocap.sampling.frame_times(
        bpy.context.scene, action, dict(enumerate(addon.compat.versions.all_curves(action)))
    )
    action["fragmotion_rate"] = action["fragmotion_scene_rate"] = rate
    spoilt = addon.mocap.sampling.frame_times(
        bpy.context.scene, action, dict(enumerate(addon.compat.versions.all_curves(action)))
    )
    assert spoilt[0] == usual[0]
    np.testing.assert_array_equal(spoilt[1], usual[1])


def test_a_key_in_the_far_future_is_said(addon: ModuleType, obj: bpy.types.Object) -> None:
    addon.compat.versions.all_curves(bpy.data.actions["take 0"])[0].keyframe_points.insert(1e8, 0.0)
    refused(bpy.ops.fragmotion.build, "'take 0' goes from frame 1 to 1e.08, more than 2,000,000 samples", classes=6)


@pytest.mark.parametrize("stored", [b"", b"short", bytes(412)])
def test_coverage_of_another_length_is_not_drawn(addon: ModuleType, stored: bytes) -> None:
    layout = bpy.types.UILayout
    assert addon.character.coverage_picture.draw_pictures(layout, stored, 300.0) is None


def stored(data: Any) -> Any:
    """The add-on's properties as the file holds them."""
    if bpy.app.version >= (5, 0, 0):
        return data.bl_system_properties_get(do_create=True)["fragmotion"]
    return data["fragmotion"]


def forged_value(prop: Any, high: bool) -> Any:
    """A value that the property cannot have: out of its bounds where it has some, else one that is no number."""
    if prop.type == "STRING":
        return b"\xff\x00?" if prop.subtype == "BYTE_STRING" else "x" * 100_000
    if prop.type == "ENUM":
        return 1_000_000 if high else -7
    if prop.type == "BOOLEAN":
        return high
    if prop.type == "INT":
        value = min(prop.hard_max + 1, 2**31 - 1) if high else max(prop.hard_min - 1, -(2**31))
    else:
        value = float("nan") if high else -3e38
    return [value] * prop.array_length if prop.is_array else value


def forge_group(kind: Any, high: bool) -> dict[str, Any]:
    """All of a property group, and of the groups in it, as no add-on would write it."""
    forged: dict[str, Any] = {}
    for prop in kind.bl_rna.properties[1:]:
        if prop.type == "POINTER":
            forged[prop.identifier] = forge_group(prop.fixed_type, high)
        elif prop.type == "COLLECTION":
            forged[prop.identifier] = [forge_group(prop.fixed_type, high) for _ in range(2)]
        elif not prop.is_readonly:
            forged[prop.identifier] = forged_value(prop, high)
    return forged


@pytest.mark.parametrize("high", [False, True])
@pytest.mark.parametrize("keeps_policy", [False, True])
def test_damaged_settings_are_mended_and_every_button_ends_in_a_sentence(
    addon: ModuleType, obj: bpy.types.Object, tmp_path: Path, high: bool, keeps_policy: bool
) -> None:
    policy = bytes(obj.fragmotion.policy)
    bpy.context.window_manager.fragmotion.active_class = 1
    for data in (obj, bpy.data.actions["take 0"], bpy.context.window_manager):
        group = stored(data)
        for key, value in forge_group(type(data.fragmotion), high).items():
            if key in group:
                del group[key]  # Blender gives a group no dict for another
            group[key] = value
    if keeps_policy:
        obj.fragmotion.policy = policy
    obj["fragmotion_put_aside"] = {"modes": {}, "pose": 3} if high else "nothing"
    path = tmp_path / "forged.blend"
    with forging(addon):
        bpy.ops.wm.save_as_mainfile(filepath=str(path))
    obj = opened(addon, path)
    assert "fragmotion_put_aside" not in obj
    assert addon.settings.mending.mend(obj.fragmotion) == 0
    assert 0 <= obj.fragmotion.build.seconds <= 3600 and obj.fragmotion.keep_policy in {"PACKED", "BESIDE"}
    assert obj.fragmotion.bake.target == "NEW" and len(obj.fragmotion.takes) == 2
    press_every_button(tmp_path)
    bpy.ops.wm.save_mainfile()
    assert files_in(tmp_path).keys() <= {"x.policy", "x.csv"}


def press_every_button(folder: Path) -> None:
    """Whatever each does, it says so in one sentence."""
    fields = {"save_policy": {"filepath": str(folder / "x")}, "export_recording": {"filepath": str(folder / "x")}}
    fields["build"] = fields["suggest_classes"] = {"seconds": 2.0}
    for name in (
        *(
            "suggest_classes",
            "bake",
            "populate",
            "duplicate_recording",
            "trim_recording",
            "export_recording",
            "delete_recording",
        ),
        *("save_policy", "force_class", "solo_class", "leave_out", "build", "bake"),
    ):
        operator = getattr(bpy.ops.fragmotion, name)
        try:
            if operator.poll():
                assert operator("EXEC_DEFAULT", **fields.get(name, {})) & {"FINISHED", "CANCELLED"}
        except RuntimeError as error:
            assert "Traceback" not in str(error) and str(error).count("Error") == 1, name
