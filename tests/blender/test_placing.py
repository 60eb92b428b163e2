# SPDX-License-Identifier: MIT
"""A storyboard's + and Pin Here ask for their place by a click on the ground."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from types import ModuleType, SimpleNamespace
from typing import Any
from unittest.mock import MagicMock

import bpy
import numpy as np
import pytest
from test_modal_operators import Pressed, a_context

VIEW = SimpleNamespace(x=100, y=50)
GROUND = (3.0, 2.0, 0.5)


def event(kind: str, value: str = "PRESS", at: tuple[int, int] = (300, 200)) -> Any:
    return SimpleNamespace(
        type=kind, value=value, mouse_x=at[0], mouse_y=at[1], ctrl=False, alt=False, oskey=False, shift=False
    )


@pytest.fixture
def asked(addon: ModuleType, obj: bpy.types.Object, monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """A context of one 3D view of 400 by 300 pixels, the right quarter of which is a sidebar, over ground."""
    placing = addon.operators.base.placing
    area = MagicMock(type="VIEW_3D")
    free = SimpleNamespace(left=0, right=300, bottom=0, top=300)
    views = SimpleNamespace(
        areas_of=lambda _window: [area], window_region=lambda _area: VIEW, free_part=lambda _area: free
    )
    monkeypatch.setattr(placing, "views", views)
    monkeypatch.setattr(placing, "find_ground", lambda *_: None)
    monkeypatch.setattr(placing, "ground_under", lambda _area, x, y, _ground: GROUND if (x, y) == (200, 150) else None)
    for name in ("storyboard", "edit_recordings"):
        monkeypatch.setattr(import_module(f"{addon.__name__}.operators.directing.{name}"), "is_in_view", lambda _: True)
    bpy.context.scene.cursor.location = (0, 0, 0)
    yield a_context(area=area, mode="POSE")


def add_beat(addon: ModuleType) -> tuple[Pressed, Any]:
    operator = import_module(f"{addon.__name__}.operators.directing.storyboard").FRAGMOTION_OT_add_beat
    return Pressed(operator), operator


def check_given_back(context: Any) -> None:
    context.window.cursor_modal_restore.assert_called_once()
    context.workspace.status_text_set.assert_called_with(None)


def test_an_entry_is_put_where_the_ground_is_clicked(addon: ModuleType, obj: bpy.types.Object, asked: Any) -> None:
    pressed, operator = add_beat(addon)
    assert operator.invoke(pressed, asked, event("LEFTMOUSE")) == {"RUNNING_MODAL"}
    asked.window.cursor_modal_set.assert_called_once_with("CROSSHAIR")
    assert asked.workspace.status_text_set.call_args[0][0] is not None, "the status bar says what may be pressed"
    for other in (event("LEFTMOUSE", "RELEASE"), event("A")):
        assert operator.modal(pressed, asked, other) == {"RUNNING_MODAL"}
    assert operator.modal(pressed, asked, event("MIDDLEMOUSE")) == {"PASS_THROUGH"}, "the view can be turned"
    assert not len(obj.fragmotion.story)
    assert operator.modal(pressed, asked, event("LEFTMOUSE")) == {"FINISHED"}
    assert obj.fragmotion.story[0].place.location[:] == GROUND
    check_given_back(asked)


def test_the_sky_is_no_place_and_enter_takes_the_3d_cursor(
    addon: ModuleType, obj: bpy.types.Object, asked: Any
) -> None:
    pressed, operator = add_beat(addon)
    operator.invoke(pressed, asked, event("LEFTMOUSE"))
    assert operator.modal(pressed, asked, event("LEFTMOUSE", at=(301, 330))) == {"RUNNING_MODAL"}
    assert pressed.told == [
        ({"WARNING"}, "There is no ground under the mouse: click on it, or look from further above")
    ]
    bpy.context.scene.cursor.location = (1, 0, 0)
    assert operator.modal(pressed, asked, event("RET")) == {"FINISHED"}
    assert obj.fragmotion.story[0].place.location[:] == (1, 0, 0)


@pytest.mark.parametrize(
    ("ending", "result"),
    [
        (event("ESC"), {"CANCELLED"}),
        (event("RIGHTMOUSE"), {"CANCELLED"}),
        (event("LEFTMOUSE", at=(450, 200)), {"CANCELLED", "PASS_THROUGH"}),
        (event("LEFTMOUSE", at=(20, 20)), {"CANCELLED", "PASS_THROUGH"}),
    ],
)
def test_esc_or_a_click_elsewhere_places_nothing(
    addon: ModuleType, obj: bpy.types.Object, asked: Any, ending: Any, result: set[str]
) -> None:
    pressed, operator = add_beat(addon)
    operator.invoke(pressed, asked, event("LEFTMOUSE"))
    assert operator.modal(pressed, asked, ending) == result
    assert not len(obj.fragmotion.story) and bpy.context.scene.cursor.location[:] == (0, 0, 0)
    check_given_back(asked)


def test_a_pin_is_where_the_ground_is_clicked(addon: ModuleType, obj: bpy.types.Object, asked: Any) -> None:
    addon.recordings.recordings.add_recording(obj, np.tile([0, 1.2, 0, 0], (40, 1)).astype(float))
    operator = import_module(f"{addon.__name__}.operators.directing.edit_recordings").FRAGMOTION_OT_pin_recording
    started: list[tuple[float, ...]] = []
    pressed = Pressed(operator, place="PANEL", _start=lambda _: started.append(asked.scene.cursor.location[:]) or {"X"})
    assert operator.invoke(pressed, asked, event("LEFTMOUSE")) == {"RUNNING_MODAL"} and not started
    assert operator.modal(pressed, asked, event("LEFTMOUSE")) == {"X"}
    assert started == [GROUND]
    check_given_back(asked)
