# SPDX-License-Identifier: MIT
"""The pictures of docs/guide.md. `dev.py docs guide` runs this in a Blender with a window; arguments after `--`: the
add-on's zip and the pictures' folder."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from mathutils import Euler

TESTS = Path(__file__).resolve().parents[3] / "tests"
sys.path[:0] = [str(TESTS / "gui"), str(TESTS / "blender")]

making: Any = import_module("making")
window: Any = import_module("window")

FORWARD, TO_THE_RIGHT = "W", "D"
MIDDLE = (600, 450)  # of the viewport
VIEW = Euler((math.radians(70), 0, math.radians(35)))


def crop(name: str, region: Any, fit: bool = False) -> Iterator[None]:
    """A picture of a region of the window; with `fit`, without the plain ground at its lower end."""
    yield from window.picture(name)
    path = f"{window.FOLDER}/{name}.png"
    image = bpy.data.images.load(path)
    width, height = image.size
    pixels = np.empty(width * height * 4, np.float32)
    image.pixels.foreach_get(pixels)
    part = pixels.reshape(height, width, 4)[region.y : region.y + region.height, region.x : region.x + region.width]
    if fit:
        drawn = np.flatnonzero(np.ptp(part[:, : part.shape[1] - 40, :3], axis=1).max(axis=1) > 0.02)
        part = part[max(drawn[0] - 6, 0) :]
    bpy.data.images.remove(image)
    save(part, Path(path))


def save(pixels: Any, path: Path) -> None:
    """Write pixels [H,W,4] as a PNG."""
    image = bpy.data.images.new("part", pixels.shape[1], pixels.shape[0])
    image.pixels.foreach_set(np.ascontiguousarray(pixels).ravel())
    image.filepath_raw, image.file_format = str(path), "PNG"
    image.save()
    bpy.data.images.remove(image)
    print(f"{path}: {path.stat().st_size / 1000:.0f} kB")


def panels(name: str, *labels: str) -> Iterator[None]:
    """A picture of these panels."""
    window.show_only(*labels)
    yield from crop(name, window.sidebar()["region"], fit=True)


def imported(folder: Path) -> Iterator[None]:
    """The sample's takes, as a user imports them."""
    import_module("sample_takes").export_takes(folder)
    bpy.ops.wm.read_homefile(use_factory_startup=True, load_ui=False)
    yield from window.open_tab()
    window.press(bpy.ops.fragmotion.import_mocap, "EXEC_DEFAULT", True, directory=str(folder))
    yield from panels("mocap", "Mocap")


def brought_over(folder: Path) -> Iterator[None]:
    """The same takes on a character with other bones: the rig that Rigify starts from."""
    bpy.ops.preferences.addon_enable(module="rigify")
    bpy.ops.wm.read_homefile(use_factory_startup=True, load_ui=False)
    yield from window.open_tab()
    window.press(bpy.ops.object.armature_human_metarig_add)
    window.press(bpy.ops.fragmotion.import_mocap, "EXEC_DEFAULT", True, directory=str(folder), onto="ACTIVE")
    window.press(bpy.ops.fragmotion.find_bones)
    yield from panels("bones", "Mocap", "Bones")
    yield from bound(folder)
    bpy.ops.preferences.addon_disable(module="rigify")


def bound(folder: Path) -> Iterator[None]:
    """The control rig that Rigify generates, while it follows a motion skeleton."""
    bpy.data.objects.remove(bpy.context.view_layer.objects.active)  # Rigify heeds how a meta-rig is posed
    window.press(bpy.ops.object.armature_human_metarig_add)
    metarig = bpy.context.view_layer.objects.active
    window.press(bpy.ops.pose.rigify_generate, "EXEC_DEFAULT", True)
    making.activate(next(obj for obj in bpy.data.objects if obj.type == "ARMATURE" and obj != metarig))
    bpy.data.objects.remove(metarig)
    window.press(bpy.ops.fragmotion.bind_rig, "EXEC_DEFAULT", True)
    window.press(bpy.ops.fragmotion.import_mocap, "EXEC_DEFAULT", True, directory=str(folder), onto="ACTIVE")
    yield from panels("control-rig", "Control Rig", "Mocap")


def open_character() -> Iterator[None]:
    """The sample character, built, in a view that shows it."""
    bpy.ops.wm.open_mainfile(filepath=str(making.SAMPLE), load_ui=False)
    yield
    making.activate(bpy.data.objects[making.ARMATURE])
    space = window.view()["area"].spaces[0]
    space.shading.type, space.overlay.show_extras, space.overlay.show_cursor = "SOLID", False, False
    space.region_3d.view_perspective, space.region_3d.view_rotation = "PERSP", VIEW.to_quaternion()
    space.region_3d.view_location, space.region_3d.view_distance = (0, 0, 0.7), 7.5


def character() -> bpy.types.Object:
    """The sample character."""
    return bpy.data.objects[making.ARMATURE]


def pictures_of_building() -> Iterator[None]:
    """Build and what it found."""
    window.press(bpy.ops.fragmotion.build, "EXEC_DEFAULT", True, synthesize=False)
    yield from panels("coverage", "Coverage")
    window.press(bpy.ops.fragmotion.build, "EXEC_DEFAULT", True, synthesize=True)
    yield from panels("build", "Build", "Build Options", "Figures")
    manager, rows = bpy.context.window_manager.fragmotion, character().fragmotion.classes
    manager.active_class = next(number for number, row in enumerate(rows) if row.suggested.startswith("run"))
    yield from panels("classes", "Classes")
    yield from panels("inspector", "Inspector")
    window.show_only("Mocap", "Build", "Drive", "Recordings", "Bake")
    manager.show_mocap = manager.show_build = False
    yield from crop("panel", window.sidebar()["area"])


def hold(key: str, seconds: float, **modifiers: bool) -> Iterator[None]:
    """Hold a key while the drive goes on for so long, of its own time."""
    driven = window.module("drive.session").current
    end = driven._elapsed + seconds
    yield from window.send(key, "PRESS", *MIDDLE, **modifiers)
    yield from window.until(lambda: driven._elapsed >= end, "the drive to go on")
    yield from window.send(key, "RELEASE", *MIDDLE)


def pictures_of_driving() -> Iterator[None]:
    """A drive with a recording, and the recording that it leaves."""
    window.show_only("Drive", "Drive Options", "Gamepads", "Overlays")
    window.module("drive.hud.figures").LONGEST_UPDATE = math.inf  # nobody minds how slow this drawing by software is
    window.press(bpy.ops.fragmotion.drive)
    yield from window.send("R", "PRESS", *MIDDLE)
    yield from window.send("R", "RELEASE", *MIDDLE)
    yield from hold(FORWARD, 3)
    yield from hold(TO_THE_RIGHT, 1.5)
    yield from window.send(TO_THE_RIGHT, "PRESS", *MIDDLE)
    yield from window.drawn()
    yield from crop("driving", window.view()["region"])
    yield from crop("drive", window.sidebar()["region"], fit=True)
    yield from window.send("ESC", "PRESS", *MIDDLE)
    recording = character().fragmotion.recordings[0]
    recording.name = "To the right"
    yield from panels("recordings", "Recordings")


def pictures_of_baking() -> Iterator[None]:
    """Bake, of that recording."""
    bake = character().fragmotion.bake
    bake.loop, bake.reduce = True, True
    yield from panels("bake", "Bake", "Bake Options")


def pictures_of_a_crowd() -> Iterator[None]:
    """Copies that have been on their way for some seconds."""
    window.press(bpy.ops.fragmotion.populate, "EXEC_DEFAULT", True, count=8, seconds=6.0, player="walker")
    bpy.context.scene.frame_set(90)
    space = window.view()["area"].spaces[0]
    space.overlay.show_bones = False
    space.region_3d.view_distance, space.region_3d.view_location = 13, (0, 0, 0.7)
    yield from crop("crowd", window.view()["region"])


def steps() -> Iterator[None]:
    """All the pictures, in the default width of the sidebar."""
    bpy.context.preferences.system.use_region_overlap = False
    Path(window.FOLDER).mkdir(exist_ok=True)
    takes = Path(bpy.app.tempdir) / "mocap"
    yield from imported(takes)
    yield from brought_over(takes)
    yield from open_character()
    yield from pictures_of_building()
    yield from pictures_of_driving()
    yield from pictures_of_baking()
    yield from pictures_of_a_crowd()
    window.show_all()  # all that the add-on unregisters


window.run(steps())
