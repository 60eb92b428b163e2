# SPDX-License-Identifier: MIT
"""Run in a Blender with a window by test_windows.py: drive with two windows, take away what a drive stands on, undo.

It takes no picture: a screenshot with two windows open disturbs Debian's Blender 3.4.1 (without any add-on it leaves a
memory block that is not freed), which then crashes some steps after one of them was closed.

Arguments after `--`: the add-on's zip, and a folder that stays empty.
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

MIDDLE = (500, 400)  # of the 3D view, in the first window and in the second
PROPERTIES = (1450, 200)  # of the first window; the second one shows its 3D view there
NOTE = "fragmotion_put_aside"

session, waking = window.module("drive.session"), window.module("preview.waking")
overlays = window.module("drive.hud.overlays")


def windows() -> list[Any]:
    """Blender's windows, the first one first."""
    return list(bpy.context.window_manager.windows)


def view_of(which: Any) -> dict[str, Any]:
    """A window's 3D view, as an operator started by hand sees it."""
    area = next(area for area in which.screen.areas if area.type == "VIEW_3D")
    return {"window": which, "area": area, "region": next(r for r in area.regions if r.type == "WINDOW")}


def send(which: Any, kind: str, value: str, place: tuple[int, int] = MIDDLE, **modifiers: bool) -> Iterator[None]:
    """One event of a window."""
    which.event_simulate(type=kind, value=value, x=place[0], y=place[1], **modifiers)
    yield


def open_window() -> Iterator[None]:
    """A second window, of a 3D view."""
    with bpy.context.temp_override(window=windows()[0]):
        bpy.ops.wm.window_new()
    yield from window.until(lambda: len(windows()) == 2, "the second window")
    yield from window.seconds(0.5)


def close_window() -> None:
    """Close the second window."""
    with bpy.context.temp_override(window=windows()[1]):
        bpy.ops.wm.window_close()


def drive(which: Any) -> Any:
    """Press Drive in a window's view."""
    with bpy.context.temp_override(**view_of(which)):
        assert bpy.ops.fragmotion.drive("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    return session.current


def go_on(steps: int = 20) -> Iterator[None]:
    """Let the drive go on by so many steps."""
    driven = session.current
    end = driven._steps + steps
    yield from window.until(lambda: session.current is not driven or driven._steps >= end, "the drive")
    assert session.current is driven, f"the drive has ended: {driven.farewell}"


def reports() -> str:
    """All that Blender has told its user."""
    first = windows()[0]
    area = next(area for area in first.screen.areas if area.type == "OUTLINER")
    area.type = "INFO"
    with bpy.context.temp_override(window=first, area=area, region=area.regions[-1]):
        bpy.ops.info.select_all(action="SELECT")
        bpy.ops.info.report_copy()
    area.type = "OUTLINER"
    return str(bpy.context.window_manager.clipboard)


def state(obj: bpy.types.Object) -> list[Any]:
    """What a drive must give back."""
    bones = [(bone.rotation_mode, bone.matrix_basis.copy()) for bone in obj.pose.bones]
    return [*bones, NOTE in obj, bpy.context.scene.frame_current, obj.matrix_basis.copy()]


def assert_nothing_is_left(before: list[Any]) -> Iterator[None]:
    """The armature is as it was, and no timer and no drawing is left of the drive."""
    assert session.current is None and overlays._handlers == []
    assert state(bpy.data.objects["Rig"]) == before
    yield from window.until(lambda: waking._timers == [], "the end of the drive's operators", 20)


def session_of_tests() -> Iterator[None]:
    """The whole of it."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, load_ui=False)
    yield
    for part in (lose_the_view, hear_both_windows, lose_a_window, undo_while_recording, delete_the_armature):
        bpy.ops.object.select_all(action="DESELECT")
        obj = making.add_armature()
        bpy.ops.ed.undo_push(message="armature")
        yield from part(state(obj))
        for other in list(bpy.data.objects):
            bpy.data.objects.remove(other)
    assert "StructRNA" not in reports()


def hear_both_windows(before: list[Any]) -> Iterator[None]:
    """A window that is opened meanwhile is heard, too; its view is not taken for one of the first window."""
    driven = drive(windows()[0])
    yield from open_window()
    first, second = windows()
    for which in (second, first):
        yield from send(which, "MOUSEMOVE", "NOTHING")
        yield from send(which, "W", "PRESS")
        yield from go_on()
        assert driven.readings.control.forward != 0, "a window does not hear the keys"
        yield from send(which, "W", "RELEASE")
        yield from go_on(2)
        assert driven.readings.control.forward == 0
    yield from send(first, "MOUSEMOVE", "NOTHING", PROPERTIES)
    yield from send(first, "W", "PRESS", PROPERTIES)
    yield from go_on(2)
    assert driven.readings.control.forward == 0, "a key over the Properties drives"
    yield from send(first, "W", "RELEASE", PROPERTIES)
    yield from send(second, "ESC", "PRESS")
    yield from assert_nothing_is_left(before)


def lose_a_window(before: list[Any]) -> Iterator[None]:
    """The drive goes on without the second window, and ends with its own."""
    drive(windows()[0])
    yield from go_on()
    close_window()
    yield from go_on()
    assert len(waking._timers) == 1
    yield from send(windows()[0], "ESC", "PRESS")
    yield from assert_nothing_is_left(before)

    yield from open_window()
    driven = drive(windows()[1])
    driven.toggle_recording()
    yield from go_on()
    close_window()
    yield
    assert [each.name for each in bpy.data.objects["Rig"].fragmotion.recordings] == ["Recording"], (
        "the recording is lost"
    )
    yield from assert_nothing_is_left(before)


def lose_the_view(before: list[Any]) -> Iterator[None]:
    """The drive goes on in another workspace, and without any view."""
    first = windows()[0]
    drive(first)
    yield from go_on()
    for name in ("Scripting", "Layout"):
        first.workspace = bpy.data.workspaces[name]
        yield from window.seconds(0.3)
        yield from go_on()
    area = view_of(first)["area"]
    area.type = "TEXT_EDITOR"
    yield from go_on()
    area.type = "VIEW_3D"
    yield from go_on()
    yield from send(first, "ESC", "PRESS")
    yield from assert_nothing_is_left(before)


def undo_while_recording(before: list[Any]) -> Iterator[None]:
    """Ctrl Z only ends the drive; the recording is a step, and what was done before is undone after it. Edit > Undo, in
    the midst of a drive, does the same."""
    first = windows()[0]
    making.add_mesh().name = "Another"
    making.activate(bpy.data.objects["Rig"])
    bpy.ops.ed.undo_push(message="another")
    for undo in (lambda: send(first, "Z", "PRESS", ctrl=True), undo_by_menu):
        drive(first).toggle_recording()
        yield from send(first, "MOUSEMOVE", "NOTHING")
        yield from go_on()
        yield from undo()
        yield
        yield from assert_nothing_is_left(before)
        assert len(bpy.data.objects["Rig"].fragmotion.recordings) == 1 and "Another" in bpy.data.objects
        yield from send(first, "Z", "RELEASE")
        yield from send(first, "Z", "PRESS", ctrl=True)
        yield from send(first, "Z", "RELEASE")
        assert not bpy.data.objects["Rig"].fragmotion.recordings and "Another" in bpy.data.objects
    assert "Undo has ended the drive" in reports() and "ended by undo" in reports()


def undo_by_menu() -> Iterator[None]:
    """As the menu calls it."""
    with bpy.context.temp_override(**view_of(windows()[0])):
        bpy.ops.ed.undo("INVOKE_DEFAULT")
    yield


def delete_the_armature(_before: list[Any]) -> Iterator[None]:
    """One sentence, also where the mouse moves before the drive's timer tells."""
    first = windows()[0]
    drive(first)
    yield from go_on()
    bpy.data.objects.remove(bpy.data.objects["Rig"])
    yield from send(first, "MOUSEMOVE", "NOTHING", (510, 410))
    yield from window.seconds(0.3)
    assert session.current is None and waking._timers == []
    assert reports().strip().splitlines()[-1].endswith("The drive has ended: Armature 'Rig' was deleted")


window.run(session_of_tests())
