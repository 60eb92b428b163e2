# SPDX-License-Identifier: MIT
"""Run in a Blender with a window by test_windows.py: record over a recording, and see whose turn it is in
the view, on the timeline and in the status bar.

Arguments after `--`: the add-on's zip, the folder for pictures.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "blender"))

import making
import window

MIDDLE = (600, 450)  # of the viewport
session, timeline = window.module("drive.session"), window.module("drive.hud.timeline")


def steps() -> Iterator[None]:
    """The whole session."""
    bpy.ops.wm.open_mainfile(filepath=str(making.SAMPLE), load_ui=False)
    yield
    obj = bpy.data.objects[making.ARMATURE]
    making.activate(obj)
    window.press(bpy.ops.fragmotion.build, "EXEC_DEFAULT", True)
    window.module("recordings.recordings").add_recording(obj, np.tile([0, 1.2, 0, 0], (80, 1)).astype(float))
    bpy.context.scene.frame_set(80)
    yield from window.open_tab()
    window.show_only("Recordings", "Change")
    yield from window.drawn()
    window.press(bpy.ops.fragmotion.drive, source="OVER")
    driven = session.current
    assert driven.punch is not None and driven.span[0] == 80 and len(timeline._handlers) == 2
    yield from window.picture("1 what was there")
    assert driven.shown().title.startswith("Playing what was there")
    yield from window.until(lambda: driven.punch.is_open, "the user's turn")
    yield from window.send("D", "PRESS", *MIDDLE)
    yield from window.until(lambda: driven.punch.begun, "the takeover")
    yield from window.picture("2 yours")
    assert driven.shown().title.startswith("Recording over") and driven.inputs.label == "Keyboard"
    yield from window.send("D", "RELEASE", *MIDDLE)
    yield from window.until(lambda: driven.punch is None, "the end of the stretch")
    assert driven.shown().title.startswith("Kept")
    yield from window.until(lambda: session.current is None, "the end of the rest, with which the drive ends")
    assert timeline._handlers == [] and not window.says_keys()


window.run(steps())
