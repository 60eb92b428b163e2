# SPDX-License-Identifier: MIT
"""What the scripts that run in a Blender with a window share. Their arguments after `--`: the add-on's zip, and the
folder for what they write and picture."""

from __future__ import annotations

import sys
import traceback
from collections.abc import Iterator
from typing import Any

import bpy

ZIP, FOLDER = sys.argv[sys.argv.index("--") + 1 :]
TICK = 0.05  # s


def view() -> dict[str, Any]:
    """The 3D viewport, as an operator started by hand sees it."""
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    return {"window": window, "area": area, "region": next(r for r in area.regions if r.type == "WINDOW")}


def press(operator: Any, *mode: Any, **fields: Any) -> None:
    """Start an operator as its button does."""
    with bpy.context.temp_override(**view()):
        print(operator.idname_py(), operator(*(mode or ("INVOKE_DEFAULT", True)), **fields))


def drawn() -> Iterator[None]:
    """Let the viewport and its panel be drawn."""
    for _ in range(4):
        view()["area"].tag_redraw()
        yield


def picture(name: str) -> Iterator[None]:
    """Let the panel be drawn, and take a picture of the window."""
    yield from drawn()
    with bpy.context.temp_override(**view()):
        bpy.ops.screen.screenshot(filepath=f"{FOLDER}/{name}.png")


def send(kind: str, value: str, x: int, y: int, **modifiers: bool) -> Iterator[None]:
    """One event of the mouse or the keyboard, handled before the next."""
    view()["window"].event_simulate(type=kind, value=value, x=x, y=y, **modifiers)
    yield


def click(x: int, y: int) -> Iterator[None]:
    """Move the mouse there and click."""
    for kind, value in (("MOUSEMOVE", "NOTHING"), ("LEFTMOUSE", "PRESS"), ("LEFTMOUSE", "RELEASE")):
        yield from send(kind, value, x, y)


def open_tab() -> Iterator[None]:
    """Show the sidebar and click the lowest of its tabs, ours: the only one below those of a view without an object."""
    with bpy.context.temp_override(**view()):  # after a file was loaded a script's context has no window
        view()["area"].spaces[0].show_region_ui = True
    yield
    yield
    sidebar = next(region for region in view()["area"].regions if region.type == "UI")
    if bpy.app.version >= (4, 2, 0):
        sidebar.active_panel_category = "Fragmotion"
    else:
        yield from click(sidebar.x + sidebar.width - 13, sidebar.y + sidebar.height - 145)
    yield from send("MOUSEMOVE", "NOTHING", 300, 300)


def install() -> None:
    """Install and enable the add-on as the preferences do."""
    bpy.ops.preferences.addon_install(filepath=ZIP)
    bpy.ops.preferences.addon_enable(module="fragmotion")


def run(session: Iterator[None]) -> None:
    """Install the add-on unless it is, go one step of the session on each tick, and quit at its end."""

    def tick() -> float | None:
        try:
            next(session)
        except BaseException as end:
            if not isinstance(end, StopIteration):
                traceback.print_exc()
            bpy.ops.wm.quit_blender()
            return None
        return TICK

    bpy.context.preferences.view.show_splash = False
    if "fragmotion" not in bpy.context.preferences.addons:
        install()
    bpy.app.timers.register(tick, first_interval=1.0, persistent=True)
