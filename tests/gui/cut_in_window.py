# SPDX-License-Identifier: MIT
"""Run in a Blender with a window by test_windows.py: cut a stretch out of a recording by dragging its two ends on the
timeline, by mouse.

Arguments after `--`: the add-on's zip, the folder for pictures.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "blender"))

import making
import window

FIRST, RATE = 1, 30  # the recording's first frame, the sample's frames a second
MIDDLE = (600, 450)  # of the viewport
timeline = window.module("drive.hud.timeline")
_mark, _spans = timeline.mark, []


def place(seconds: float) -> tuple[int, int]:
    """Where on the timeline such a moment of the recording is, in pixels of the window."""
    area = timeline.areas_of(window.view()["window"])[0]
    part = next(region for region in area.regions if region.type == "WINDOW")
    across = part.view2d.view_to_region(FIRST + RATE * seconds, 0, clip=False)[0]
    return part.x + across, part.y + part.height // 3


def drag(begin: float, end: float) -> Iterator[None]:
    """From one moment on the timeline to another, by the left button; the mouse leaves the timeline on its way."""
    (x, y), (to, _) = place(begin), place(end)
    yield from window.send("MOUSEMOVE", "NOTHING", x, y)
    yield from window.send("LEFTMOUSE", "PRESS", x, y)
    for share in (0.25, 0.5, 0.75):
        yield from window.send("MOUSEMOVE", "NOTHING", round(x + share * (to - x)), y + 60)
    yield from window.send("MOUSEMOVE", "NOTHING", to, y)
    yield from window.send("LEFTMOUSE", "RELEASE", to, y)


def watch(spans: Any) -> None:
    """Mark the timeline, and remember with what."""
    _spans[:] = spans()
    _mark(spans)


def marked() -> tuple[float, float]:
    """What is red on the timeline, in seconds of the recording."""
    assert timeline._handlers
    return (_spans[0].first - FIRST) / RATE, (_spans[0].last - FIRST) / RATE


def steps() -> Iterator[None]:
    """The whole session."""
    timeline.mark = watch
    bpy.ops.wm.open_mainfile(filepath=str(making.SAMPLE), load_ui=False)
    yield
    obj = bpy.data.objects[making.ARMATURE]
    making.activate(obj)
    window.press(bpy.ops.fragmotion.build, "EXEC_DEFAULT", True)
    recording = window.module("recordings.recordings").add_recording(
        obj, np.tile([0, 1.2, 0, 0], (80, 1)).astype(float)
    )
    controls, scene = recording.controls, bpy.context.scene
    scene.frame_set(FIRST + 2 * RATE)
    with bpy.context.temp_override(**window.view()):
        bpy.ops.ed.undo_push(message="recorded")
    yield from window.open_tab()
    window.show_only("Recordings", "Change")
    yield from window.drawn()

    yield from window.click_button("fragmotion.cut_recording")
    assert window.says_keys()
    yield from window.picture("1 offered")
    begin, end = marked()
    assert 1.8 <= begin <= 2 and 3 <= end <= 3.3
    yield from drag(end, end + 2)
    assert marked()[0] == begin and 4.9 <= marked()[1] <= 5.6
    yield from drag(begin - 0.2, begin + 0.5)
    assert 2.2 <= marked()[0] <= 2.7
    yield from drag(marked()[0], 7.5)
    assert marked()[0] < marked()[1], "no end passes the other"
    yield from drag(marked()[0], 2.0)
    yield from window.picture("2 dragged")
    yield from window.send("ESC", "PRESS", *MIDDLE)
    yield from window.drawn()
    assert obj.fragmotion.recordings[0].controls == controls, "Esc cuts nothing"
    assert timeline._handlers == [] and not window.says_keys()

    scene.use_preview_range, scene.frame_preview_start, scene.frame_preview_end = True, FIRST + RATE, FIRST + 2 * RATE
    yield from window.click_button("fragmotion.cut_recording")
    yield from drag(marked()[1], 4.0)
    begin, end = marked()
    yield from window.send("RET", "PRESS", *MIDDLE)
    yield from window.picture("3 cut")
    left = obj.fragmotion.recordings[0].seconds
    assert abs(left - (8 - (end - begin))) < 1e-3 and 4.5 < left < 5.5
    assert timeline._handlers == [] and not window.says_keys() and not scene.use_preview_range
    with bpy.context.temp_override(**window.view()):
        bpy.ops.ed.undo()
    yield from window.drawn()
    assert bpy.data.objects[making.ARMATURE].fragmotion.recordings[0].controls == controls, "one undo step"


window.run(steps())
