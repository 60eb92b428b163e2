# SPDX-License-Identifier: MIT
"""A click on the ground sends the character there."""

from __future__ import annotations

import math
from importlib import import_module
from types import ModuleType, SimpleNamespace
from typing import Any

import bpy
import driving
import making
import pytest
from mathutils import Matrix, Vector

THERE = (2.0, -3.0)


@pytest.mark.parametrize("runs", [False, True])
def test_the_character_goes_where_it_is_sent_and_stands(session: ModuleType, obj: bpy.types.Object, runs: bool) -> None:
    driven = driving.start(session, obj)
    far = (4.0, -6.0)
    driven.walk_to(far, runs)
    driving.go_on(driven, 1.5)
    assert driven.inputs.label == "Click on the ground"
    assert math.hypot(*driven.readings.velocity) > (1.6 if runs else 0.5)
    driving.go_on(driven, 8)
    assert math.dist(driven.actor.frame[:2], far) < 0.25
    assert not any(driven.control[:2])


def test_where_it_goes_is_marked_until_it_is_there(session: ModuleType, obj: bpy.types.Object) -> None:
    driven = driving.start(session, obj)
    assert driven.shown().target is None
    driven.walk_to(THERE, level=0.4)
    driving.go_on(driven, 0.5)
    assert driven.shown().target == (*THERE, 0.4)
    driving.go_on(driven, 9)
    assert driven.shown().target is None
    driven.walk_to((0.0, 0.0))
    driving.go_on(driven, 0.5)
    driven.inputs.keyboard.press("W")
    driving.go_on(driven, 0.1)
    assert driven.shown().target is None, "another input has taken over"


def test_it_is_sent_elsewhere_before_it_is_there(session: ModuleType, obj: bpy.types.Object) -> None:
    driven = driving.start(session, obj)
    driven.walk_to(THERE)
    driving.go_on(driven, 1)
    driven.walk_to((-3.0, 1.0))
    driving.go_on(driven, 10)
    assert math.dist(driven.actor.frame[:2], (-3, 1)) < 0.25


def test_any_other_input_takes_over(session: ModuleType, obj: bpy.types.Object) -> None:
    driven = driving.start(session, obj)
    driven.walk_to(THERE)
    driving.go_on(driven, 1)
    driven.inputs.keyboard.press("W")
    driving.go_on(driven, 0.2)
    assert driven.inputs.label == "Keyboard"
    driven.inputs.keyboard.let_go("W")
    driving.go_on(driven, 2)
    assert driven.control == (0, 0, 0, 0), "it does not go on to where it was sent"


def test_a_click_where_it_stands_does_nothing(session: ModuleType, obj: bpy.types.Object) -> None:
    driven = driving.start(session, obj)
    x, y, _ = driven.actor.frame
    driven.walk_to((x + 0.05, y))
    driving.go_on(driven, 0.2)
    assert driven.inputs.label == "" and not any(driven.control)


def test_what_it_is_sent_to_do_is_recorded_and_replayed(session: ModuleType, obj: bpy.types.Object) -> None:
    driven = driving.start(session, obj)
    driven.toggle_recording()
    driven.walk_to(THERE)
    driving.go_on(driven, 6)
    driven.toggle_recording()
    there = driven.actor.frame
    replayed = driving.recorded(session).replay(bpy.context, obj, obj.fragmotion.recordings[0])
    driving.go_on(replayed, 6)
    assert math.dist(replayed.actor.frame[:2], there[:2]) < 1e-6


def test_a_body_that_only_slides_is_sent_too(session: ModuleType) -> None:
    driven = driving.start(session, making.add_armature())
    driven.walk_to(THERE)
    driving.go_on(driven, 8)
    assert math.dist(driven.actor.frame[:2], THERE) < 0.3


def view_onto(place: Vector, perspective: bool) -> Any:
    """A 3D view's area, of 200 by 200 pixels, whose middle shows a place, slantwise from above."""
    eye = place + Vector((4.0, -12.0, 9.0))
    view = Matrix.LocRotScale(eye, (place - eye).to_track_quat("-Z", "Y"), None).inverted()
    lens = ((2, 0, 0, 0), (0, 2, 0, 0), (0, 0, -1, -0.2), (0, 0, -1, 0))
    window = Matrix(lens) if perspective else Matrix.Diagonal((0.1, 0.1, -0.01, 1))
    shown = SimpleNamespace(
        view_matrix=view, perspective_matrix=window @ view, window_matrix=window, is_perspective=perspective
    )
    shown.view_perspective = "PERSP" if perspective else "ORTHO"
    region = SimpleNamespace(type="WINDOW", width=200, height=200)
    return SimpleNamespace(regions=[region], spaces=SimpleNamespace(active=SimpleNamespace(region_3d=shown)))


def stand_high(obj: bpy.types.Object, height: float) -> bpy.types.Object:
    """A square of 20 m at a height, which the armature is set to stand on."""
    mesh = bpy.data.meshes.new("Roof")
    mesh.from_pydata([(x, y, 0.0) for x, y in ((-10, -10), (10, -10), (10, 10), (-10, 10))], [], [(0, 1, 2, 3)])
    roof = bpy.data.objects.new("Roof", mesh)
    bpy.context.scene.collection.objects.link(roof)
    roof.location.z = height
    bpy.context.view_layer.update()
    obj.fragmotion.ground.kind, obj.fragmotion.ground.object = "OBJECT", roof
    return roof


@pytest.mark.parametrize("perspective", [True, False])
def test_a_pixel_shows_the_ground_that_is_chosen(
    addon: ModuleType, session: ModuleType, obj: bpy.types.Object, perspective: bool
) -> None:
    ground_under = import_module(f"{addon.__name__}.paths.drawing").ground_under
    stand_high(obj, 3.0)
    driven = driving.start(session, obj)
    for place in (Vector((2, -3, 3)), Vector((-4, 5, 3))):
        seen = ground_under(view_onto(place, perspective), 100, 100, driven.ground)
        assert tuple(seen) == pytest.approx(tuple(place), abs=1e-3)
    beside = Vector((40, 40, 3))
    assert ground_under(view_onto(beside, perspective), 100, 100, driven.ground) is None, "there is none"


def test_a_click_sends_to_the_chosen_ground(
    addon: ModuleType, session: ModuleType, obj: bpy.types.Object, monkeypatch: pytest.MonkeyPatch
) -> None:
    operators = import_module(f"{addon.__name__}.operators.directing.drive")
    stand_high(obj, 3.0)
    driven = driving.start(session, obj)
    free = operators.views.Free(0.0, 0.0, 1e5, 1e5)
    monkeypatch.setattr(operators.views, "free_part", lambda area: free)
    click = SimpleNamespace(ctrl=False, alt=False, oskey=False, shift=False)
    assert operators._send_there(driven, view_onto(Vector((*THERE, 3)), True), click, (100, 100))
    driving.go_on(driven, 8)
    assert math.dist(driven.actor.frame[:2], THERE) < 0.25


def test_what_slides_is_sent_on_the_plane(session: ModuleType) -> None:
    obj = making.add_armature()
    stand_high(obj, 3.0)
    assert driving.start(session, obj).ground is None
