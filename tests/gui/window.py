# SPDX-License-Identifier: MIT
"""What the scripts that run in a Blender with a window share. Their arguments after `--`: the add-on's zip, and the
folder for what they write and picture. Importing it installs the add-on."""

from __future__ import annotations

import subprocess
import sys
import time
import traceback
from collections import defaultdict
from collections.abc import Callable, Iterator
from importlib import import_module
from typing import Any

import bpy
import making

ZIP, FOLDER = sys.argv[sys.argv.index("--") + 1 :]
TICK = 0.05  # s
_TAB = 145  # pixels from the sidebar's top to our tab, the fourth and last, up to 4.1
_STEP = 9  # pixels; every button is higher than that

_places: dict[str, tuple[int, int]] = {}  # where buttons were
_parents: dict[str, str] = {}
ADDON = making.install(ZIP)


def module(name: str) -> Any:
    """One of the add-on's modules."""
    return import_module(f"{ADDON}.{name}")


def tell(text: str) -> None:
    """Print a figure that whoever runs the tests should read."""
    print(f"FIGURE {text}", flush=True)


def view() -> dict[str, Any]:
    """The 3D viewport, as an operator started by hand sees it."""
    return _region("WINDOW")


def sidebar() -> dict[str, Any]:
    """The viewport's sidebar, as an operator started there sees it."""
    return _region("UI")


def _region(kind: str) -> dict[str, Any]:
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    return {"window": window, "area": area, "region": next(r for r in area.regions if r.type == kind)}


def press(operator: Any, *mode: Any, **fields: Any) -> None:
    """Start an operator as its button does."""
    with bpy.context.temp_override(**view()):
        print(operator.idname_py(), operator(*(mode or ("INVOKE_DEFAULT", True)), **fields))


def drawn() -> Iterator[None]:
    """Let the viewport and its panel be drawn."""
    for _ in range(4):
        view()["area"].tag_redraw()
        yield


def seconds(count: float) -> Iterator[None]:
    """Let Blender run."""
    for _ in range(round(count / TICK)):
        yield


def until(done: Callable[[], bool], what: str, ticks: int = 1200) -> Iterator[None]:
    """Let Blender run until something is so."""
    for _ in range(ticks):
        if done():
            return
        yield
    raise AssertionError(f"waited in vain: {what}")


def picture(name: str) -> Iterator[None]:
    """Let the panel be drawn, and take a picture of the window."""
    yield from drawn()
    photograph(name)


def photograph(name: str) -> None:
    """A picture of the window as it is drawn."""
    path = f"{FOLDER}/{name}.png"
    if bpy.app.version >= (5, 0, 0):  # whose own picture of a window that is drawn by software is black
        subprocess.run(["import", "-window", "root", path], check=True)
        return
    with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
        bpy.ops.screen.screenshot(filepath=path)


def send(kind: str, value: str, x: int, y: int, **modifiers: bool) -> Iterator[None]:
    """One event of the mouse or the keyboard, handled before the next."""
    view()["window"].event_simulate(type=kind, value=value, x=x, y=y, **modifiers)
    yield


def click(x: int, y: int) -> Iterator[None]:
    """Move the mouse there and click."""
    for kind, value in (("MOUSEMOVE", "NOTHING"), ("LEFTMOUSE", "PRESS"), ("LEFTMOUSE", "RELEASE")):
        yield from send(kind, value, x, y)


def click_button(name: str) -> Iterator[None]:
    """Click the sidebar's button of that operator ("fragmotion.record") or property ("follow"), wherever it stands."""
    region = sidebar()["region"]
    columns, rows = (4, 2), range(region.y + region.height - _STEP, region.y, -_STEP)
    anywhere = ((region.x + region.width // column, y) for column in columns for y in rows)
    for x, y in (*([_places[name]] if name in _places else []), *anywhere):
        yield from send("MOUSEMOVE", "NOTHING", x, y)
        if _hovered() == name:
            _places[name] = x, y
            yield from click(x, y)
            yield from send("MOUSEMOVE", "NOTHING", 300, 300)
            return
    raise AssertionError(f"the sidebar has no button of {name}")


def _hovered() -> str:
    """What the button under the mouse is of; empty where there is none."""
    manager = bpy.context.window_manager
    with bpy.context.temp_override(**sidebar()):
        for copy in (bpy.ops.ui.copy_python_command_button, bpy.ops.ui.copy_data_path_button):
            if copy.poll():
                copy()
                text: str = manager.clipboard
                return text.removeprefix("bpy.ops.").partition("(")[0] if "(" in text else text.rpartition(".")[2]
    return ""


def says_keys() -> bool:
    """Whether the status bar is drawn by the add-on."""
    return ADDON in bpy.types.STATUSBAR_HT_header.draw.__module__


def panels() -> list[Any]:
    """The add-on's panels, in the order of the sidebar."""
    return [cls for cls in module("panels.panel").CLASSES if issubclass(cls, bpy.types.Panel)]


def show_only(*labels: str) -> None:
    """Leave the panels with these labels in the tab, open, below their parents where these are shown too; what Build
    folds away is shown."""
    settings = bpy.context.window_manager.fragmotion
    settings.show_mocap = settings.show_build = True
    for panel in panels():
        if "bl_rna" in panel.__dict__:
            bpy.utils.unregister_class(panel)
    shown = [panel for panel in panels() if panel.bl_label in labels]
    for panel in shown:
        parent = _parents.setdefault(panel.bl_idname, getattr(panel, "bl_parent_id", ""))
        panel.bl_parent_id = parent if parent in [other.bl_idname for other in shown] else ""
        panel.bl_options = set()
        bpy.utils.register_class(panel)


def show_all() -> None:
    """Have all the panels in the tab, open."""
    show_only(*(panel.bl_label for panel in panels()))


def watch_panels() -> dict[str, list[float]]:
    """What each draw of each panel takes from now on, s, by the panel's label; its list and its poll belong to it."""
    costs: dict[str, list[float]] = defaultdict(list)
    for panel in panels():
        panel.draw = _watched(panel.draw, panel, costs[panel.bl_label])
    return costs


def _watched(draw: Callable[..., None], panel: Any, costs: list[float]) -> Callable[..., None]:
    def watched(self: Any, context: bpy.types.Context) -> None:
        begin = time.perf_counter()
        getattr(panel, "poll", bool)(context)
        draw(self, context)
        costs.append(time.perf_counter() - begin)

    return watched


def open_tab() -> Iterator[None]:
    """Show the sidebar, all its panels open, and click the lowest of its tabs: ours."""
    show_all()  # before they are first drawn, and closed
    with bpy.context.temp_override(**view()):  # after a file was loaded a script's context has no window
        view()["area"].spaces[0].show_region_ui = True
    yield
    yield
    region = sidebar()["region"]
    if bpy.app.version >= (4, 2, 0):
        region.active_panel_category = "Fragmotion"
    else:
        yield from click(region.x + region.width - 13, region.y + region.height - _TAB)
    yield from send("MOUSEMOVE", "NOTHING", 300, 300)


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


def count_timers() -> Iterator[None]:
    """Count anew the timer events of half a second; the counting operator runs already."""
    TEST_OT_count_timers.count = 0
    yield from seconds(0.5)


def run(session: Iterator[None]) -> None:
    """Go one step of the session on each tick, quit at its end, and say whether it came there."""

    def tick() -> float | None:
        try:
            next(session)
        except StopIteration:
            print("SESSION PASSED", flush=True)
        except BaseException:
            traceback.print_exc()
        else:
            return TICK
        bpy.ops.wm.quit_blender()
        return None

    bpy.context.preferences.view.show_splash = False
    bpy.context.preferences.system.viewport_aa = "OFF"  # drawn by software, it takes most of the time
    bpy.utils.register_class(TEST_OT_count_timers)
    bpy.app.timers.register(tick, first_interval=1.0, persistent=True)
