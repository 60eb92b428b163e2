# SPDX-License-Identifier: MIT
"""Takes in files that Blender's importers read come in as any others, and nothing else of the files does."""

from __future__ import annotations

import re
import zipfile
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import making
import numpy as np
import pytest
from test_importing import import_folder

RATE = 30
FRAMES = 20
HAS_USD = bpy.app.version >= (4, 2, 0) and bpy.app.build_options.usd  # Debian's 4.3 is built without
ENDINGS = ["glb", "gltf", "vrm", "fbx", *(["usdc"] if HAS_USD else [])]
FBX = {
    "add_leaf_bones": False,
    "bake_anim_simplify_factor": 0,
    "bake_anim_use_all_actions": False,
    "bake_anim_use_nla_strips": False,
}
HAS_NEW_FBX = bpy.app.version >= (4, 5, 0)


def export(path: Path) -> Path:
    """Write the scene's armatures with what they play, or hold in the NLA."""
    kind, scene = path.suffix, bpy.context.scene
    scene.frame_start, scene.frame_end = 1, FRAMES
    if kind == ".fbx":
        bpy.ops.export_scene.fbx(filepath=str(path), **FBX)
    elif kind == ".usdc":
        bpy.ops.wm.usd_export(filepath=str(path), export_animation=True)
    else:
        written = path.with_suffix(".glb") if kind == ".vrm" else path
        form = "GLTF_SEPARATE" if kind == ".gltf" else "GLB"
        making.export_gltf(written, export_format=form)
        written.rename(path)
    return path


def add_tracks(obj: bpy.types.Object, names: Sequence[str], seed: int) -> None:
    """Actions as tracks of the NLA."""
    actions = [making.add_action(obj, FRAMES, seed + index, name) for index, name in enumerate(names)]
    obj.animation_data_clear()
    for action in actions:
        track = obj.animation_data_create().nla_tracks.new()
        track.name = action.name
        track.strips.new(action.name, 1, action)


@pytest.fixture
def dancer(addon: ModuleType) -> bpy.types.Object:
    """An armature that moves, turned and away from the origin, with bones whose names every format keeps."""
    bpy.context.scene.render.fps = RATE
    obj = making.add_armature([without_dots(bone) for bone in making.BODY], name="Dancer")
    obj.location, obj.rotation_euler.z = (1, 2, 0.1), 0.4
    making.add_action(obj, FRAMES, name="dance")
    return obj


def without_dots(bone: tuple[Any, ...]) -> tuple[Any, ...]:
    name, parent, *places = bone
    return (name.replace(".", "_"), parent.replace(".", "_"), *places)


def heads_of(obj: bpy.types.Object, names: Sequence[str], times: np.ndarray) -> np.ndarray:
    return making.blender_poses(obj, obj.animation_data.action, times, names)[..., :3, 3]


def import_new(path: Path, **options: Any) -> bpy.types.Object:
    """Import a file into an empty scene of another frame rate."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.context.scene.render.fps = 24
    return import_folder(path.parent, files=[{"name": path.name}], mend=False, onto="NEW", **options)


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_file_of_any_format_moves_an_armature_as_it_did(
    addon: ModuleType, dancer: bpy.types.Object, tmp_path: Path, ending: str
) -> None:
    body = [bone.name for bone in dancer.pose.bones if bone.name != "root"]
    heads = heads_of(dancer, body, np.arange(1, FRAMES + 1))
    obj = import_new(export(tmp_path / f"dance.{ending}"))
    assert [action.name for action in bpy.data.actions] == ["dance"]
    action = obj.animation_data.action
    rate = action[addon.mocap.actions.RATE]
    assert rate == pytest.approx(24 if ending == "usdc" and not has_usd() else RATE, rel=1e-4)
    times = 1 + np.arange(FRAMES) * 24 / rate
    np.testing.assert_allclose(heads_of(obj, body, times), heads, atol=1e-4)


def has_usd() -> bool:
    """Whether this Blender's Python can ask a USD file for its rate."""
    try:
        import pxr.Usd  # noqa: F401
    except ImportError:
        return False
    return True


@pytest.mark.skipif(not HAS_NEW_FBX, reason="this Blender has one importer of FBX")
@pytest.mark.parametrize("which", [0, 1])
def test_either_importer_of_fbx_reads(
    addon: ModuleType, dancer: bpy.types.Object, tmp_path: Path, which: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    body = [bone.name for bone in dancer.pose.bones if bone.name != "root"]
    heads = heads_of(dancer, body, np.arange(1, FRAMES + 1))
    path = export(tmp_path / "dance.fbx")
    importers = addon.mocap.by_blender._IMPORTERS
    monkeypatch.setitem(importers, ".fbx", importers[".fbx"][which : which + 1])
    obj = import_new(path)
    np.testing.assert_allclose(heads_of(obj, body, 1 + np.arange(FRAMES) * 24 / RATE), heads, atol=1e-4)


def test_what_the_context_gives_is_of_the_shown_scene(addon: ModuleType) -> None:
    """Else importers write into the scene that somebody last had a layer collection of, even where it is gone."""
    window, shown, other = making.window(), bpy.context.scene, bpy.data.scenes.new("Other")
    window.scene = other
    assert bpy.context.layer_collection is not None
    window.scene = shown
    with addon.mocap.scratch.scratch_scene(bpy.context):
        assert bpy.context.id_data in (None, shown)


@pytest.mark.parametrize("ending", ENDINGS)
def test_bones_end_where_their_children_begin(
    addon: ModuleType, dancer: bpy.types.Object, tmp_path: Path, ending: str
) -> None:
    """As the joints of a file say, wherever an importer ends the bones: a foot's end is where its toe begins."""
    path = export(tmp_path / f"dance.{ending}")
    with addon.mocap.scratch.scratch_scene(bpy.context):
        (take,) = addon.mocap.by_blender.read_takes(bpy.context, path, "")
    names = take.skeleton.names
    heads, tails = dict(zip(names, take.skeleton.rest_heads())), dict(zip(names, take.skeleton.rest_tails()))
    np.testing.assert_allclose(tails["thigh_L"], heads["shin_L"], atol=1e-5)
    np.testing.assert_allclose(tails["hips"], (heads["spine"] + heads["thigh_L"] + heads["thigh_R"]) / 3, atol=1e-5)


@pytest.fixture
def two(addon: ModuleType, tmp_path: Path) -> Path:
    """A GLB of two armatures with two takes each."""
    bpy.context.scene.render.fps = RATE
    for index, name in enumerate(("Ann", "Bob")):
        obj = making.add_armature(name=name)
        add_tracks(obj, [f"{name} walk", f"{name} sit"], 10 * index)
    return export(tmp_path / "two.glb")


def test_every_take_of_every_character_comes_by_name(two: Path) -> None:
    import_new(two)
    names = sorted(action.name for action in bpy.data.actions)
    assert names == ["two Ann Ann sit", "two Ann Ann walk", "two Bob Bob sit", "two Bob Bob walk"]


def test_one_character_can_be_chosen(addon: ModuleType, two: Path) -> None:
    import_new(two, character="Bob")
    assert sorted(action.name for action in bpy.data.actions) == ["two Bob Bob sit", "two Bob Bob walk"]
    assert addon.mocap.by_blender.seen == ["Ann", "Bob"]
    before = everything()
    with pytest.raises(RuntimeError, match=r"two\.glb' has no character 'Eve': there is Ann, Bob"):
        import_folder(two.parent, files=[{"name": two.name}], character="Eve")
    assert everything() == before


def test_names_that_the_file_has_already_do_not_change_the_takes(two: Path) -> None:
    for name in ("Ann", "Bob"):
        making.add_action(making.add_armature(name=name), name=f"{name} walk")
    import_folder(two.parent, files=[{"name": two.name}], mend=False, onto="NEW")
    assert {"two Ann Ann sit", "two Ann Ann walk"} <= {action.name for action in bpy.data.actions}


def everything() -> dict[str, Any]:
    """All data-blocks by name, what the scene is set to, and what the window shows."""
    blocks = {
        kind.identifier: sorted(block.name for block in getattr(bpy.data, kind.identifier))
        for kind in bpy.data.bl_rna.properties
        if kind.type == "COLLECTION" and kind.identifier != "all_ids"
    }
    scene = bpy.context.scene
    settings = {
        name: getattr(scene, name) for name in ("frame_start", "frame_end", "frame_preview_start", "use_preview_range")
    }
    return {
        **making.contents(),
        "blocks": blocks,
        "settings": settings,
        "rate": (scene.render.fps, scene.render.fps_base),
        "unit": (scene.unit_settings.system, scene.unit_settings.scale_length),
        "scene": scene.name,
        "view layer": bpy.context.view_layer.name,
        "modes": {o.name: o.mode for o in bpy.data.objects},
    }


@pytest.mark.parametrize("ending", ENDINGS)
@pytest.mark.parametrize("mode", ["OBJECT", "POSE"])
def test_nothing_but_the_actions_stays(dancer: bpy.types.Object, tmp_path: Path, ending: str, mode: str) -> None:
    path = export(tmp_path / f"dance.{ending}")
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    scene = bpy.context.scene
    scene.render.fps, scene.frame_start, scene.frame_end = 25, 7, 77
    scene.frame_set(9)
    scene.view_layers.new("Second")
    making.window().view_layer = scene.view_layers["Second"]
    making.add_mesh().select_set(True)
    obj = making.add_armature(name="Dancer")
    bpy.ops.object.mode_set(mode=mode)
    before = everything()
    import_folder(tmp_path, files=[{"name": path.name}], onto="ACTIVE", mend=False)
    after = everything()
    assert after["blocks"].pop("actions") == ["dance"] and not before["blocks"].pop("actions")
    assert obj.animation_data.action.name == "dance"
    changed = {"actions", "playing", "poses"}
    assert {key: after[key] for key in after.keys() - changed} == {key: before[key] for key in before.keys() - changed}


def test_importing_an_fbx_is_one_undo_step(dancer: bpy.types.Object, tmp_path: Path) -> None:
    path = export(tmp_path / "dance.fbx")
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.ed.undo_push(message="before")
    call = {"directory": str(tmp_path), "files": [{"name": path.name}]}
    assert bpy.ops.fragmotion.import_mocap("EXEC_DEFAULT", True, **call) == {"FINISHED"}
    assert len(bpy.data.objects) == 1 and "dance" in bpy.data.actions
    bpy.ops.ed.undo()
    assert len(bpy.data.objects) == 0 and "dance" not in bpy.data.actions


def half_of(path: Path, to: Path) -> None:
    to.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


def archive(_whole: Path, to: Path) -> None:
    with zipfile.ZipFile(to, "w") as file:
        file.writestr("dance.txt", "dance")


def empty(_whole: Path, to: Path) -> None:
    to.write_bytes(b"")


def noise(_whole: Path, to: Path) -> None:
    to.write_bytes(np.random.default_rng(1).bytes(5000))


@pytest.mark.parametrize("harm", [half_of, archive, empty, noise])
@pytest.mark.parametrize("ending", ENDINGS)
def test_a_broken_file_is_one_sentence_and_changes_nothing(
    dancer: bpy.types.Object, tmp_path: Path, ending: str, harm: Any
) -> None:
    folder = tmp_path / "broken"
    folder.mkdir()
    harm(export(tmp_path / f"dance.{ending}"), folder / f"broken.{ending}")
    making.activate(dancer)
    before = everything()
    said = "unpack it" if harm is archive else "Blender cannot import it"
    with pytest.raises(RuntimeError, match=re.escape(f"{folder / 'broken'}.{ending}'") + f".*{said}") as refusal:
        import_folder(folder)
    assert len(str(refusal.value).strip().splitlines()) == 1 and "Traceback" not in str(refusal.value)
    assert everything() == before


@pytest.mark.parametrize(("ending", "advice"), [("glb", "Preferences > Add-ons"), ("usdc", "built without USD")])
def test_where_blender_lacks_the_importer_it_is_said_what_to_do(
    addon: ModuleType, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, ending: str, advice: str
) -> None:
    by_blender = import_module(f"{addon.__name__}.mocap.by_blender")
    monkeypatch.setattr(by_blender, "_available", lambda path: iter(()))
    (tmp_path / f"dance.{ending}").write_bytes(b"dance")
    with pytest.raises(RuntimeError, match=advice):
        import_folder(tmp_path)


def test_an_importer_that_fails_itself_is_told_in_a_sentence(
    addon: ModuleType, dancer: bpy.types.Object, tmp_path: Path
) -> None:
    """As Blender tells of an exception in one of its operators."""
    cause = addon.mocap.by_blender._cause
    told = (
        "Error: Python: Traceback (most recent call last):\n  File x, line 1\nKeyError: 'skin'\n\nLocation: ops.py:1\n"
    )
    assert cause(RuntimeError(told)) == "KeyError: 'skin'"
    assert cause(RuntimeError("Error: Bad GLB\nError: more")) == "Bad GLB"
    path = tmp_path / "wrong.gltf"
    path.write_text('{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [7]}], "nodes": []}')
    with pytest.raises(RuntimeError, match=r"wrong\.gltf': Blender cannot import it \((Key|Index)Error") as refusal:
        import_folder(tmp_path)
    assert len(str(refusal.value).strip().splitlines()) == 1


def write_still(folder: Path, name: str) -> None:
    """A GLB of a thing that does not move."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.mesh.primitive_cube_add()
    making.export_gltf(folder / name)


def write_resting(folder: Path, name: str) -> None:
    """A GLB of a character without animation."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    making.add_armature(name="Idle")
    making.export_gltf(folder / name)


@pytest.mark.parametrize("write", [write_still, write_resting])
def test_a_file_in_which_nothing_moves_is_named(addon: ModuleType, tmp_path: Path, write: Any) -> None:
    write(tmp_path, "still.glb")
    before = everything()
    with pytest.raises(RuntimeError, match=r"still\.glb': no armature in it is animated"):
        import_folder(tmp_path, files=[{"name": "still.glb"}])
    assert everything() == before


def test_a_folder_of_mixed_formats_comes_in_at_any_depth(
    addon: ModuleType, dancer: bpy.types.Object, tmp_path: Path
) -> None:
    (tmp_path / "walks" / "old").mkdir(parents=True)
    (tmp_path / ".hidden").mkdir()
    export(tmp_path / "walks" / "dance.glb")
    export(tmp_path / "walks" / "old" / "step.fbx")
    write_own(addon, dancer, tmp_path / "walks" / "walk.bvh")
    making.write_bvh(tmp_path / ".hidden" / "not this.bvh")
    write_still(tmp_path, "chair.glb")
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    files = addon.mocap.take_files.find_takes(tmp_path)
    assert [f.path.name for f in files] == ["chair.glb", "dance.glb", "step.fbx", "walk.bvh"]
    job = addon.jobs.SteppedJob(
        "", "", addon.mocap.importing.import_takes(bpy.context, "mixed", files, None, mends=False)
    )
    job.run(lambda _: None)
    imported = job.result()
    assert [action.name for action in imported.actions] == ["dance", "step", "walk"]
    assert [path.name for path in imported.without] == ["chair.glb"]
    names = [bone.name for bone in imported.obj.pose.bones if bone.name != "root"]
    rates = [action[addon.mocap.actions.RATE] for action in imported.actions]
    assert rates == pytest.approx([RATE] * 3, rel=1e-4)
    times = 1 + np.arange(FRAMES) * 24 / RATE
    dance, step, walk = (making.blender_poses(imported.obj, a, times, names)[..., :3, 3] for a in imported.actions)
    np.testing.assert_allclose(step, dance, atol=1e-3)
    np.testing.assert_allclose(walk, dance, atol=1e-3)


def write_own(addon: ModuleType, obj: bpy.types.Object, path: Path) -> None:
    """Write what an armature plays as a BVH file."""
    core, rig = addon.compat.core.core, addon.rig.rigs.make_rig(obj)
    clip = addon.mocap.sampling.sample(bpy.context, obj, obj.animation_data.action, rig)
    core.write_bvh(core.Take.from_clip(clip, rig.skeleton), path)


def test_a_take_of_another_format_goes_onto_the_character_that_it_is_of(addon: ModuleType, tmp_path: Path) -> None:
    obj = making.open_sample()
    action = next(action for action in bpy.data.actions if "walk" in action.name)
    names = [bone.name for bone in obj.pose.bones if bone.name != "root"]
    obj.animation_data_clear()
    obj.animation_data_create()
    addon.compat.versions.assign(obj, action)
    bpy.context.scene.render.fps, bpy.context.scene.frame_start = RATE, 1
    last = int(action.frame_range[1])
    times = np.arange(1, last, 7)
    heads = making.blender_poses(obj, action, times, names)[..., :3, 3]
    bpy.context.scene.frame_end = last
    path = tmp_path / "again.fbx"
    bpy.ops.export_scene.fbx(filepath=str(path), object_types={"ARMATURE"}, **FBX)
    making.activate(obj)
    import_folder(tmp_path, onto="ACTIVE", mend=False)
    made = bpy.data.actions["again"]
    np.testing.assert_allclose(making.blender_poses(obj, made, times, names)[..., :3, 3], heads, atol=1e-4)
