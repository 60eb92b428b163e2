# SPDX-License-Identifier: MIT
"""Run in a Blender with a window by test_windows.py: a move is added in the sidebar, and started by its key.

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
MOVE = "jump up"


def choose(action: str) -> None:
    """Choose a take in the list under Mocap."""
    bpy.context.window_manager.fragmotion.active_action = bpy.data.actions.find(action)


def session_of_tests() -> Iterator[None]:
    """The whole session."""
    obj = making.open_sample()
    obj.fragmotion.moves.clear()
    yield from window.open_tab()
    bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=12)
    choose(MOVE)
    window.show_only("Mocap", "Moves")
    yield from window.drawn()
    window.press(bpy.ops.fragmotion.add_move)
    (move,) = obj.fragmotion.moves
    assert (move.name, move.key) == (MOVE, "F")
    yield from window.picture("1 moves")
    window.press(bpy.ops.fragmotion.drive)
    session = window.module("drive.session")
    yield from window.seconds(0.5)
    yield from window.send("F", "PRESS", *MIDDLE)
    yield from window.send("F", "RELEASE", *MIDDLE)
    yield from window.until(lambda: session.current.player.playing_moves[0] == 0, "the move")
    yield from window.until(lambda: obj.pose.bones["hips"].matrix.translation.z > 1.05, "the jump")
    yield from window.picture("2 jumping")
    yield from window.until(lambda: session.current.player.playing_moves[0] < 0, "the move's end")
    yield from window.send("ESC", "PRESS", *MIDDLE)
    assert session.current is None
    window.show_all()  # all that the add-on has registered


window.run(session_of_tests())
