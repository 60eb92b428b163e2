# SPDX-License-Identifier: MIT
"""Run in a Blender with a window by test_windows.py: import, build, cancel, bake and disable while the panel is drawn.

Arguments after `--`: the add-on's zip, the folder for takes and pictures.
"""

from __future__ import annotations

import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "blender"))

import making
import window
from window import FOLDER, TEST_OT_count_timers, count_timers, open_tab, picture, press, run, seconds, send, until

FIELDS = {"classes": 12, "seconds": 20.0}
SECOND_TAKE, NAME, TICK_BOX = 97, 80, 29  # pixels from the sidebar's top, and from its left side


def hold_builds(core: Any) -> threading.Event:
    """Let the core's builds stand at 40 % until the event is set, so that there is time to press buttons."""
    event, build = threading.Event(), core.build

    def held_build(*arguments: Any) -> Any:
        while not event.wait(0.01):
            if not arguments[4](0.4, "Clustering"):
                raise core.Cancelled("cancelled")
        return build(*arguments)

    core.build = held_build
    return event


def finish_build(build: Any) -> Iterator[None]:
    """Wait for the build that runs."""
    yield from until(lambda: build.current is None, "the end of the build")


def disable_while_building(build: Any) -> Iterator[None]:
    """Switching the add-on off stops the build's thread and its timer."""
    press(bpy.ops.test.count_timers)
    press(bpy.ops.fragmotion.build, **FIELDS)
    assert build.current.running
    yield from count_timers()
    assert TEST_OT_count_timers.count > 0, "the timers of a build are not heard"
    bpy.ops.preferences.addon_disable(module=window.ADDON)
    assert all(thread.name != "Fragmotion" for thread in threading.enumerate()), "the build goes on"
    yield from count_timers()
    assert TEST_OT_count_timers.count == 0, "the build's timer goes on"


def play_takes(obj: bpy.types.Object) -> Iterator[None]:
    """Play shows the chosen take, and what is chosen and ticked meanwhile; Esc gives everything back."""
    shown, manager = window.module("preview.previews"), bpy.context.window_manager.fragmotion
    before, hips = making.contents(), obj.pose.bones["Hips"]
    manager.active_action = bpy.data.actions.find("take 1")
    yield from window.click_button("fragmotion.play_take")
    pose = hips.matrix_basis.copy()
    yield from until(lambda: hips.matrix_basis != pose, "a take that plays")
    yield from picture("2 playing")
    region, take = window.sidebar()["region"], bpy.data.actions["take 2"]
    y = region.y + region.height - SECOND_TAKE
    yield from window.click(region.x + NAME, y)
    yield from until(lambda: shown.current.name == f"Take '{take.name}'", "the take that is clicked meanwhile")
    for use in (False, True):
        yield from window.click(region.x + TICK_BOX, y)
        yield from until(lambda use=use: take.fragmotion.use is use, "a tick while the take plays", 40)
        assert shown.current is not None, "a tick ends the take"
        yield from seconds(1)
    yield from send("SPACE", "PRESS", 300, 300)
    assert shown.current is not None and not bpy.context.screen.is_animation_playing, "a key got through"
    yield from send("ESC", "PRESS", 300, 300)
    assert shown.current is None and making.contents() == before


def steps() -> Iterator[None]:
    """The whole session."""
    build = window.module("operators.base.background")
    building = window.module("character.building")
    go_on = hold_builds(building.core)
    bpy.data.objects.remove(bpy.data.objects["Cube"])
    yield from open_tab()
    yield from picture("1 empty")
    window.module("settings.preferences").end_first_steps(bpy.context)
    takes = Path(FOLDER) / "takes"
    takes.mkdir()
    for seed in (1, 2, 3):
        making.write_bvh(takes / f"take {seed}.bvh", frames=150, seed=seed)
    press(bpy.ops.fragmotion.import_mocap, "EXEC_DEFAULT", True, directory=str(takes))
    yield from picture("2 imported")
    obj = bpy.context.view_layer.objects.active

    yield from play_takes(obj)
    press(bpy.ops.fragmotion.build, **FIELDS)
    assert build.current is not None, "the build does not run in the background"
    yield from send("ESC", "PRESS", 300, 300)
    yield from finish_build(build)
    assert not building.has_character(obj), "Esc did not stop the build"

    press(bpy.ops.fragmotion.build, **FIELDS)
    press(bpy.ops.fragmotion.cancel)
    yield from finish_build(build)
    assert not building.has_character(obj), "Cancel did not stop the build"

    press(bpy.ops.fragmotion.build, **FIELDS)
    yield from picture("3 building")
    assert window.says_keys(), "the status bar does not say how far it is"
    assert 0 < build.current.fraction < 0.5 and build.current.stage == "Clustering"
    assert not bpy.ops.fragmotion.build.poll(), "two builds at once"
    go_on.set()
    yield from finish_build(build)
    assert not window.says_keys()
    assert obj.fragmotion.figures.classes == FIELDS["classes"], "the build left nothing"
    yield from picture("4 built")
    press(bpy.ops.fragmotion.bake, seconds=2.0)
    assert obj.animation_data.action.name == f"{obj.name} Bake"
    yield from picture("5 baked")

    bpy.ops.ed.undo()
    bpy.ops.ed.undo()
    obj = bpy.context.view_layer.objects.active
    assert not building.has_character(obj), "Bake and Build are not one undo step each"
    go_on.clear()
    yield from disable_while_building(build)


run(steps())
