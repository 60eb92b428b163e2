# SPDX-License-Identifier: MIT
"""Run in a Blender with a window by test_windows.py: choose the sample's grounds, and drive up the stairs.

Arguments after `--`: the add-on's zip, the folder for pictures.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator
from pathlib import Path

import bpy
from mathutils import Euler

sys.path.insert(0, str(Path(__file__).resolve().parent))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "blender"))

import making
import window

MIDDLE = (600, 400)
BEFORE_THE_STAIRS = (-3.0, -7.0, 0.0)  # m: the sample faces -y
TOP_OF_THE_STAIRS = 1.44  # m
FROM_THE_SIDE = Euler((math.radians(75), 0, math.radians(125)))


def session_of_tests() -> Iterator[None]:
    """The whole session."""
    obj = making.open_sample()
    yield from window.open_tab()
    window.press(bpy.ops.fragmotion.tick_actions, use=True)
    bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=12)
    obj.location = BEFORE_THE_STAIRS
    obj.fragmotion.drive.start, obj.fragmotion.drive.relative = "ORIGIN", "CHARACTER"
    ground = obj.fragmotion.ground
    ground.kind, ground.collection = "COLLECTION", bpy.data.collections["Sample Grounds"]
    view = window.view()["area"].spaces.active.region_3d
    view.view_perspective, view.view_rotation = "PERSP", FROM_THE_SIDE.to_quaternion()
    view.view_location, view.view_distance = (BEFORE_THE_STAIRS[0], BEFORE_THE_STAIRS[1], 0.8), 6.0
    window.show_only("Drive", "Ground")
    yield from window.picture("1 chosen")
    window.press(bpy.ops.fragmotion.drive)
    session = window.module("drive.session")
    yield from window.seconds(0.5)
    yield from window.send("W", "PRESS", *MIDDLE)
    yield from window.until(lambda: session.current.player.ground_level > 0.6, "the stairs", 400)
    yield from window.picture("2 on the stairs")
    yield from window.until(lambda: session.current.player.ground_level > 0.99 * TOP_OF_THE_STAIRS, "the top", 400)
    assert (obj.matrix_world @ obj.pose.bones["hips"].matrix).translation.z > TOP_OF_THE_STAIRS + 0.7
    yield from window.send("W", "RELEASE", *MIDDLE)
    yield from window.send("ESC", "PRESS", *MIDDLE)
    assert session.current is None
    window.show_all()  # all that the add-on has registered


window.run(session_of_tests())
