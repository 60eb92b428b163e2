# SPDX-License-Identifier: MIT
"""Whatever goes wrong in an operator that holds something open, it lets go of it and says what went wrong."""

from __future__ import annotations

import sys
from importlib import import_module
from types import MethodType, ModuleType, SimpleNamespace
from typing import Any
from unittest.mock import MagicMock

import bpy
import making
import numpy as np
import pytest
from driving import everything, go_on

INJECTED = "injected"


class Pressed:
    """Runs an operator's methods without a window, where Blender makes no operator."""

    def __init__(self, operator: type, **fields: Any) -> None:
        self._operator, self.told = operator, []
        for name, value in fields.items():
            setattr(self, name, value)

    def __getattr__(self, name: str) -> Any:
        value = getattr(self._operator, name)
        return MethodType(value, self) if callable(value) and not isinstance(value, type) else value

    def report(self, kind: set[str], text: str) -> None:
        self.told.append((kind, text))


def fail(*_arguments: Any, **_fields: Any) -> Any:
    raise ZeroDivisionError(INJECTED)


def part(addon: ModuleType, name: str) -> Any:
    return import_module(f"{addon.__name__}.{name}")


def operators(addon: ModuleType) -> list[type]:
    """Those of the add-on."""
    prefix = f"{addon.__name__}.operators."
    modules = [module for name, module in sorted(sys.modules.items()) if name.startswith(prefix)]
    found = {each for module in modules for each in vars(module).values() if isinstance(each, type)}
    return [each for each in found if issubclass(each, bpy.types.Operator) and each is not bpy.types.Operator]


def a_context(**fields: Any) -> Any:
    """Blender's, with a window that takes everything."""
    context = bpy.context
    shown = {"scene": context.scene, "view_layer": context.view_layer, "preferences": context.preferences}
    shown |= {"active_object": context.view_layer.objects.active, "object": context.view_layer.objects.active}
    shown |= {"evaluated_depsgraph_get": context.evaluated_depsgraph_get, "area": None, "mode": "OBJECT"}
    return SimpleNamespace(window_manager=MagicMock(), window=MagicMock(), workspace=MagicMock(), **{**shown, **fields})


EVENT = SimpleNamespace(type="TIMER", value="NOTHING", ctrl=False, alt=False, oskey=False, shift=False)


def test_every_operator_that_listens_lets_go_on_any_error(addon: ModuleType) -> None:
    listening = [each for each in operators(addon) if hasattr(each, "modal")]
    assert len(listening) > 6
    open_ended = [
        f"{operator.__name__}.{method}"
        for operator in listening
        for method in ("invoke", "modal")
        if not getattr(getattr(operator, method), "ends_on_error", False)
    ]
    assert not open_ended


@pytest.fixture
def recording(addon: ModuleType, session: ModuleType) -> Any:
    """Four seconds of an armature that slides."""
    obj = making.add_armature()
    bpy.context.view_layer.update()
    return part(addon, "recordings.recordings").add_recording(obj, np.tile((0, 1.0, 0, 0), (40, 1)))


def drive(addon: ModuleType, source: str) -> Pressed:
    fields = {"source": source, "recording": 0, "seed": -1, "policy": ""}
    return Pressed(part(addon, "operators.directing.drive").FRAGMOTION_OT_drive, **fields)


def check_over(addon: ModuleType, session: ModuleType, pressed: Pressed, before: dict[str, Any]) -> None:
    assert session.current is None and addon.character.classes.session is None and not addon.preview.waking._timers
    assert everything(bpy.data.objects["Rig"]) == before
    ((kind, text),) = pressed.told
    assert kind == {"ERROR"} and INJECTED in text


@pytest.mark.parametrize("source", ["INPUTS", "RECORDING", "OVER"])
@pytest.mark.parametrize("place", ["Readings", "overlays.add", "suspended_state.reset_pose", "wake", "external_motion"])
def test_an_error_while_a_drive_begins_ends_it(
    addon: ModuleType,
    session: ModuleType,
    recording: Any,
    monkeypatch: pytest.MonkeyPatch,
    source: str,
    place: str,
) -> None:
    bpy.context.scene.frame_set(2)
    before, button = everything(bpy.data.objects["Rig"]), part(addon, "operators.directing.drive")
    owners = {
        "suspended_state.reset_pose": addon.preview.suspended_state,
        "wake": addon.operators.base.woken,
        "external_motion": button,
        "overlays.add": session.overlays,
    }
    monkeypatch.setattr(owners.get(place, session), place.rpartition(".")[2], fail)
    pressed = drive(addon, source)
    assert button.FRAGMOTION_OT_drive.invoke(pressed, a_context(), EVENT) == {"CANCELLED"}
    check_over(addon, session, pressed, before)


@pytest.mark.parametrize("source", ["INPUTS", "RECORDING", "OVER"])
@pytest.mark.parametrize("place", ["update", "trouble"])
def test_an_error_while_a_drive_goes_on_ends_it(
    addon: ModuleType,
    session: ModuleType,
    recording: Any,
    monkeypatch: pytest.MonkeyPatch,
    source: str,
    place: str,
) -> None:
    bpy.context.scene.frame_set(2)
    before, button = everything(bpy.data.objects["Rig"]), part(addon, "operators.directing.drive")
    monkeypatch.setattr(addon.operators.base.woken, "wake", lambda *_: None)
    pressed = drive(addon, source)
    assert button.FRAGMOTION_OT_drive.invoke(pressed, a_context(), EVENT) == {"RUNNING_MODAL"}
    go_on(session.current, 0.3)
    assert everything(bpy.data.objects["Rig"]) != before
    monkeypatch.setattr(session.current, place, fail)
    assert button.FRAGMOTION_OT_drive.modal(pressed, a_context(), EVENT) == {"CANCELLED"}
    check_over(addon, session, pressed, before)


@pytest.mark.parametrize("place", ["inputs.close", "_follow.release", "_keep_recording", "_state.restore"])
def test_all_is_given_back_whatever_fails_of_it(
    session: ModuleType, monkeypatch: pytest.MonkeyPatch, place: str
) -> None:
    obj = making.add_armature()
    before = everything(obj)
    driven = session.start(bpy.context, obj)
    go_on(driven, 0.2)
    owner, _, name = place.rpartition(".")
    monkeypatch.setattr(getattr(driven, owner) if owner else driven, name, fail)
    with pytest.raises(ZeroDivisionError):
        session.stop()
    assert session.current is None and everything(obj) == before


def test_an_error_in_record_ends_the_drive_and_a_wrong_trace_does_not(
    addon: ModuleType, session: ModuleType, monkeypatch: pytest.MonkeyPatch
) -> None:
    obj, button = making.add_armature(), part(addon, "operators.directing.drive")
    before = everything(obj)
    session.start(bpy.context, obj)
    monkeypatch.setattr(button, "make_trace", lambda *_: (_ for _ in ()).throw(addon.errors.UserError("no file")))
    pressed = Pressed(button.FRAGMOTION_OT_play_trace)
    assert button.FRAGMOTION_OT_play_trace.execute(pressed, a_context()) == {"CANCELLED"}
    assert session.current is not None and pressed.told == [({"ERROR"}, "no file")]
    monkeypatch.setattr(session.current, "toggle_recording", fail)
    pressed = Pressed(button.FRAGMOTION_OT_record)
    assert button.FRAGMOTION_OT_record.execute(pressed, a_context()) == {"CANCELLED"}
    check_over(addon, session, pressed, before)


def test_an_error_in_a_preview_a_take_or_a_stroke_leaves_nothing(
    addon: ModuleType, obj: bpy.types.Object, monkeypatch: pytest.MonkeyPatch
) -> None:
    solo, take = part(addon, "operators.character.solo_class"), part(addon, "operators.mocap.play_take")
    stroke, before = part(addon, "operators.directing.draw_path"), everything(obj)
    monkeypatch.setattr(addon.operators.base.woken, "wake", lambda *_: None)
    monkeypatch.setattr(take, "chosen", lambda *_: obj.animation_data.action)
    for operator, module, name in (
        (solo.FRAGMOTION_OT_solo_class, part(addon, "preview.class_preview").ClassPreview, "step"),
        (take.FRAGMOTION_OT_play_take, part(addon, "preview.take_preview").TakePreview, "trouble"),
        (stroke.FRAGMOTION_OT_draw_path, stroke.FRAGMOTION_OT_draw_path, "_add"),
    ):
        context, pressed = a_context(), Pressed(operator)
        with monkeypatch.context() as patched:
            context.window_manager.fragmotion = bpy.context.window_manager.fragmotion
            assert operator.invoke(pressed, context, EVENT) == {"RUNNING_MODAL"}
            patched.setattr(module, name, fail)
            kind = "LEFTMOUSE" if operator is stroke.FRAGMOTION_OT_draw_path else "TIMER"
            event = SimpleNamespace(type=kind, value="PRESS")
            assert operator.modal(pressed, context, event) == {"CANCELLED"}
        assert len(pressed.told) == 1 and INJECTED in pressed.told[0][1]
        assert everything(obj) == before
    assert addon.preview.previews.current is None
    context.window.cursor_modal_restore.assert_called_once()
