# SPDX-License-Identifier: MIT
"""Run in a Blender with a window by test_windows.py: draw a path on the ground by mouse, and follow it; click the
places of a storyboard, and of a pin.

Arguments after `--`: the add-on's zip, the folder for pictures.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator
from pathlib import Path

import bpy
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Euler, Vector

sys.path.insert(0, str(Path(__file__).resolve().parent))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "blender"))

import making
import window

VIEW = Euler((math.radians(55), 0, math.radians(20)))
CLICKED = (500, 480)  # pixels
PLAYHEAD, ASIDE = 121, (0.15, 0.1)  # frame, m: when a pin is, and where beside the path
STROKE = [(250 + 12 * step, 380 + round(110 * math.sin(step / 8))) for step in range(50)]  # pixels


def look() -> None:
    """From above, at a slant."""
    space = window.view()["area"].spaces.active.region_3d
    space.view_perspective, space.view_distance = "PERSP", 14.0
    space.view_rotation, space.view_location = VIEW.to_quaternion(), (0.0, 0.0, 0.0)


def draw() -> Iterator[None]:
    """Hold the left mouse button and move along the stroke."""
    yield from window.send("MOUSEMOVE", "NOTHING", *STROKE[0])
    yield from window.send("LEFTMOUSE", "PRESS", *STROKE[0])
    for place in STROKE[1:]:
        yield from window.send("MOUSEMOVE", "NOTHING", *place)
    yield from window.send("LEFTMOUSE", "RELEASE", *STROKE[-1])
    yield from window.drawn()


def walk_to_a_click() -> Iterator[None]:
    """Drive, and click on the ground: the character goes there, and the drive ends as any."""
    preferences = window.module("settings.preferences")
    session, ground = window.module("drive.session"), window.module("paths.drawing").ground_under
    window.press(bpy.ops.fragmotion.drive)
    yield from window.seconds(0.5)
    driven, (x, y) = session.current, CLICKED
    assert preferences.get(bpy.context).first_steps, "the first steps go before the first drive"
    driven.settings.follow = False
    area = window.view()["area"]
    region = window.view()["region"]
    place = ground(area, x - region.x, y - region.y, None)
    yield from window.click(x, y)
    yield from window.until(lambda: driven.inputs.label == "Click on the ground", "the click", 50)
    yield from window.until(lambda: driven.inputs.target.intent().control is None, "the arrival", 400)
    yield from window.seconds(1)
    assert math.dist(driven.actor.frame[:2], place[:2]) < 0.3
    yield from window.send("ESC", "PRESS", x, y)
    yield from window.until(lambda: session.current is None, "the end of the drive", 50)
    yield from window.until(lambda: not preferences.get(bpy.context).first_steps, "the end of the first steps", 50)


def click_places(obj: bpy.types.Object) -> Iterator[None]:
    """Each press of + waits for a click on the ground, whatever the 3D cursor's height, which Esc and a click elsewhere
    take back."""
    window.show_only("Storyboard")
    region, (x, y), story = window.view()["region"], CLICKED, obj.fragmotion.story
    ground = window.module("paths.drawing").ground_under
    bpy.context.scene.cursor.location = (1, 2, 3)
    yield from window.drawn()
    place = ground(window.view()["area"], x - region.x, y - region.y, None)
    window.press(bpy.ops.fragmotion.add_beat)
    assert window.says_keys(), "the status bar does not say what to click"
    yield from window.send("ESC", "PRESS", x, y)
    assert not len(story) and not window.says_keys()
    window.press(bpy.ops.fragmotion.add_beat)
    sidebar = window.sidebar()["region"]
    yield from window.click(sidebar.x + sidebar.width // 2, sidebar.y + 20)
    assert not len(story) and not window.says_keys(), "a click beside the view is a place"
    window.press(bpy.ops.fragmotion.add_beat)
    yield from window.click(x, y)
    yield from window.picture("3 placed")
    (beat,) = story
    assert (beat.place.location - place).length < 1e-4 and not window.says_keys()
    assert (bpy.context.scene.cursor.location - place).length < 1e-4
    with bpy.context.temp_override(**window.view()):
        bpy.ops.ed.undo()
    yield from window.drawn()
    assert not len(bpy.context.view_layer.objects.active.fragmotion.story), "one undo step"


def pin_by_click(obj: bpy.types.Object) -> Iterator[None]:
    """Pin Here asks for the place, and then works as ever."""
    (recording,), scene = obj.fragmotion.recordings, bpy.context.scene
    pose = round(60 * (PLAYHEAD - obj.fragmotion.bake.frame_start) / scene.render.fps)
    shown_of, controls = window.module("recordings.recordings").shown_of, recording.controls
    scene.frame_set(PLAYHEAD)
    wanted = shown_of(recording)[1].path[pose][:2] + ASIDE
    part = window.view()["region"]
    pixel = location_3d_to_region_2d(part, window.view()["area"].spaces[0].region_3d, Vector((*wanted, 0)))
    window.press(bpy.ops.fragmotion.pin_recording)
    assert recording.controls == controls and window.says_keys(), "it does not wait for the click"
    yield from window.click(round(part.x + pixel.x), round(part.y + pixel.y))
    yield from window.until(lambda: recording.controls != controls, "the pin", 400)
    yield from window.drawn()
    assert math.dist(shown_of(recording)[1].path[pose][:2], wanted) < 0.05
    assert not window.says_keys()


def edit_curves() -> Iterator[None]:
    """The curves of a recording are shown, in a window of their own where no editor would show them."""
    manager = bpy.context.window_manager
    for _ in range(2):
        window.press(bpy.ops.fragmotion.edit_curves, "EXEC_DEFAULT", True)
        yield from window.drawn()
        assert len(manager.windows) == 2, "one Graph Editor is enough"
    added = manager.windows[-1]
    assert [area.ui_type for area in added.screen.areas] == ["FCURVES"]
    with bpy.context.temp_override(window=added):
        bpy.ops.wm.window_close()
    yield from window.drawn()


def session_of_tests() -> Iterator[None]:
    """The whole of it."""
    obj = making.open_sample()
    yield from window.open_tab()
    window.press(bpy.ops.fragmotion.build, "EXEC_DEFAULT")
    yield
    look()
    yield from window.drawn()
    curves = len(bpy.data.curves)
    window.press(bpy.ops.fragmotion.draw_path)
    yield from window.send("ESC", "PRESS", *STROKE[0])
    yield from window.drawn()
    assert len(bpy.data.curves) == curves, "Esc draws nothing"
    window.press(bpy.ops.fragmotion.draw_path)
    yield from draw()
    obj = bpy.context.view_layer.objects.active
    curve = obj.fragmotion.path.curve
    assert curve is not None and curve.type == "CURVE", "no curve was drawn"
    points = curve.data.splines[0].points
    assert len(points) > 20 and all(0 < point.co.z < 0.02 for point in points)
    window.show_only("Path", "Recordings")
    yield from window.picture("1 drawn")
    yield from window.click_button("fragmotion.follow_path")
    yield from window.until(lambda: len(obj.fragmotion.recordings) == 1, "the recording", 100)
    places = window.module("recordings.recordings").shown_of(obj.fragmotion.recordings[0])[1].path
    assert math.dist(places[-1][:2], points[-1].co[:2]) < 0.2
    window.press(bpy.ops.fragmotion.bake, "EXEC_DEFAULT", trace_source="RECORDING", recording=0)
    bpy.context.scene.frame_set(70)
    yield from window.picture("2 followed")
    yield from pin_by_click(obj)
    yield from walk_to_a_click()
    yield from click_places(obj)
    yield from edit_curves()
    window.show_all()


window.run(session_of_tests())
