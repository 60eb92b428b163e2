# SPDX-License-Identifier: MIT
"""A folder of takes becomes one armature and an Action for each take; a bad file changes nothing."""

from __future__ import annotations

import re
import threading
from collections.abc import Generator
from pathlib import Path
from types import ModuleType

import bpy
import making
import numpy as np
import pytest


def import_folder(folder: Path, **options: object) -> bpy.types.Object:
    """Import as a script does, and return the armature."""
    assert bpy.ops.fragmotion.import_mocap("EXEC_DEFAULT", directory=str(folder), **options) == {"FINISHED"}
    return bpy.context.view_layer.objects.active


def check_take(addon: ModuleType, obj: bpy.types.Object, take: object, times: np.ndarray, rows: np.ndarray) -> None:
    """Blender's pose bones stand where the take's bones do."""
    names = take.skeleton.names
    heads, rotations = take.world_transforms()
    matrices = making.blender_poses(obj, bpy.data.actions[take.name], times, names)
    making.assert_same_poses(matrices, heads[rows], None, 1e-4)
    rests = np.array([np.array(obj.data.bones[name].matrix_local)[:3, :3] for name in names])
    turned = making.to_matrices(rotations[rows]) @ rests  # a BVH joint's frame at rest is the world's
    np.testing.assert_allclose(matrices[..., :3, :3], turned, atol=1e-4)


def test_takes_move_the_armature_as_their_files_say(addon: ModuleType, tmp_path: Path) -> None:
    bpy.context.scene.render.fps = 30
    files = [making.write_bvh(tmp_path / f"take {seed}.bvh", seed=seed) for seed in (1, 2)]
    obj = import_folder(tmp_path)
    assert obj.type == "ARMATURE" and obj.name == tmp_path.name
    assert bpy.context.selected_objects == [obj]
    assert obj.animation_data.action == bpy.data.actions["take 1"]
    for path in files:
        action = bpy.data.actions[path.stem]
        assert action.use_fake_user and action.fragmotion.use and action[addon.mocap.actions.RATE] == 30
        assert tuple(action.frame_range) == (1, 40)
        take = addon.compat.core.core.read_bvh(path)
        check_take(addon, obj, take, np.arange(1, 41), np.arange(40))


def export_walk(path: Path, scale: float) -> None:
    """The sample's walk as a BVH file of so many units a metre."""
    obj = making.open_sample()
    obj.animation_data.action = bpy.data.actions["walk forward"]
    bpy.ops.export_anim.bvh(
        filepath=str(path), global_scale=scale, frame_start=1, frame_end=90, root_transform_only=True
    )


def lowest_foot(obj: bpy.types.Object, name: str) -> float:
    """How low a foot gets in an Action, m."""
    poses = making.blender_poses(obj, bpy.data.actions[name], np.arange(1, 91), ["foot.L", "foot.R"])
    return float(poses[..., 2, 3].min())


def test_takes_of_other_proportions_stand_on_the_first_ones_floor(
    addon: ModuleType, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for name, scale in (("a walk", 100), ("a taller one's", 115)):
        export_walk(tmp_path / f"{name}.bvh", scale)
    obj = import_folder(tmp_path, unit="CENTIMETRES")
    assert "1 take of other proportions brought onto its body" in capsys.readouterr().out
    assert lowest_foot(obj, "a taller one's") == pytest.approx(lowest_foot(obj, "a walk"), abs=0.01)


def test_the_sampled_take_is_the_take(addon: ModuleType, tmp_path: Path) -> None:
    path = making.write_bvh(tmp_path / "walk.bvh", frame_time=0.008333)
    obj = import_folder(tmp_path, mend=False)
    rig = addon.rig.rigs.make_rig(obj)
    clip = addon.mocap.sampling.sample(bpy.context, obj, bpy.data.actions["walk"], rig)
    heads, _ = addon.compat.core.core.read_bvh(path).world_transforms()
    assert clip.rate == 120 and len(clip.root_positions) == 40
    body = making.body_bones(rig.skeleton)
    np.testing.assert_allclose(clip.world_transforms(rig.skeleton)[0][:, body], heads[:, body], atol=1e-4)


def test_a_take_plays_in_its_own_time_whatever_the_scenes_rate(addon: ModuleType, tmp_path: Path) -> None:
    scene = bpy.context.scene
    scene.render.fps, scene.render.fps_base = 24, 1.001
    path = making.write_bvh(tmp_path / "walk.bvh", frames=61, frame_time=1 / 60)
    obj = import_folder(tmp_path)
    start, end = bpy.data.actions["walk"].frame_range
    assert start == 1 and end == pytest.approx(1 + 24 / 1.001, abs=1e-4)
    rows = np.array([0, 1, 7, 33, 60])
    check_take(addon, obj, addon.compat.core.core.read_bvh(path), 1 + rows * 24 / 1.001 / 60, rows)


def test_a_take_is_learned_in_its_own_time_whatever_the_scenes_rate_becomes(addon: ModuleType, tmp_path: Path) -> None:
    scene = bpy.context.scene
    scene.render.fps = 24
    making.write_bvh(tmp_path / "walk.bvh", frames=61, frame_time=1 / 60)
    obj = import_folder(tmp_path)
    rig = addon.rig.rigs.make_rig(obj)
    before = addon.mocap.sampling.sample(bpy.context, obj, bpy.data.actions["walk"], rig)
    scene.render.fps, scene.render.fps_base = 60, 1.001
    after = addon.mocap.sampling.sample(bpy.context, obj, bpy.data.actions["walk"], rig)
    assert before.rate == after.rate == 60 and len(after.root_positions) == 61
    np.testing.assert_array_equal(after.root_positions, before.root_positions)
    np.testing.assert_array_equal(after.rotations, before.rotations)


def test_still_locations_get_no_keys(addon: ModuleType, tmp_path: Path) -> None:
    making.write_bvh(tmp_path / "walk.bvh")
    obj = import_folder(tmp_path)
    paths = {curve.data_path for curve in addon.compat.versions.curves_of(bpy.data.actions["walk"], obj)}
    assert {p for p in paths if "location" in p} == {'pose.bones["Root"].location', 'pose.bones["Hips"].location'}


def test_takes_key_the_same_channels_so_that_none_marks_the_next(addon: ModuleType, tmp_path: Path) -> None:
    bpy.context.scene.render.fps = 30
    making.write_bvh(tmp_path / "a.bvh", seed=1)
    other = making.write_bvh(tmp_path / "b.bvh", seed=2)
    other.write_text(other.read_text().replace("OFFSET 10 0 0", "OFFSET 12 0 0"))  # a wider left hip
    obj = import_folder(tmp_path)
    for name in ("a", "b", "a"):
        take = addon.compat.core.core.read_bvh(tmp_path / f"{name}.bvh")
        check_take(addon, obj, take, np.array([1, 9]), np.array([0, 8]))
    paths = [{c.data_path for c in addon.compat.versions.curves_of(bpy.data.actions[name], obj)} for name in "ab"]
    assert paths[0] == paths[1] and 'pose.bones["LeftUpLeg"].location' in paths[0]


def test_a_new_armature_is_seen_through_what_it_stands_in(tmp_path: Path) -> None:
    making.write_bvh(tmp_path / "a.bvh")
    import_folder(tmp_path)
    assert bpy.context.object.show_in_front


def test_only_the_selected_files_are_imported(tmp_path: Path) -> None:
    for name in ("a", "b", "c"):
        making.write_bvh(tmp_path / f"{name}.bvh")
    import_folder(tmp_path, files=[{"name": "a.bvh"}, {"name": "c.bvh"}])
    assert [action.name for action in bpy.data.actions] == ["a", "c"]


@pytest.mark.parametrize(("unit", "metres"), [("METRES", 1), ("CENTIMETRES", 0.01), ("INCHES", 0.0254)])
def test_the_unit_scales_the_armature(tmp_path: Path, unit: str, metres: float) -> None:
    making.write_bvh(tmp_path / "walk.bvh")
    obj = import_folder(tmp_path, unit=unit)
    assert obj.data.bones["Hips"].head_local.z == pytest.approx(95 * metres, rel=1e-5)


def test_short_bones_survive(tmp_path: Path) -> None:
    making.write_bvh(tmp_path / "walk.bvh")
    obj = import_folder(tmp_path)  # the left foot is 0.1 mm long
    assert obj.data.bones["LeftFoot"].length == pytest.approx(0.01, rel=1e-4)


def test_an_amc_belongs_to_the_asf_of_its_subject(addon: ModuleType, tmp_path: Path) -> None:
    for name in ("01.asf", "02.asf", "01_03.amc", "02_01.AMC"):
        (tmp_path / name).write_text("")
    found = [take.path for take in addon.mocap.take_files.find_takes(tmp_path)]
    find = addon.compat.core.core.find_asf
    assert [(path.name, find(path).name) for path in found] == [("01_03.amc", "01.asf"), ("02_01.AMC", "02.asf")]
    (tmp_path / "03_01.amc").write_text("")
    with pytest.raises(ValueError, match=r"03_01\.amc.*03\.asf"):
        find(tmp_path / "03_01.amc")
    (tmp_path / "01.asf").unlink()
    assert find(tmp_path / "03_01.amc").name == "02.asf"


def test_hidden_files_are_no_takes(addon: ModuleType, tmp_path: Path) -> None:
    for name in ("02.asf", "02_01.amc", "walk.bvh", "._walk.bvh", "._02.asf", "._02_01.amc", ".old.bvh"):
        (tmp_path / name).write_text("")
    (tmp_path / "folder.bvh").mkdir()
    takes = addon.mocap.take_files.find_takes(tmp_path)
    assert [take.path.name for take in takes] == ["02_01.amc", "walk.bvh"]
    (tmp_path / "03_01.amc").write_text("")
    assert addon.compat.core.core.find_asf(tmp_path / "03_01.amc").name == "02.asf", "the folder's only skeleton"


def test_importing_is_one_undo_step(tmp_path: Path) -> None:
    making.write_bvh(tmp_path / "walk.bvh")
    bpy.ops.ed.undo_push(message="before")
    assert bpy.ops.fragmotion.import_mocap("EXEC_DEFAULT", True, directory=str(tmp_path)) == {"FINISHED"}
    assert len(bpy.data.objects) == 1 and "walk" in bpy.data.actions
    bpy.ops.ed.undo()
    assert len(bpy.data.objects) == 0 and "walk" not in bpy.data.actions


def _broken(text: str, name: str) -> str:
    return {
        "truncated": "\n".join(text.splitlines()[:-5]),
        "cut in a row": text[: len(text) - 60],
        "not a number": text.replace("MOTION", "MOTION", 1)[:-30] + "nan" + text[-27:],
        "channel count": text.replace("CHANNELS 3 Yrotation Xrotation Zrotation", "CHANNELS 2 Yrotation Xrotation", 1),
        "empty": "",
    }[name]


@pytest.mark.parametrize("name", ["truncated", "cut in a row", "not a number", "channel count", "empty"])
def test_a_broken_bvh_is_named_by_line_and_changes_nothing(tmp_path: Path, name: str) -> None:
    making.add_action(making.add_armature())
    path = making.write_bvh(tmp_path / "b broken.bvh")
    path.write_text(_broken(path.read_text(), name))
    before = making.contents()
    with pytest.raises(RuntimeError, match=rf"{path.name}:\d+: "):
        import_folder(tmp_path)
    assert making.contents() == before


def test_broken_files_of_a_folder_are_named_and_the_rest_comes_in(addon: ModuleType, tmp_path: Path) -> None:
    for name in ("a", "c"):
        making.write_bvh(tmp_path / f"{name}.bvh")
    (tmp_path / "b.bvh").write_text("HIERARCHY\nROOT\n")
    (tmp_path / "d.amc").write_text("")
    (tmp_path / "e.glb").write_bytes(b"no glTF")
    files = addon.mocap.take_files.find_takes(tmp_path)
    steps, broken = addon.mocap.importing.import_takes(bpy.context, "Mocap", files, None), []

    def import_all() -> Generator[float, None, None]:
        broken.extend((yield from steps).broken)

    list(import_all())
    assert [action.name for action in bpy.data.actions] == ["a", "c"]
    assert len(broken) == 3
    for name, cause in zip(("b.bvh:", "d.amc", "e.glb"), broken):
        assert name in cause
    assert import_folder(tmp_path) and len(bpy.data.actions) == 4


@pytest.mark.parametrize("mode", ["POSE", "EDIT"])
def test_a_refused_import_gives_back_mode_and_selection(tmp_path: Path, mode: str) -> None:
    idle, third = making.add_armature(name="Idle"), making.add_armature(name="Third")
    obj = making.add_armature(name="Active")
    third.select_set(True)
    bpy.ops.object.mode_set(mode=mode)
    idle.select_set(True)
    path = making.write_bvh(tmp_path / "single.bvh")
    head, tail = path.read_text().split("  JOINT", 1)[0], path.read_text().partition("MOTION")[2]
    rows = [" ".join(row.split()[:6]) for row in tail.splitlines()[3:]]
    end = "  End Site\n  {\n    OFFSET 0 10 0\n  }\n}\nMOTION\nFrames: 40\nFrame Time: 0.0333333\n"
    path.write_text(head + end + "\n".join(rows) + "\n")
    before = making.contents()
    modes = {o.name: o.mode for o in bpy.data.objects}
    assert modes == {"Active": mode, "Third": mode, "Idle": "OBJECT"}
    with pytest.raises(RuntimeError, match="only one bone, 'Root'"):
        import_folder(tmp_path)
    assert making.contents() == before
    assert {o.name: o.mode for o in bpy.data.objects} == modes and bpy.context.object == obj


def test_a_take_that_is_of_no_body_cannot_go_onto_another_skeleton(tmp_path: Path) -> None:
    making.write_bvh(tmp_path / "a.bvh")
    other = making.write_bvh(tmp_path / "b.bvh")
    other.write_text(other.read_text().replace("RightUpLeg", "Tail"))
    import_folder(tmp_path)
    assert [action.name for action in bpy.data.actions] == ["a"], "the rest comes in"
    before = making.contents()
    with pytest.raises(RuntimeError, match=r"Take 'b'.*"):
        import_folder(tmp_path, files=[{"name": "b.bvh"}], onto="ACTIVE")
    assert making.contents() == before


@pytest.mark.parametrize("files", [(), ("notes.txt",), ("01.asf",)])
def test_a_folder_without_takes_is_named(tmp_path: Path, files: tuple[str, ...]) -> None:
    for name in files:
        (tmp_path / name).write_text("")
    with pytest.raises(RuntimeError, match=f"{re.escape(str(tmp_path))}.*no takes"):
        import_folder(tmp_path)
    with pytest.raises(RuntimeError, match="is not a folder"):
        import_folder(tmp_path / "missing")


def test_an_import_is_stopped_while_its_takes_are_examined(addon: ModuleType, tmp_path: Path) -> None:
    core, (file,) = (
        addon.compat.core.core,
        addon.mocap.take_files.find_takes(making.write_bvh(tmp_path / "a.bvh").parent),
    )
    short = core.read_bvh(file.path)
    values = (np.tile(each, (4000, 1, 1)) for each in (short.translations, short.rotations))
    take = core.Take(short.skeleton, "long", short.rate, *values, short.unit)
    steps = addon.mocap.doctor.examine([take], True, [True], 0.25, 0.75)
    assert 0.25 <= next(steps) < 0.75
    steps.close()
    assert not any(thread.name == "Fragmotion" for thread in threading.enumerate())


def test_an_import_that_stops_in_the_middle_removes_what_it_made(addon: ModuleType, tmp_path: Path) -> None:
    making.add_action(making.add_armature())
    for seed in (1, 2, 3):
        making.write_bvh(tmp_path / f"{seed}.bvh", seed=seed)
    files = addon.mocap.take_files.find_takes(tmp_path)
    before = making.contents()
    steps = addon.mocap.importing.import_takes(bpy.context, "stopped", files, 0.01)
    assert next(done for done in steps if done > 0.7) < 1
    assert len(bpy.data.objects) == 2, "nothing had been made, so nothing had to be removed"
    steps.close()
    assert making.contents() == before


def test_blender_goes_on_while_one_long_file_is_read(
    addon: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path, importing = making.write_bvh(tmp_path / "long.bvh"), addon.mocap.importing
    read, go_on = importing.core.read_bvh, threading.Event()
    monkeypatch.setattr(importing.core, "read_bvh", lambda *told: go_on.wait(60) and read(*told))
    files = addon.mocap.take_files.find_takes(tmp_path, [path.name])
    steps = importing.import_takes(bpy.context, "long", files, 0.01)
    assert [next(steps) for _ in range(3)] == [0, 0, 0]
    go_on.set()
    *_, last = steps
    assert last < 1 and "long" in bpy.data.actions
