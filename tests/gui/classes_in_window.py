# SPDX-License-Identifier: MIT
"""Run in a Blender with a window by test_classes.py: every state of the panels of the classes, and the preview.

Arguments after `--`: the add-on's zip, the folder for pictures.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "blender"))

import making
from window import TICK, open_tab, picture, press, run, send

ARMATURE = "Fragmotion Sample"
PATIENCE = 600  # ticks that a stopped trial may take to end
PARENTS: dict[str, str] = {}


def show_only(panels: list[Any], *labels: str) -> None:
    """Leave the panels with these labels in the tab, open, below their parents where these are shown too."""
    for panel in panels:
        if "bl_rna" in panel.__dict__:
            bpy.utils.unregister_class(panel)
    shown = [panel for panel in panels if panel.bl_label in labels]
    for panel in shown:
        parent = PARENTS.setdefault(panel.bl_idname, getattr(panel, "bl_parent_id", ""))
        panel.bl_parent_id = parent if parent in [other.bl_idname for other in shown] else ""
        panel.bl_options = set()
        bpy.utils.register_class(panel)


def seconds(count: float) -> Iterator[None]:
    """Let Blender run."""
    for _ in range(round(count / TICK)):
        yield


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
    for _ in range(PATIENCE):
        if build.current is None:
            break
        yield
    core.suggest_classes = suggest
    assert build.current is None and not obj.fragmotion.tried and obj.fragmotion.build.classes == number


def preview(solo: Any, obj: bpy.types.Object) -> Iterator[None]:
    """The preview plays until Esc, and everything is as before."""
    before, hips = making.contents(), obj.pose.bones["hips"]
    press(bpy.ops.fragmotion.solo_class)
    assert solo.current is not None and not bpy.ops.fragmotion.solo_class.poll()
    places = set()
    for _ in range(PATIENCE):
        places.add(tuple(value for row in hips.matrix for value in row))
        if len(places) > 5:
            break
        yield
    assert len(places) > 5, f"nothing moves: {len(places)}"
    yield from picture("6 preview")
    yield from send("Z", "PRESS", 300, 300)
    assert solo.current is not None, "a key got through"
    yield from send("ESC", "PRESS", 300, 300)
    assert solo.current is None and solo._timer is None
    assert making.contents() == before


def steps() -> Iterator[None]:
    """The whole session."""
    addon = import_module("fragmotion")
    panels = [cls for cls in addon.panel.CLASSES if issubclass(cls, bpy.types.Panel)]
    solo = import_module("fragmotion.operators.solo_class")
    bpy.ops.wm.open_mainfile(filepath=str(making.SAMPLE), load_ui=False)
    yield
    obj = bpy.data.objects[ARMATURE]
    making.activate(obj)
    show_only(panels, *(panel.bl_label for panel in panels))  # before they are first drawn, closed
    yield from open_tab()
    press(bpy.ops.fragmotion.tick_actions, "EXEC_DEFAULT", True, use=True)
    yield from stopped_trial(addon.building.core, import_module("fragmotion.operators.background"), obj)
    press(bpy.ops.fragmotion.suggest_classes, "EXEC_DEFAULT", True)
    press(bpy.ops.fragmotion.build, "EXEC_DEFAULT", True, synthesize=False)  # with holes in the coverage
    obj = bpy.data.objects[ARMATURE]
    manager = bpy.context.window_manager.fragmotion
    show_only(panels, "Build", "Numbers Tried")
    yield from picture("1 suggested")
    show_only(panels, "Coverage")
    yield from picture("2 coverage")
    icons = import_module("fragmotion.coverage_picture")._previews
    assert len(icons) == 9 and all(icon.icon_id > 0 for icon in icons.values())
    show_only(panels, "Classes")
    manager.active_class = 3
    rows = obj.fragmotion.classes
    rows[1].name, rows[2].excluded = "my own wave", True
    yield from picture("3 classes")
    show_only(panels, "Inspector")
    yield from picture("4 inspector")
    show_only(panels, "Mocap", "Left Out")
    take = next(action for action in bpy.data.actions if action.fragmotion.use)
    manager.active_action = bpy.data.actions.find(take.name)
    bpy.context.scene.use_preview_range = True
    bpy.context.scene.frame_preview_start, bpy.context.scene.frame_preview_end = 1, 12
    press(bpy.ops.fragmotion.leave_out, "EXEC_DEFAULT", True)
    yield from picture("5 left out")
    show_only(panels, "Classes", "Inspector")
    manager.active_class = next(number for number, row in enumerate(rows) if row.suggested.startswith("run"))
    yield from preview(solo, obj)

    player = addon.building.core.Player(addon.building.load(obj))
    addon.classes.session = SimpleNamespace(armature=obj.name, player=player, control=(0.0, 1.2, 0.0, 0.0))
    press(bpy.ops.fragmotion.force_class, "EXEC_DEFAULT")
    yield from picture("7 driving")
    player.step((0, 1.2, 0, 0), 0.2)
    assert player.playing[0] == manager.active_class
    addon.classes.session = None

    press(bpy.ops.fragmotion.solo_class)
    yield from seconds(0.3)
    bpy.ops.wm.open_mainfile(filepath=str(making.SAMPLE), load_ui=False)
    yield from seconds(0.2)
    assert solo.current is None and solo._timer is None, "a preview outlives its file"
    show_only(panels, *(panel.bl_label for panel in panels))
    print("SESSION PASSED")


run(steps())
