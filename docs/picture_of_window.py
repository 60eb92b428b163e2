# SPDX-License-Identifier: MIT
"""Picture Blender's window with the add-on's tab beside the demo's character, for the README. It needs a screen:

xvfb-run -s "-screen 0 1280x1040x24" blender --factory-startup --enable-event-simulate --window-geometry 0 0 1280 1040 \
    --python docs/picture_of_window.py -- build/packages/LEGACY.zip [DEMO_FOLDER]
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

import bpy

DOCS = Path(__file__).resolve().parent
TICK = 0.5  # s between steps, so that the window is drawn
FRAME = 196
TAB = (1267, 780)  # the Fragmotion tab, pixels from the lower left


def largest_area(window: bpy.types.Window) -> bpy.types.Area:
    """The 3D viewport."""
    return max(window.screen.areas, key=lambda area: area.width * area.height)


def open_demo(package: str, demo: Path) -> None:
    """Install the add-on and open what the demo saved."""
    bpy.context.preferences.view.show_splash = False
    bpy.ops.preferences.addon_install(filepath=package)
    bpy.ops.preferences.addon_enable(module="fragmotion")
    bpy.ops.wm.open_mainfile(filepath=str(demo / "fragmotion_demo.blend"), load_ui=False)


def frame_character(window: bpy.types.Window) -> None:
    """The viewport alone, with its sidebar, the character in the middle."""
    area = largest_area(window)
    space = area.spaces.active
    space.show_region_ui, space.overlay.show_extras, space.overlay.show_cursor = True, False, False
    bpy.context.scene.frame_set(FRAME)
    armature = bpy.context.view_layer.objects.active
    space.region_3d.view_location = armature.matrix_world @ armature.pose.bones["hips"].head
    space.region_3d.view_distance = 4.5
    with bpy.context.temp_override(window=window, area=area):
        bpy.ops.screen.screen_full_area(use_hide_panels=False)


def steps(package: str, demo: Path) -> Iterator[None]:
    """Install, open, show the tab, take the picture, quit."""
    open_demo(package, demo)
    yield
    frame_character(bpy.context.window_manager.windows[0])
    yield
    window = bpy.context.window_manager.windows[0]
    for kind, value in (("MOUSEMOVE", "NOTHING"), ("LEFTMOUSE", "PRESS"), ("LEFTMOUSE", "RELEASE")):
        window.event_simulate(type=kind, value=value, x=TAB[0], y=TAB[1])
        yield
    window.event_simulate(type="MOUSEMOVE", value="NOTHING", x=300, y=300)
    yield
    with bpy.context.temp_override(window=window, area=largest_area(window)):
        bpy.ops.screen.screenshot(filepath=str(DOCS / "panel.png"))
    bpy.ops.wm.quit_blender()


def main() -> None:
    """Take one step a tick."""
    package, *rest = sys.argv[sys.argv.index("--") + 1 :]
    demo = Path(rest[0]).resolve() if rest else DOCS.parent / "build" / "demo"
    work = steps(package, demo)

    def tick() -> float | None:
        return TICK if next(work, "done") is None else None

    bpy.app.timers.register(tick, first_interval=TICK, persistent=True)


main()
