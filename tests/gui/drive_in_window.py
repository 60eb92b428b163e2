# SPDX-License-Identifier: MIT
"""Run in a Blender with a window by test_drive.py: drive the sample character with a pad, the keyboard and the mouse.

Arguments after `--`: the add-on's zip (the legacy one), the folder for pictures.
"""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from mathutils import Euler

sys.path.insert(0, str(Path(__file__).resolve().parent))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "blender"))

import making
import window

NAME = "fragmotion"
RATE = 60
LEFT_X, LEFT_Y, RIGHT_X = 0, 1, 2
JUMP, START = 0, 6
MIDDLE = (600, 450)  # of the viewport
# Heights in the window of the sidebar's headers and of a tick, each as it stands when it is clicked (3.4.1).
BUILD, MOCAP, TRACE, OVERLAYS, GAMEPADS, FOLLOW = 583, 804, 543, 569, 595, 627

window.install()
session = import_module(f"{NAME}.drive.session")
overlays = import_module(f"{NAME}.drive.overlays")
button = import_module(f"{NAME}.operators.drive")
sdl = import_module(f"{NAME}.drive.sdl").load()


class Clock:
    """The time that the drive's operator sees: the real one, or so much more at each look."""

    def __init__(self) -> None:
        self._real = button.time.perf_counter
        self._shift, self.step = 0.0, 0.0

    def perf_counter(self) -> float:
        self._shift += self.step
        return float(self._real()) + self._shift


class VirtualPad:
    """A real SDL device without hardware."""

    def __init__(self) -> None:
        index = sdl.SDL_JoystickAttachVirtual(sdl.SDL_JOYSTICK_TYPE_GAMECONTROLLER, 6, 15, 0)
        assert index >= 0, sdl.SDL_GetError()
        self._device = sdl.SDL_JoystickOpen(index)

    def push(self, x: float = 0.0, y: float = 0.0, turn: float = 0.0, buttons: tuple[int, ...] = ()) -> None:
        """Push the left stick right and up, the right one right, and hold buttons."""
        for axis, value in ((LEFT_X, x), (LEFT_Y, -y), (RIGHT_X, turn)):
            sdl.SDL_JoystickSetVirtualAxis(self._device, axis, round(32767 * value))
        for index in range(15):
            sdl.SDL_JoystickSetVirtualButton(self._device, index, int(index in buttons))

    def unplug(self) -> None:
        """It is gone."""
        number = sdl.SDL_JoystickInstanceID(self._device)
        sdl.SDL_JoystickClose(self._device)
        numbers = [sdl.SDL_JoystickGetDeviceInstanceID(index) for index in range(sdl.SDL_NumJoysticks())]
        assert sdl.SDL_JoystickDetachVirtual(numbers.index(number)) == 0


class TEST_OT_count_timers(bpy.types.Operator):
    """Count the timer events that the window's modal operators get, until Esc."""

    bl_idname = "test.count_timers"
    bl_label = "Count Timers"
    count = 0

    def invoke(self, context: bpy.types.Context, _event: bpy.types.Event) -> set[str]:
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, _context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        TEST_OT_count_timers.count += event.type == "TIMER"
        return {"FINISHED"} if event.type == "ESC" else {"PASS_THROUGH"}


def state(obj: bpy.types.Object) -> dict[str, Any]:
    """What a drive must give back."""
    channels = ("location", "rotation_quaternion", "rotation_euler", "rotation_axis_angle", "scale")
    space = window.view()["area"].spaces[0].region_3d
    return {
        **making.contents(),
        "bones": {bone.name: [tuple(getattr(bone, name)) for name in channels] for bone in obj.pose.bones},
        "modes": [bone.rotation_mode for bone in obj.pose.bones],
        "place": [tuple(getattr(obj, name)) for name in channels],
        "nla": obj.animation_data.use_nla,
        "slot": getattr(obj.animation_data, "action_slot_handle", None),
        "properties": sorted(obj.keys()),
        "view": (tuple(space.view_location), tuple(space.view_rotation), space.view_distance),
    }


def sample() -> bpy.types.Object:
    """The sample file's armature with a character, in an awkward state; the view looks north-west from above."""
    bpy.ops.wm.open_mainfile(filepath=str(making.SAMPLE), load_ui=False)
    obj = next(o for o in bpy.data.objects if o.type == "ARMATURE")
    making.activate(obj)
    with bpy.context.temp_override(**window.view()):
        bpy.ops.fragmotion.tick_actions(use=True)
        bpy.ops.fragmotion.build("EXEC_DEFAULT")
    bpy.context.scene.frame_set(37)
    for bone in obj.pose.bones:
        bone.location.x += 0.01
    space = window.view()["area"].spaces[0]
    space.shading.type = "SOLID"
    space.region_3d.view_perspective = "PERSP"
    space.region_3d.view_rotation = Euler((math.radians(60), 0, VIEW)).to_quaternion()
    space.region_3d.view_location, space.region_3d.view_distance = (0, 0, 0.8), 9
    return obj


VIEW = math.radians(45)  # heading of the view, counter-clockwise from +Y


def fold(*headers: int) -> Iterator[None]:
    """Click headers of the sidebar's panels, where they are known to stand."""
    if bpy.app.version >= (3, 5, 0):
        return
    for height in headers:
        yield from window.click(1180, height)
        yield from window.drawn()


def wait(seconds: float) -> Iterator[None]:
    """Let the drive go on by so much of its own time."""
    driven = session.current
    end = driven._elapsed + seconds
    for _ in range(round(60 * seconds) + 200):
        if driven._elapsed >= end:
            return
        yield
    raise AssertionError("the drive stands still")


def lead(pad: VirtualPad, right: float, up: float, seconds: float) -> Iterator[None]:
    """Push the stick, and see that the character goes where it says, once it has had time to answer."""
    driven = session.current
    pad.push(right, up)
    yield from wait(3)
    begin, steps = np.array(driven.actor.frame[:2]), driven._steps
    yield from wait(seconds)
    way = np.array(driven.actor.frame[:2]) - begin
    seconds = (driven._steps - steps) / RATE
    space = driven.actor.space
    pace = space.walk if math.hypot(right, up) < 0.8 else space.run
    wanted = np.array((right * math.cos(VIEW) - up * math.sin(VIEW), right * math.sin(VIEW) + up * math.cos(VIEW)))
    wanted *= pace * seconds / np.linalg.norm(wanted)
    length, asked = np.linalg.norm(way), np.linalg.norm(wanted)
    off = math.degrees(math.acos(way @ wanted / length / asked))
    print(f"stick ({right:+.1f}, {up:+.1f}): went {length:.2f} m of {asked:.2f} m, {off:.0f} degrees off")
    assert off < 15 and 0.75 < length / asked < 1.25


def assert_nothing_is_left() -> Iterator[None]:
    """No timer, no drawing, no SDL device after a drive."""
    assert session.current is None and overlays._handlers == [] and session._timer is None
    assert sdl.SDL_WasInit(0) == 0, "SDL is open"
    TEST_OT_count_timers.count = 0
    for _ in range(25):
        yield
    assert TEST_OT_count_timers.count < 3, "a timer goes on"  # Blender's own may come once


def measure() -> None:
    """Print what an update costs, without the drawing; the best second of ten."""
    driven, costs = session.current, []
    for _ in range(10):
        begin = time.perf_counter()
        for _ in range(RATE):
            driven.update(1 / RATE)
        costs.append((time.perf_counter() - begin) / RATE)
    print(f"our own time: {1000 * min(costs):.2f} ms an update of {len(driven.obj.pose.bones)} bones, goal 2 ms")
    assert min(costs) < 0.02


def session_of_tests() -> Iterator[None]:
    """The whole of it."""
    clock = Clock()
    button.time, session._HICCUP = clock, 0.5
    bpy.context.preferences.system.viewport_aa = "OFF"  # drawn by software, it takes most of the time
    obj = sample()
    yield from window.open_tab()
    yield from fold(BUILD, MOCAP)
    yield from window.picture("1 before")
    before = state(obj)
    yield from drive_with_all_inputs(obj, clock)
    assert {**state(obj), "view": before["view"]} == before, "the scene is not as it was"
    assert state(obj)["view"] == before["view"], "the view does not stand where it stood"
    yield from replay(obj)
    assert state(obj) == before
    with bpy.context.temp_override(**window.view()):
        bpy.ops.test.count_timers("INVOKE_DEFAULT")
    yield from assert_nothing_is_left()
    yield from end_otherwise(obj)
    print("SESSION PASSED")


def drive_with_all_inputs(obj: bpy.types.Object, clock: Clock) -> Iterator[None]:
    """20 seconds and more: the shortcut, a pad that comes and goes, keys, the on-screen stick, a recording."""
    yield from window.send("MOUSEMOVE", "NOTHING", *MIDDLE)
    yield from window.send("D", "PRESS", *MIDDLE, ctrl=True, shift=True)
    yield from window.send("D", "RELEASE", *MIDDLE, ctrl=True, shift=True)
    driven = session.current
    assert driven is not None, "the shortcut does not start the drive"
    pad = VirtualPad()
    pad.push(0, 0.57)
    yield from wait(1)
    measure()
    assert driven.inputs.label == driven.inputs.pads[0].label
    yield from window.picture("2 walking")

    clock.step = 0.3
    for right, up in ((0, 0.57), (0.57, 0), (-1, 0), (0, 1), (0.7, -0.7)):
        yield from lead(pad, right, up, 3)
    clock.step = 0
    yield from window.picture("3 running")
    pad.push(0, 0.57, buttons=(START,))
    yield from wait(0.1)
    pad.push(0, 0.57)
    assert driven.recording is not None, "the pad's Start does not record"
    yield from wait(1)
    pad.push(0, 0.57, buttons=(JUMP,))
    yield from wait(0.5)
    yield from window.picture("4 recording")
    pad.unplug()
    yield from wait(0.5)
    assert driven.inputs.pads == [] and driven.readings.control == (0, 0, 0, 0), "a pad that is gone drives"
    yield from window.send("R", "PRESS", *MIDDLE)
    yield from window.send("R", "RELEASE", *MIDDLE)
    (take,) = obj.fragmotion.takes
    assert take.seconds > 1.9 and driven.recording is None

    yield from window.send("W", "PRESS", *MIDDLE)
    yield from wait(0.3)
    assert driven.inputs.label == "Keyboard" and driven.readings.control.forward != 0
    yield from window.send("W", "RELEASE", *MIDDLE)
    yield from drag_stick(driven)
    yield from use_the_panel(driven)
    yield from window.send("ESC", "PRESS", *MIDDLE)
    assert session.current is None, "Esc does not end the drive"


def replay(obj: bpy.types.Object) -> Iterator[None]:
    """The take's button lets it drive, until Esc."""
    window.press(bpy.ops.fragmotion.drive, source="TAKE", take=0)
    trace = import_module(f"{NAME}.takes").trace_of(obj.fragmotion.takes[0])
    yield from wait(1)
    driven = session.current
    assert driven.inputs.label == "Trace" and driven.recording is None
    np.testing.assert_array_equal(driven.control, trace[(driven._steps - 1) * 10 // RATE])
    yield from window.send("ESC", "PRESS", *MIDDLE)
    assert session.current is None


def drag_stick(driven: Any) -> Iterator[None]:
    """The mouse takes the knob to the right, and lets go."""
    region, stick = window.view()["region"], driven.inputs.stick
    x, y = (round(value) for value in np.add(stick.center, (region.x, region.y)))
    yield from window.send("MOUSEMOVE", "NOTHING", x, y)
    yield from window.send("LEFTMOUSE", "PRESS", x, y)
    yield from window.send("MOUSEMOVE", "NOTHING", x + round(stick.radius / 2), y)
    yield from wait(0.5)
    assert driven.inputs.label == "On-screen stick"
    np.testing.assert_allclose(driven.inputs.shown[:2], (0.5, 0), atol=0.02)
    yield from window.picture("5 stick")
    yield from window.send("LEFTMOUSE", "RELEASE", x, y)
    yield from wait(0.1)
    assert driven.inputs.shown[:2] == (0, 0)


def use_the_panel(driven: Any) -> Iterator[None]:
    """While one drives, the sidebar can be used."""
    yield from fold(TRACE, OVERLAYS, GAMEPADS)
    yield from window.picture("6 panels")
    if bpy.app.version < (3, 5, 0):
        yield from window.click(1120, FOLLOW)
        assert not driven.settings.follow, "the panel does not answer"
        yield from window.click(1120, FOLLOW)
    assert driven.settings.follow and session.current is driven


def end_otherwise(obj: bpy.types.Object) -> Iterator[None]:
    """Errors, deletion, loading and switching off end a drive, and leave nothing."""
    before = state(obj)
    window.press(bpy.ops.fragmotion.drive)
    yield from wait(0.2)
    session.current.update = lambda _seconds: 1 / 0
    yield
    yield
    assert session.current is None and state(obj) == before
    yield from assert_nothing_is_left()

    window.press(bpy.ops.fragmotion.drive)
    yield from wait(0.2)
    bpy.ops.wm.read_homefile(load_ui=False)
    yield from assert_nothing_is_left()

    bpy.ops.mesh.primitive_cube_add()
    obj = making.add_armature()
    window.press(bpy.ops.fragmotion.drive)
    yield from window.send("W", "PRESS", *MIDDLE)
    yield from wait(1)
    yield from window.picture("7 sliding")
    yield from window.send("W", "RELEASE", *MIDDLE)
    bpy.data.objects.remove(obj)
    for _ in range(10):
        yield
    yield from assert_nothing_is_left()

    obj = making.add_armature()
    bones = [bone.matrix_basis.copy() for bone in obj.pose.bones]
    window.press(bpy.ops.fragmotion.drive)
    yield from wait(0.5)
    bpy.ops.preferences.addon_disable(module=NAME)
    assert [bone.matrix_basis for bone in obj.pose.bones] == bones
    yield from assert_nothing_is_left()


bpy.utils.register_class(TEST_OT_count_timers)
window.run(session_of_tests())
