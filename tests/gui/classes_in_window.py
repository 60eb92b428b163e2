# SPDX-License-Identifier: MIT
"""Run in a Blender with a window by test_windows.py: every state of the panels of the classes, and the preview.

Arguments after `--`: the add-on's zip, the folder for pictures.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "blender"))

import making
import window
from window import open_tab, picture, press, run, seconds, send, show_all, show_only, until


def stopped_trial(core: Any, build: Any, obj: bpy.types.Object) -> Iterator[None]:
    """Suggest, whose trial stands at 40 %, runs in the background, and Esc stops it."""
    number, suggest = obj.fragmotion.build.classes, core.suggest_classes

    def stand(*arguments: Any) -> None:
        while arguments[4](0.4, "Clustering"):
            time.sleep(0.01)
        raise core.Cancelled("cancelled")

    core.suggest_classes = stand
    press(bpy.ops.fragmotion.suggest_classes)
    assert build.current is not None, "Suggest does not run in the background"
    yield from picture("0 trying")
    yield from send("ESC", "PRESS", 300, 300)
    yield from until(lambda: build.current is None, "the end of the trial")
    core.suggest_classes = suggest
    assert not obj.fragmotion.tried and obj.fragmotion.build.classes == number


def preview(obj: bpy.types.Object) -> Iterator[None]:
    """The preview plays until Esc, and everything is as before."""
    before, hips = making.contents(), obj.pose.bones["hips"]
    previews, waking = window.module("preview.previews"), window.module("preview.waking")
    press(bpy.ops.fragmotion.solo_class)
    assert previews.current is not None and not bpy.ops.fragmotion.build.poll()
    places: list[tuple[float, ...]] = []
    begin, step = time.perf_counter(), previews.current.step

    def noted(since: float) -> None:
        step(since)
        places.append(tuple(value for row in hips.matrix_basis for value in row))

    previews.current.step = noted
    yield from until(lambda: len(places) > 20, "a preview that goes on")
    assert len(set(places)) > 3, "nothing moves"
    window.tell(f"preview: {len(places) / (time.perf_counter() - begin):.1f} poses a second in this window")
    yield from picture("6 preview")
    yield from send("Z", "PRESS", 300, 300)
    assert previews.current is not None, "a key got through"
    yield from send("ESC", "PRESS", 300, 300)
    assert previews.current is None and not waking._timers
    assert making.contents() == before


def steps() -> Iterator[None]:
    """The whole session."""
    building, classes = window.module("character.building"), window.module("character.classes")
    previews, waking = window.module("preview.previews"), window.module("preview.waking")
    bpy.ops.wm.open_mainfile(filepath=str(making.SAMPLE), load_ui=False)
    yield
    obj = bpy.data.objects[making.ARMATURE]
    making.activate(obj)
    yield from open_tab()
    yield from stopped_trial(building.core, window.module("operators.base.background"), obj)
    press(bpy.ops.fragmotion.suggest_classes, "EXEC_DEFAULT", True)
    press(bpy.ops.fragmotion.build, "EXEC_DEFAULT", True, synthesize=False)  # with holes in the coverage
    obj = bpy.data.objects[making.ARMATURE]
    manager = bpy.context.window_manager.fragmotion
    show_only("Build", "Numbers Tried")
    yield from picture("1 suggested")
    show_only("Coverage")
    yield from picture("2 coverage")
    icons = window.module("character.coverage_picture")._previews
    assert len(icons) == 9 and all(icon.icon_id > 0 for icon in icons.values())
    show_only("Classes")
    manager.active_class = 3
    rows = obj.fragmotion.classes
    rows[1].name, rows[2].excluded = "my own wave", True
    yield from picture("3 classes")
    show_only("Inspector")
    yield from picture("4 inspector")
    show_only("Mocap", "Left Out")
    take = next(action for action in bpy.data.actions if action.fragmotion.use)
    manager.active_action = bpy.data.actions.find(take.name)
    bpy.context.scene.use_preview_range = True
    bpy.context.scene.frame_preview_start, bpy.context.scene.frame_preview_end = 1, 12
    press(bpy.ops.fragmotion.leave_out, "EXEC_DEFAULT", True)
    yield from picture("5 left out")
    show_only("Classes", "Inspector")
    manager.active_class = next(number for number, row in enumerate(rows) if row.suggested.startswith("run"))
    yield from preview(obj)

    player = building.core.Player(building.load(obj))
    classes.session = SimpleNamespace(armature=obj.name, player=player, control=(0.0, 1.2, 0.0, 0.0))
    press(bpy.ops.fragmotion.force_class, "EXEC_DEFAULT")
    yield from picture("7 driving")
    player.step((0, 1.2, 0, 0), 0.2)
    assert player.playing[0] == manager.active_class
    classes.session = None

    press(bpy.ops.fragmotion.solo_class)
    yield from seconds(0.3)
    bpy.ops.wm.open_mainfile(filepath=str(making.SAMPLE), load_ui=False)
    yield from seconds(0.2)
    assert previews.current is None and not waking._timers, "a preview outlives its file"

    making.activate(bpy.data.objects[making.ARMATURE])
    press(bpy.ops.fragmotion.build, "EXEC_DEFAULT", True, synthesize=False)
    press(bpy.ops.fragmotion.solo_class)
    bpy.data.objects.remove(bpy.data.objects[making.ARMATURE])
    yield from until(lambda: previews.current is None, "the end of a preview without its armature", 40)
    assert not waking._timers
    show_all()


run(steps())
