# SPDX-License-Identifier: MIT
"""Run in a Blender with a window by test_windows.py: import takes, build, drive with a pad, the keyboard and the mouse,
record, bake, undo, save, reload, replay.

Arguments after `--`: the add-on's zip, the folder for takes, files and pictures.
"""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Generator, Iterator
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from mathutils import Euler

sys.path.insert(0, str(Path(__file__).resolve().parent))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "blender"))

import making
import window
from sample_takes import export_takes

RATE = 60
LEFT_X, LEFT_Y, RIGHT_X = 0, 1, 2
JUMP, START = 0, 6
MIDDLE = (600, 450)  # of the viewport
VIEW = math.radians(45)  # its heading, counter-clockwise from +Y
DRAWS = 10  # of the panels, of which the quickest counts

session, waking = window.module("drive.session"), window.module("preview.waking")
overlays = window.module("drive.hud.overlays")
woken = window.module("operators.base.woken")
recordings = window.module("recordings.recordings")
sdl = window.module("input.sdl").load()
costs = window.watch_panels()


class Clock:
    """The time that the drive's operator sees: the real one, or so much more at each look."""

    def __init__(self) -> None:
        self._real = time.perf_counter
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


def build_character(folder: Path) -> bpy.types.Object:
    """An armature with imported takes and a character, in an awkward state; the view looks north-west from above."""
    export_takes(folder)
    bpy.ops.wm.read_homefile(use_factory_startup=True, load_ui=False)
    window.press(bpy.ops.fragmotion.import_mocap, "EXEC_DEFAULT", True, directory=str(folder))
    window.press(bpy.ops.fragmotion.build, "EXEC_DEFAULT", True)
    obj = bpy.context.view_layer.objects.active
    bpy.context.scene.frame_set(37)
    for bone in obj.pose.bones:
        bone.location.x += 0.01
    space = window.view()["area"].spaces[0]
    space.shading.type = "SOLID"
    space.region_3d.view_perspective = "PERSP"
    space.region_3d.view_rotation = Euler((math.radians(60), 0, VIEW)).to_quaternion()
    space.region_3d.view_location, space.region_3d.view_distance = (0, 0, 0.8), 9
    return obj


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
    window.tell(f"stick ({right:+.1f}, {up:+.1f}): went {length:.2f} m of {asked:.2f} m, {off:.0f} degrees off")
    assert off < 15 and 0.75 < length / asked < 1.25


def assert_nothing_is_left() -> Iterator[None]:
    """No timer, no drawing, no SDL device, and nothing in the status bar after a drive."""
    assert session.current is None and overlays._handlers == []
    assert sdl.SDL_WasInit(0) == 0, "SDL is open"
    yield from window.until(lambda: waking._timers == [], "the end of the drive's operator", 20)
    assert not window.says_keys(), "the status bar still names keys"
    yield from window.count_timers()
    assert window.TEST_OT_count_timers.count < 3, "a timer goes on"  # Blender's own may come once


def measure() -> None:
    """Tell what an update costs, without the drawing; the best second of ten."""
    driven, costs = session.current, []
    for _ in range(10):
        begin = time.perf_counter()
        for _ in range(RATE):
            driven.update(1 / RATE)
        costs.append((time.perf_counter() - begin) / RATE)
    window.tell(f"our own time: {1000 * min(costs):.2f} ms an update of {len(driven.obj.pose.bones)} bones, goal 2 ms")
    assert min(costs) < 0.02


def measure_panels(moment: str) -> Iterator[None]:
    """Tell what drawing each of the panels costs, all being open; the best of some."""
    window.show_all()
    for times in costs.values():
        times.clear()
    for _ in range(DRAWS):
        window.sidebar()["region"].tag_redraw()
        yield from window.seconds(0.1)
    best = {label: min(times) for label, times in costs.items() if times}
    window.tell(f"ms a draw {moment}, goal 1 ms: " + ", ".join(f"{k} {1000 * best[k]:.2f}" for k in best))
    assert max(best.values()) < 0.01


def session_of_tests() -> Iterator[None]:
    """The whole of it."""
    clock = Clock()
    woken.time, session.LONGEST_UPDATE = clock, 0.5
    obj = build_character(Path(window.FOLDER) / "takes")
    yield from window.open_tab()
    yield from measure_panels("at rest")
    window.show_only("Drive", "Overlays", "Recordings")
    yield from window.picture("1 before")
    before = state(obj)
    yield from drive_with_all_inputs(obj, clock)
    assert {**state(obj), "view": before["view"]} == before, "the scene is not as it was"
    assert state(obj)["view"] == before["view"], "the view does not stand where it stood"
    obj = yield from bake_and_undo(obj, before)
    obj = yield from reload(obj)
    yield from replay(obj)
    with bpy.context.temp_override(**window.view()):
        bpy.ops.test.count_timers("INVOKE_DEFAULT")
    yield from assert_nothing_is_left()
    yield from end_otherwise(obj)


def drive_with_all_inputs(obj: bpy.types.Object, clock: Clock) -> Iterator[None]:
    """20 seconds and more: the shortcut, a pad that comes and goes, keys, the on-screen stick, a recording."""
    yield from window.send("MOUSEMOVE", "NOTHING", *MIDDLE)
    yield from window.send("D", "PRESS", *MIDDLE, ctrl=True, shift=True)
    yield from window.send("D", "RELEASE", *MIDDLE, ctrl=True, shift=True)
    driven = session.current
    assert driven is not None, "the shortcut does not start the drive"
    assert window.says_keys(), "the status bar names no keys"
    pad = VirtualPad()
    pad.push(0, 0.57)
    yield from wait(1)
    measure()
    assert driven.inputs.label == driven.inputs.pads[0].label
    yield from window.picture("2 walking")
    yield from steer(pad, clock)
    yield from window.picture("3 running")
    yield from record(driven, pad)
    yield from use_keys(driven)
    yield from drag_stick(driven)
    yield from use_the_panel(driven)
    yield from window.send("ESC", "PRESS", *MIDDLE)
    assert session.current is None, "Esc does not end the drive"


def steer(pad: VirtualPad, clock: Clock) -> Iterator[None]:
    """The stick goes all around, and the time by more quickly."""
    clock.step = 0.3
    for right, up in ((0, 0.57), (0.57, 0), (-1, 0), (0, 1), (0.7, -0.7)):
        yield from lead(pad, right, up, 3)
    clock.step = 0


def record(driven: Any, pad: VirtualPad) -> Iterator[None]:
    """A recording that the pad's Start begins while the character stands; the pad vanishes, and the key ends it."""
    pad.push()
    yield from wait(2)
    pad.push(buttons=(START,))
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
    (recording,) = driven.obj.fragmotion.recordings
    assert recording.seconds > 1.9 and driven.recording is None


def use_keys(driven: Any) -> Iterator[None]:
    """W goes forward."""
    yield from window.send("W", "PRESS", *MIDDLE)
    yield from wait(0.3)
    assert driven.inputs.label == "Keyboard" and driven.readings.control.forward != 0
    yield from window.send("W", "RELEASE", *MIDDLE)


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
    yield from measure_panels("while driving")
    window.show_only("Drive", "Drive Options", "Gamepads", "Overlays", "Trace", "Recordings")
    yield from window.picture("6 panels")
    yield from window.click_button("follow")
    assert not driven.settings.follow, "the panel does not answer"
    yield from window.click_button("follow")
    assert driven.settings.follow and session.current is driven


def bake_and_undo(obj: bpy.types.Object, before: dict[str, Any]) -> Generator[None, None, bpy.types.Object]:
    """Bake's button bakes what was seen of the recording that is selected, and one undo takes it back."""
    (recording,) = obj.fragmotion.recordings
    _, motion = recordings.shown_of(recording)
    window.show_only("Bake")
    yield from window.click_button("fragmotion.bake")
    yield from window.until(
        lambda: obj.animation_data.action.name == f"{recording.name} Bake", "the bake of the recording"
    )
    scene = bpy.context.scene
    last = round(obj.animation_data.action.frame_range[1])
    shown = making.play(obj, obj.animation_data.action, last)
    hips = shown.matrix_world @ shown.pose.bones["hips"].head
    assert math.dist(hips[:2], motion.path[-1][:2]) < 0.3, "the bake does not end where the character stood"
    scene.frame_set(last // 2)
    yield from window.picture("7 baked")
    bpy.ops.ed.undo()
    obj = bpy.context.view_layer.objects.active
    assert state(obj) == before, "one undo does not take the bake back"
    return obj


def reload(obj: bpy.types.Object) -> Generator[None, None, bpy.types.Object]:
    """The file is saved and loaded: the recordings, the character and the settings are there."""
    (recording,), name, path = obj.fragmotion.recordings, obj.name, f"{window.FOLDER}/driven.blend"
    kept = (recording.name, recording.seconds, recordings.trace_of(recording).tolist(), obj.fragmotion.policy)
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path, load_ui=False)
    yield
    obj = bpy.data.objects[name]
    (recording,) = obj.fragmotion.recordings
    assert (recording.name, recording.seconds, recordings.trace_of(recording).tolist(), obj.fragmotion.policy) == kept
    return obj


def replay(obj: bpy.types.Object) -> Iterator[None]:
    """The recording's button lets it drive as it was recorded, until Esc; and the scene is as before."""
    before, (recording,) = state(obj), obj.fragmotion.recordings
    trace, (_, motion) = recordings.trace_of(recording), recordings.shown_of(recording)
    window.show_only("Recordings")
    yield from window.click_button("fragmotion.drive")
    yield from wait(1)
    driven = session.current
    assert driven.inputs.label == "Trace" and driven.recording is None
    np.testing.assert_array_equal(driven.control, trace[(driven._steps - 1) * 10 // RATE])
    np.testing.assert_allclose(driven.actor.frame, motion.path[driven._steps], atol=1e-3)
    yield from window.picture("8 replay")
    yield from window.send("ESC", "PRESS", *MIDDLE)
    assert session.current is None and state(obj) == before
    obj.fragmotion.drive.replay, obj.fragmotion.drive.seed = "greedy", 7
    yield from window.drawn()
    yield from window.click_button("fragmotion.drive")
    assert (session.current.actor.policy, session.current.seed) == ("greedy", 7)
    yield from window.send("ESC", "PRESS", *MIDDLE)


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
    yield from window.picture("9 sliding")
    yield from window.send("W", "RELEASE", *MIDDLE)
    bpy.data.objects.remove(obj)
    for _ in range(10):
        yield
    yield from assert_nothing_is_left()

    obj = making.add_armature()
    bones = [bone.matrix_basis.copy() for bone in obj.pose.bones]
    window.press(bpy.ops.fragmotion.drive)
    yield from wait(0.5)
    window.show_all()  # all that the add-on has registered
    bpy.ops.preferences.addon_disable(module=window.ADDON)
    assert [bone.matrix_basis for bone in obj.pose.bones] == bones
    yield from assert_nothing_is_left()


window.run(session_of_tests())
