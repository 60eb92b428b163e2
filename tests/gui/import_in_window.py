# SPDX-License-Identifier: MIT
"""Run in a Blender with a window by test_windows.py: have a broken FBX refused, stop an import of many files, import a
whole one, mend its take by the panel's button, and undo both.

Arguments after `--`: the add-on's zip, and the folder for the pictures.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "blender"))

import making
import window
from window import FOLDER, click_button, open_tab, picture, press, send

FILES = Path(FOLDER) / "files"
FRAMES = 40
MANY = 1500


def write_files() -> None:
    """Motion in which a bone is torn aside for a frame as FBX, and half of the file."""
    FILES.mkdir()
    bpy.context.scene.frame_end = FRAMES
    actor = making.add_armature(name="Actor")
    making.add_action(actor, FRAMES)
    torn = actor.pose.bones["shin.L"]
    torn.rotation_quaternion = (0, 0, 0, 1)
    torn.keyframe_insert("rotation_quaternion", frame=FRAMES // 2)
    with bpy.context.temp_override(**window.view()):
        bpy.ops.export_scene.fbx(
            filepath=str(FILES / "walk.fbx"),
            object_types={"ARMATURE"},
            add_leaf_bones=False,
            bake_anim_use_nla_strips=False,
            bake_anim_use_all_actions=False,
        )
    whole = (FILES / "walk.fbx").read_bytes()
    (FILES / "half.fbx").write_bytes(whole[: len(whole) // 2])


def seen() -> dict[str, Any]:
    """What the window shows."""
    shown, space = bpy.context.window_manager.windows[0], window.view()["area"].spaces[0]
    hero = bpy.data.objects["Hero"]
    return {
        "scene": shown.scene.name,
        "scenes": len(bpy.data.scenes),
        "workspace": shown.workspace.name,
        "view layer": shown.view_layer.name,
        "active": shown.view_layer.objects.active.name,
        "mode": hero.mode,
        "view": [list(row) for row in space.region_3d.view_matrix],
        "frames": (shown.scene.frame_current, shown.scene.frame_end, shown.scene.render.fps),
        "pose": [[list(row) for row in bone.matrix_basis] for bone in hero.pose.bones],
        "objects": sorted(bpy.data.objects.keys()),
    }


def import_file(name: str, **fields: Any) -> None:
    """As a file that is dropped into the view."""
    press(bpy.ops.fragmotion.import_mocap, directory=str(FILES), files=[{"name": name}], **fields)


def browse(folder: Path) -> Iterator[None]:
    """Choose a folder in Blender's file browser, and press Import Mocap in it."""
    bpy.context.preferences.view.filebrowser_display_type = "SCREEN"
    press(bpy.ops.fragmotion.import_mocap)
    yield from window.seconds(0.5)
    shown = bpy.context.window_manager.windows[0]
    area = next(area for area in shown.screen.areas if area.type == "FILE_BROWSER")
    area.spaces.active.params.directory = str(folder).encode()
    yield from window.seconds(0.5)
    region = next(region for region in area.regions if region.type == "WINDOW")
    with bpy.context.temp_override(window=shown, area=area, region=region):
        bpy.ops.file.execute()
    yield


def stopped_import(before: dict[str, Any]) -> Iterator[None]:
    """Begin to import more files than are read in a moment, and stop it by Esc."""
    background = window.module("operators.base.background")
    background._SLICE = 0.02  # s: it takes longer than a picture on any machine
    many = FILES / "many"
    many.mkdir()
    for seed in range(MANY):
        making.write_bvh(many / f"{seed}.bvh", seed=seed)
    window.show_only("Build")
    bpy.context.view_layer.objects.active = None  # onto a new armature
    yield from browse(many)
    yield from window.until(lambda: background.current.fraction > 0.5, "Actions are made")
    yield from picture("1 importing")
    assert len(bpy.data.actions) > 3
    yield from send("ESC", "PRESS", 300, 300)
    yield from window.until(lambda: background.current is None, "the import's end")
    yield from window.drawn()
    bpy.context.view_layer.objects.active = bpy.data.objects["Hero"]
    assert seen() == before and len(bpy.data.actions) < 3, "an import that was stopped has changed something"


def new_in_sight() -> Iterator[None]:
    """What comes in on a new armature is in sight."""
    shown = window.view()["area"].spaces[0].region_3d
    shown.view_location = (50, 50, 0)
    import_file("walk.fbx", onto="NEW")
    yield from window.until(lambda: window.module("operators.base.background").current is None, "the import's end")
    yield from window.seconds(0.5)  # in which the view moves there
    assert shown.view_location.length < 3, tuple(shown.view_location)


def steps() -> Iterator[None]:
    """The whole session."""
    bpy.data.objects.remove(bpy.data.objects["Cube"])
    yield from window.drawn()
    write_files()
    bpy.data.objects.remove(bpy.data.objects["Actor"])
    yield from window.drawn()
    hero = making.add_armature(name="Hero")
    making.add_action(hero, FRAMES, seed=5, name="own")
    yield from open_tab()
    with bpy.context.temp_override(**window.view()):
        bpy.ops.object.mode_set(mode="POSE")
    hero.pose.bones["hand.L"].rotation_quaternion = (0.6, 0.8, 0, 0)  # without a key
    bpy.ops.ed.undo_push(message="posed")
    yield from window.drawn()
    before = seen()
    try:
        import_file("half.fbx")
    except RuntimeError as error:
        assert "half.fbx" in str(error)
    else:
        raise AssertionError("half a file was read")
    yield from window.drawn()
    assert seen() == before, "a refused file has changed something"

    yield from stopped_import(before)
    import_file("walk.fbx", mend=False)
    yield from window.until(lambda: window.module("operators.base.background").current is None, "the import's end")
    yield from window.drawn()
    after = seen()
    assert "walk" in bpy.data.actions and after.pop("pose") != before.pop("pose")
    assert after == before, "an import has changed the scene"
    window.show_only("Mocap", "Doctor")
    bpy.context.window_manager.fragmotion.active_action = bpy.data.actions.find("walk")
    yield from picture("2 imported")
    findings = [row.code for row in bpy.data.actions["walk"].fragmotion.findings if row.mendable]
    assert findings, "the doctor finds nothing to mend in what is torn"
    yield from click_button("fragmotion.mend_finding")
    yield from window.drawn()
    assert next(row.mended for row in bpy.data.actions["walk"].fragmotion.findings if row.mendable)
    yield from picture("3 mended")
    for _ in range(2):
        yield from send("Z", "PRESS", 300, 300, ctrl=True)
        yield from send("Z", "RELEASE", 300, 300)
    yield from window.drawn()
    assert "walk" not in bpy.data.actions, "an import is more than one step"
    assert bpy.data.objects["Hero"].mode == "POSE"
    yield from new_in_sight()
    window.show_all()  # all that the add-on has registered


window.run(steps())
