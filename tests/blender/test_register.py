# SPDX-License-Identifier: MIT
"""Registering adds what the panel needs and unregistering leaves nothing."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from threading import Event
from types import ModuleType, SimpleNamespace
from typing import Any
from unittest.mock import MagicMock

import bpy
import making
import pytest
from registered import registered


def test_unregister_leaves_nothing_and_register_brings_it_back(addon: ModuleType) -> None:
    before = registered()
    assert {"FRAGMOTION_PT_build", "FRAGMOTION_OT_bake", "import_mocap", "Object", "Action"} <= before
    assert any(name.startswith("undo_pre: ") for name in before) and any("VIEW3D_MT_pose" in name for name in before)
    addon.unregister()
    try:
        assert registered() == set()
    finally:
        addon.register()
    assert registered() == before


@pytest.mark.skipif(not getattr(bpy.app, "module", False), reason="this Blender is a program")
def test_a_script_that_does_not_unregister_ends_well(addon: ModuleType) -> None:
    own = Path(addon.__file__ or "").parent
    places = [str(own.parent), str(Path(addon.compat.core.core.__file__).parent)]
    script = f"import sys; sys.path[:0] = {places}; import bpy, {own.name}; {own.name}.register(); print('the end')"
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False, timeout=100)
    assert done.returncode == 0 and "the end" in done.stdout, done.stderr


def test_unregister_stops_a_build_with_its_thread_and_timer(addon: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    timers: list[object] = []
    manager = SimpleNamespace(
        event_timer_add=lambda step, window: timers.append(step) or step, event_timer_remove=timers.remove
    )
    button, context = addon.operators.base.background, SimpleNamespace(window_manager=manager, workspace=None)
    monkeypatch.setattr(addon.preview.waking, "bpy", SimpleNamespace(context=context))
    started = Event()

    def work(report: Callable[[float, str], bool]) -> None:
        started.set()
        while report(0.5, "Working"):
            pass

    job = addon.jobs.Job("test", work)
    button._watch(SimpleNamespace(window_manager=manager, window=None), job)
    assert started.wait(60) and job.running and len(timers) == 1 and button.current is job
    addon.unregister()
    addon.register()
    assert not job.running and timers == [] and button.current is None


def test_every_operator_has_a_tooltip_and_undoes_what_it_changes(addon: ModuleType) -> None:
    own = [cls.bl_idname.partition(".")[2] for cls in addon.operators.CLASSES]
    assert {"import_mocap", "build", "suggest_classes", "force_class", "leave_out", "add_move", "bake"} <= set(own)
    unchanging = {"save_policy", "save_bones", "cancel", "export_recording", "solo_class", "force_class"}
    unchanging |= {"play_take", "export_to_game", "open_in_browser"}
    unchanging |= {"drive", "listen", "record", "play_trace", "find_pads", "change_style"}
    for name in own:
        operator = getattr(bpy.ops.fragmotion, name).get_rna_type()
        assert len(operator.description) > 20, name
        shown = [p for p in operator.properties if not (p.is_hidden or p.identifier == "rna_type")]
        assert all(p.description for p in shown), name
        cls = getattr(bpy.types, f"FRAGMOTION_OT_{name}")
        assert ("UNDO" in cls.bl_options) == (name not in unchanging), name


def test_the_tab_holds_the_panels_in_the_order_of_the_work(addon: ModuleType) -> None:
    panels = [cls for cls in addon.panels.panel.CLASSES if issubclass(cls, bpy.types.Panel)]
    assert [panel.bl_label for panel in panels] == [
        *("First Steps", "Control Rig", "Mocap", "Style", "Left Out", "Doctor", "Bones"),
        *("Build", "Build Options", "Numbers Tried", "Classes", "Coverage"),
        *("Advanced", "Training", "Figures", "Inspector", "Policy File"),
        *("Drive", "Drive Options", "Feel", "Ground", "Gamepads", "Overlays", "Trace"),
        *("Moves", "Path", "Storyboard", "Recordings", "Change", "Replay Options"),
        *("Bake", "Bake Options", "Advanced", "Populate", "Control Rig", "Game"),
    ]
    assert {panel.bl_category for panel in panels} == {"Fragmotion"}
    assert {(panel.bl_space_type, panel.bl_region_type) for panel in panels} == {("VIEW_3D", "UI")}


def fields_of(panel: Any) -> list[str]:
    """The names of those that a panel draws."""
    layout = MagicMock()
    layout.row.return_value = layout.column.return_value = layout
    panel.draw(SimpleNamespace(layout=layout), bpy.context)
    return [call.args[1] for call in layout.prop.call_args_list]


def test_the_choice_of_policy_is_folded_away_under_advanced(addon: ModuleType) -> None:
    obj, panels = making.open_sample(), addon.panels.panel
    advanced = panels.FRAGMOTION_PT_build_advanced
    assert advanced.bl_parent_id == panels.FRAGMOTION_PT_build.bl_idname and "DEFAULT_CLOSED" in advanced.bl_options
    assert fields_of(advanced) == ["policy", "cut", "seed"]
    for panel in (panels.FRAGMOTION_PT_build_options, panels.FRAGMOTION_PT_training):
        assert fields_of(panel) and not {"policy", "cut", "seed"} & set(fields_of(panel))
    items = obj.fragmotion.build.bl_rna.properties["policy"].enum_items
    assert items.keys() == ["anticipate", "iterate", "svm", "greedy"]
