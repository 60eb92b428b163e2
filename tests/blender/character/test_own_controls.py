# SPDX-License-Identifier: MIT
"""A character with other controls than the paper's: built, kept, shown, explained, driven by what others recorded."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any

import bpy
import making
import numpy as np
import pytest

PLAIN = {"controls": "TOLD", "speeds": 1, "directions": "4", "turn": False, "jump": False}
FINE = {"controls": "TOLD", "speeds": 4, "directions": "16", "turn": True, "jump": True}


def build(**told: Any) -> bpy.types.Object:
    obj = making.open_sample()
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", True, classes=40, seconds=20, policy="greedy", **told) == {
        "FINISHED"
    }
    return obj


@pytest.mark.parametrize(("told", "controls"), [(PLAIN, 5), (FINE, 390)])
def test_build_gives_the_controls_that_it_is_told(
    addon: ModuleType, told: dict[str, Any], controls: int, tmp_path: Path
) -> None:
    obj = build(**told)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "own.blend"))
    addon.character.building.forget()
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "own.blend"))
    obj = bpy.context.view_layer.objects.active
    character, figures = addon.character.building.load(obj), obj.fragmotion.figures
    layouts = addon.character.control_layout
    assert figures.controls == controls == len(character.space.points) == character.table.shape[1]
    assert layouts.kept_layout(figures) == layouts.layout_of(character.space)
    assert layouts.kept_layout(figures).shape == character.space.shape
    assert np.prod(character.space.shape) == controls == sum(sum(row.total) for row in figures.coverage)
    done = sum(addon.compat.core.core.abilities(character))
    assert figures.performed == done == sum(sum(row.performed) for row in figures.coverage)
    assert 0 < figures.quality <= 100.001


def test_the_coverage_of_many_directions_is_by_their_angles(addon: ModuleType) -> None:
    coverage, layouts = addon.character.coverage, addon.character.control_layout
    for directions, counts in ((4, (1, 2, 1)), (8, (3, 2, 3)), (16, (5, 6, 5))):
        layout = layouts.ControlLayout(("stroll", "walk", "run"), directions, False, True)
        rows = coverage.measure_coverage(np.zeros(np.prod(layout.shape)), layout)
        assert [row.name for row in rows][:4] == ["Stand", "Stroll ahead", "Stroll aside", "Stroll back"]
        assert [row.total for row in rows][1:4] == [[count, 0, count] for count in counts]
        assert len(rows) == 10


@pytest.mark.thorough
def test_what_the_takes_lack_is_said(addon: ModuleType, capfd: pytest.CaptureFixture[str]) -> None:
    build(**FINE)
    said = capfd.readouterr().out
    assert "The takes hold 8 of the 16 directions: the rest is made of what there is" in said
    build()
    assert "The takes hold" not in capfd.readouterr().out


def test_found_controls_are_what_the_takes_hold(addon: ModuleType) -> None:
    obj = build(controls="FOUND", speeds=4)
    space = addon.character.building.load(obj).space
    assert addon.character.control_layout.say_lacking(addon.character.building.load(obj)) == ""
    assert space.turns and space.directions in (4, 8, 16) and len(space.speeds) < 4


def test_the_inspector_asks_for_the_nearest_control_there_is(addon: ModuleType) -> None:
    obj = build(**PLAIN)
    inspector, space = addon.character.inspector, addon.character.building.load(obj).space
    settings = bpy.context.window_manager.fragmotion.inspector
    for gait, direction, velocity in (("stand", "4", 0), ("sprint", "0", 1), ("stroll", "4", 2), ("walk", "13", 4)):
        settings.gait, settings.direction, settings.turn, settings.jump = gait, direction, "2", True
        decision = inspector.decision(obj, settings, 0)
        assert decision.control == velocity < len(space.points)
        assert inspector.explain(obj, decision)


def test_a_picture_has_a_dot_for_each_velocity(addon: ModuleType) -> None:
    drawing, layouts = addon.character.coverage_picture, addon.character.control_layout
    for gaits in (("walk",), ("walk", "jog", "run"), ("stroll", "walk", "jog", "run")):
        for directions in (4, 8, 16):
            layout = layouts.ControlLayout(gaits, directions)
            places = drawing.places(layout)
            apart = np.linalg.norm(places[:, None] - places, axis=2) + 9 * np.eye(len(places))
            assert len(places) == layout.shape[0] and apart.min() > 1.9 * drawing._dot(layout)
            assert np.abs(places).max() + drawing._dot(layout) <= 1.01
            picture = drawing.draw_controls(np.zeros(len(places)), layout)
            columns, rows = ((places.T + 1) / 2 * drawing.SIZE).astype(int)
            np.testing.assert_allclose(
                picture[rows, columns, :3], np.tile(drawing.colour_of(0), (len(places), 1)), atol=0.1
            )


class Layout:
    """What is drawn, as Blender's layouts are told it."""

    def __init__(self) -> None:
        self.labels: list[str] = []
        self.icons = 0

    def row(self, **_: Any) -> Layout:
        return self

    column = row

    def label(self, text: str, **_: Any) -> None:
        self.labels.append(text)

    def template_icon(self, *_: Any, **__: Any) -> None:
        self.icons += 1


@pytest.mark.parametrize(("turn", "jump", "pictures"), [(True, True, 6), (False, True, 2), (False, False, 1)])
def test_a_picture_is_drawn_for_each_turn_and_jump_there_is(
    addon: ModuleType, turn: bool, jump: bool, pictures: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    context = SimpleNamespace(preferences=SimpleNamespace(system=SimpleNamespace(ui_scale=1.0)))  # 0 without a window
    with_window = SimpleNamespace(context=context, utils=bpy.utils, types=bpy.types)
    monkeypatch.setattr(addon.character.coverage_picture, "bpy", with_window)
    controls = addon.character.control_layout.ControlLayout(("walk", "jog", "run"), 4, turn, jump)
    layout, stored = Layout(), np.zeros(controls.shape, np.float32).tobytes()
    addon.character.coverage_picture.draw_pictures(layout, stored, controls, 300.0)
    assert layout.icons == pictures and ("Turn left" in layout.labels) == turn and ("Jump" in layout.labels) == jump
    assert {"Inner circle: walk", "Next circle: jog", "Outer circle: run"} <= set(layout.labels)


@pytest.mark.parametrize(
    ("field", "value"), [("gaits", "gallop"), ("gaits", ""), ("gaits", "run, " * 9), ("directions", 5)]
)
def test_damaged_figures_draw_nothing(addon: ModuleType, field: str, value: Any) -> None:
    figures = SimpleNamespace(gaits="walk, run", directions=8, turn=True, jump=True)
    kept_layout = addon.character.control_layout.kept_layout
    assert kept_layout(figures) == addon.character.control_layout.ControlLayout()
    setattr(figures, field, value)
    assert kept_layout(figures) is None


@pytest.mark.thorough
def test_what_was_recorded_with_others_is_baked(addon: ModuleType, tmp_path: Path) -> None:
    core = addon.compat.core.core
    core.write_trace(tmp_path / "trace.csv", core.simulate_trace("explorer", 5, 1))
    for told in (PLAIN, FINE):
        obj = build(**told)
        bake = {"trace_source": "FILE", "trace_file": str(tmp_path / "trace.csv")}
        assert bpy.ops.fragmotion.bake("EXEC_DEFAULT", **bake) == {"FINISHED"}
        assert obj.animation_data.action is not None
