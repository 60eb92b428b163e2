# SPDX-License-Identifier: MIT
"""Run in a Blender with a window by test_windows.py: a character is built in several styles, which keys and a button
change.

Arguments after `--`: the add-on's zip, the folder for pictures.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "blender"))

import making
import window

MIDDLE = (600, 400)
NAMES = ["neutral", "proud", "tired"]


def tap(key: str) -> Iterator[None]:
    """Press a key over the view, and let it go."""
    yield from window.send(key, "PRESS", *MIDDLE)
    yield from window.send(key, "RELEASE", *MIDDLE)


def session_of_tests() -> Iterator[None]:
    """The whole session."""
    obj = making.open_sample()
    yield from window.open_tab()
    window.press(bpy.ops.fragmotion.tick_actions, use=True)
    bpy.context.window_manager.fragmotion.active_action = bpy.data.actions.find("tired stand")
    window.show_only("Mocap")
    yield from window.picture("1 takes")
    bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=12)
    assert [row.name for row in obj.fragmotion.figures.styles] == NAMES
    obj.fragmotion.figures.shown_style = str(NAMES.index("tired"))
    window.show_only("Coverage")
    yield from window.picture("2 coverage")
    bpy.context.window_manager.fragmotion.active_class = 3
    window.show_only("Classes", "Inspector")
    yield from window.picture("2 classes")
    window.show_only("Drive")
    yield from window.drawn()
    window.press(bpy.ops.fragmotion.drive)
    player = window.module("drive.session").current.player
    yield from window.send("W", "PRESS", *MIDDLE)
    yield from window.seconds(1)
    yield from tap("LEFT_BRACKET")
    yield from window.until(lambda: player.playing_style == NAMES.index("tired"), "the style before the first")
    yield from window.seconds(0.6)
    yield from window.picture("3 tired")
    obj.fragmotion.figures.shown_style = str(NAMES.index("proud"))
    window.show_only("Inspector")
    yield from window.picture("3 inspector")
    window.show_only("Drive")
    yield from tap("RIGHT_BRACKET")
    yield from window.until(lambda: player.playing_style == 0, "the next style")
    window.press(bpy.ops.fragmotion.change_style, style=1)
    yield from window.until(lambda: player.playing_style == 1, "the style of the button")
    window.press(bpy.ops.fragmotion.change_style, style=0)
    yield from window.until(lambda: player.playing_style == 0, "the first style")
    yield from window.picture("4 neutral")
    yield from window.send("W", "RELEASE", *MIDDLE)
    yield from window.send("ESC", "PRESS", *MIDDLE)
    assert window.module("drive.session").current is None
    window.show_all()  # all that the add-on has registered


window.run(session_of_tests())
