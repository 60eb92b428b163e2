# SPDX-License-Identifier: MIT
"""What is damaged in a .blend from a stranger is said in a sentence."""

from __future__ import annotations

import struct
import time
import tracemalloc
import zlib
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import making
import numpy as np
import pytest
from forging import files_in, forging, opened, refused


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
            addon.character.inspector.explain(obj, addon.character.inspector.decision(obj, inspector, 0))
        with pytest.raises(RuntimeError, match="press Build again"):
            bpy.ops.fragmotion.bake(seconds=1)
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=6, seconds=5) == {"FINISHED"}
    assert addon.character.inspector.explain(obj, addon.character.inspector.decision(obj, inspector, 0))


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


def with_checksum(policy: bytes) -> bytes:
    """A policy file with its checksum put right."""
    value, payload = 0xCBF29CE484222325, policy[20:-8]
    for at in range(0, len(payload), 8):
        value = (value ^ int.from_bytes(payload[at : at + 8], "little")) * 0x100000001B3 & 0xFFFFFFFFFFFFFFFF
        value ^= value >> 32
    return policy[:-8] + struct.pack("<Q", value)


def shown(rows: np.ndarray) -> bytes:
    return zlib.compress(rows.astype("<f4").tobytes())


@pytest.mark.parametrize("column", [0, 1, 4, 7, 9])
@pytest.mark.parametrize("value", [np.nan, np.inf, -1.0, 1e30])
def test_a_recording_with_impossible_numbers_is_damaged_or_baked(
    addon: ModuleType, obj: bpy.types.Object, column: int, value: float
) -> None:
    recording = obj.fragmotion.recordings[0]
    rows = np.frombuffer(zlib.decompress(recording.shown), "<f4").reshape(60, -1).copy()
    rows[-1, column] = value
    recording.shown = shown(rows)
    possible = np.isfinite(value) and column not in (0, 7)
    if possible:
        addon.recordings.recordings.shown_of(recording)
        return
    refused(bpy.ops.fragmotion.bake, "Recording 'Seen' is damaged: delete it", trace_source="RECORDING", recording=0)


def test_a_recording_without_rotations_or_rows_is_damaged(addon: ModuleType, obj: bpy.types.Object) -> None:
    recording = obj.fragmotion.recordings[0]
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
    recording = obj.fragmotion.recordings[0]
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
    layout, paper = bpy.types.UILayout, addon.character.control_layout.ControlLayout()
    assert addon.character.coverage_picture.draw_pictures(layout, stored, paper, 300.0) is None
    assert addon.character.coverage_picture.draw_pictures(layout, bytes(408), None, 300.0) is None


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
        if prop.type == "POINTER" and issubclass(getattr(bpy.types, prop.fixed_type.identifier, object), bpy.types.ID):
            continue  # Blender itself reads pointers to data-blocks
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
    assert obj.fragmotion.bake.target == "NEW" and len(obj.fragmotion.recordings) == 2
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


def test_only_the_damaged_one_of_many_entries_is_mended(addon: ModuleType, obj: bpy.types.Object) -> None:
    moves = obj.fragmotion.moves
    for index in range(5):
        move = moves.add()
        move.name, move.wait, move.key, move.first = f"move {index}", 1.5, "F", -7
    forged = stored(obj)["moves"][3]
    forged["wait"], forged["key"] = float("nan"), 1_000_000
    assert addon.settings.mending.mend(obj.fragmotion) == 2
    told = [(move.name, move.wait, move.key, move.first) for move in moves]
    assert told.pop(3) == ("move 3", 0.5, "NONE", -7)
    assert told == [(f"move {index}", 1.5, "F", -7) for index in (0, 1, 2, 4)]


@pytest.mark.parametrize("listed", ["moves", "recordings", "classes"])
def test_many_entries_are_mended_in_the_time_of_a_look(addon: ModuleType, obj: bpy.types.Object, listed: str) -> None:
    entries = getattr(obj.fragmotion, listed)
    for _ in range(10_000):
        entries.add()
    names = [prop.identifier for prop in entries[0].bl_rna.properties[1:]]

    def look() -> None:
        for entry in entries:
            for name in names:
                getattr(entry, name)

    def seconds(what: Callable[[], object]) -> float:
        begin = time.process_time()
        what()
        return time.process_time() - begin

    mending = min(seconds(lambda: addon.settings.mending.mend(obj.fragmotion)) for _ in range(3))
    assert mending < 5 * min(seconds(look) for _ in range(3))
