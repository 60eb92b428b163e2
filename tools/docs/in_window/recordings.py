# SPDX-License-Identifier: MIT
"""The pictures of "Change what you recorded" in docs/directing.md. `dev.py docs directing` runs this in a Blender with
a window; arguments after `--`: the add-on's zip and the pictures' folder."""

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

FPS, FIRST = 24, 1
AT = 7.0  # s of the recording, where it is pinned
OFF = (0.25, -0.2, 0.15)  # m and rad that the pin is away from where the recording leads
VIEW = Euler((math.radians(55), 0, math.radians(20)))
GAP = 8  # pixels


def character() -> Any:
    """The sample character."""
    return bpy.data.objects[making.ARMATURE]


taken: list[Any] = []
"""Pixels [H,W,4] of pictures that were taken."""


def take(part: Any) -> Iterator[None]:
    """Picture an area or a region of the window."""
    for _ in range(4):
        part.tag_redraw()
        yield
    window.photograph("whole")
    path = Path(window.FOLDER) / "whole.png"
    image = bpy.data.images.load(str(path))
    width, height = image.size
    pixels = np.empty(width * height * 4, np.float32)
    image.pixels.foreach_get(pixels)
    bpy.data.images.remove(image)
    path.unlink()
    taken.append(pixels.reshape(height, width, 4)[part.y : part.y + part.height, part.x : part.x + part.width])


def save(pixels: Any, name: str) -> None:
    """Write pixels [H,W,4] as a PNG."""
    image = bpy.data.images.new("part", pixels.shape[1], pixels.shape[0])
    image.pixels.foreach_set(np.ascontiguousarray(pixels).ravel())
    image.filepath_raw, image.file_format = f"{window.FOLDER}/{name}.png", "PNG"
    image.save()
    bpy.data.images.remove(image)


def recorded() -> Iterator[None]:
    """The sample character, built, with a recording."""
    bpy.ops.wm.open_mainfile(filepath=str(making.SAMPLE), load_ui=False)
    yield
    making.activate(character())
    window.press(bpy.ops.fragmotion.build, "EXEC_DEFAULT", True)
    scene, settings = bpy.context.scene, character().fragmotion
    scene.render.fps, scene.render.fps_base, settings.bake.frame_start = FPS, 1.0, FIRST
    space = window.module("character.building").load(character()).space
    trace = window.module("compat.core").core.simulate_trace("explorer", 12.0, 2, space)
    start = window.module("bake.performing").origin_frame(character())
    window.module("recordings.recordings").add_recording(character(), trace, name="Walk", start=start)


def picture_of_curves() -> Iterator[None]:
    """The curves in the Graph Editor, where the viewport was."""
    area = window.view()["area"]
    area.type = "GRAPH_EDITOR"
    yield
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
        bpy.ops.fragmotion.edit_curves("EXEC_DEFAULT")
    region = next(r for r in area.regions if r.type == "WINDOW")
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0], area=area, region=region):
        bpy.ops.graph.view_all()
    yield from take(area)
    save(taken.pop(), "curves")
    area.type = "VIEW_3D"
    yield


def picture_of_the_panel() -> Iterator[None]:
    """The panel Change."""
    making.activate(character())
    yield from window.open_tab()
    window.show_only("Change")
    yield
    yield from take(window.sidebar()["region"])
    part = taken.pop()
    drawn = np.flatnonzero(np.ptp(part[:, : part.shape[1] - 40, :3], axis=1).max(axis=1) > 0.02)
    save(part[max(drawn[0] - 6, 0) :], "change")


def picture_of_a_pin() -> Iterator[None]:
    """The character at the pin's frame, before and after."""
    obj, scene = character(), bpy.context.scene
    recording = obj.fragmotion.recordings[0]
    pose = round(60 * AT)
    frame = window.module("edits.replaying").shown_poses(obj, recording).path[pose] + OFF
    mark = bpy.data.objects.new("Pin", None)
    scene.collection.objects.link(mark)
    mark.empty_display_type, mark.empty_display_size = "ARROWS", 0.8
    mark.location, mark.rotation_euler.z = (frame[0], frame[1], 0), frame[2] - math.pi
    obj.fragmotion.pin_at = mark
    space = window.view()["area"].spaces[0]
    space.show_region_ui = False
    space.shading.type, space.overlay.show_bones, space.overlay.show_cursor = "SOLID", False, False
    space.overlay.show_extras = True
    space.region_3d.view_perspective, space.region_3d.view_rotation = "PERSP", VIEW.to_quaternion()
    space.region_3d.view_location, space.region_3d.view_distance = (frame[0], frame[1], 0.8), 4.0
    for _ in range(2):
        window.press(bpy.ops.fragmotion.bake, "EXEC_DEFAULT", True, trace_source="RECORDING", recording=0)
        scene.frame_set(round(FIRST + FPS * AT))
        mark.select_set(True)
        yield from take(window.view()["region"])
        window.press(bpy.ops.fragmotion.pin_recording, "EXEC_DEFAULT", True)
    middle = taken[0].shape[1] // 2
    parts = [part[:, middle - 330 : middle + 330] for part in taken]
    save(np.concatenate((parts[0], np.ones((len(parts[0]), GAP, 4), np.float32), parts[1]), axis=1), "pin")


def steps() -> Iterator[None]:
    """All the pictures."""
    bpy.context.preferences.system.use_region_overlap = False
    Path(window.FOLDER).mkdir(exist_ok=True)
    yield from recorded()
    yield from picture_of_a_pin()
    yield from picture_of_the_panel()
    yield from picture_of_curves()
    window.show_all()  # all that the add-on unregisters


window.run(steps())
