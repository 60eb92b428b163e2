# SPDX-License-Identifier: MIT
"""Hands and eyes of the scripts that run in a Blender with a window: events, buttons and pictures, a tick at a time."""

from __future__ import annotations

import traceback
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import bpy

TICK = 0.02  # s between the steps of a script
_DRAWINGS = 4  # until all of a window shows what is new


def view() -> dict[str, Any]:
    """The 3D viewport, as an operator started by hand sees it."""
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    return {"window": window, "area": area, "region": region("WINDOW", area)}


def region(kind: str, area: bpy.types.Area | None = None) -> bpy.types.Region:
    """A region of the viewport."""
    return next(r for r in (area or view()["area"]).regions if r.type == kind)


def press(operator: Any, *mode: Any, **fields: Any) -> set[str]:
    """Start an operator as its button does."""
    with bpy.context.temp_override(**view()):
        result: set[str] = operator(*(mode or ("INVOKE_DEFAULT", True)), **fields)
    print(operator.idname_py(), result)
    return result


def picture(path: Path) -> Iterator[None]:
    """Let the window be drawn, and take a picture of it."""
    for _ in range(_DRAWINGS):
        for area in view()["window"].screen.areas:
            area.tag_redraw()
        yield
    with bpy.context.temp_override(**view()):
        bpy.ops.screen.screenshot(filepath=str(path))


def send(kind: str, value: str, x: int, y: int, **modifiers: bool) -> Iterator[None]:
    """One event of the mouse or the keyboard, handled before the next."""
    view()["window"].event_simulate(type=kind, value=value, x=x, y=y, **modifiers)
    yield


def click(x: int, y: int) -> Iterator[None]:
    """Move there and click."""
    yield from send("MOUSEMOVE", "NOTHING", x, y)
    yield from send("LEFTMOUSE", "PRESS", x, y)
    yield from send("LEFTMOUSE", "RELEASE", x, y)


def open_tab(height: int) -> Iterator[None]:
    """Show the sidebar and click our tab, whose middle is so many pixels below the sidebar's upper end."""
    with bpy.context.temp_override(**view()):  # after a file was loaded a script's context has no window
        view()["area"].spaces[0].show_region_ui = True
    yield
    yield
    sidebar = region("UI")
    yield from click(sidebar.x + sidebar.width - 13, sidebar.y + sidebar.height - height)


def run(script: Iterator[None]) -> None:
    """Go through the script a step a tick, print SESSION PASSED or the error, and quit."""

    def tick() -> float | None:
        try:
            next(script)
            return TICK
        except StopIteration:
            print("SESSION PASSED")
        except BaseException:
            traceback.print_exc()
        bpy.ops.wm.quit_blender()
        return None

    bpy.context.preferences.view.show_splash = False
    bpy.app.timers.register(tick, first_interval=1.0, persistent=True)
