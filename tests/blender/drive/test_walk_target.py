# SPDX-License-Identifier: MIT
"""A click on the ground sends the character there."""

from __future__ import annotations

import math
from types import ModuleType

import bpy
import driving
import making
import pytest

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
    replayed = session.replay(bpy.context, obj, obj.fragmotion.takes[0])
    driving.go_on(replayed, 6)
    assert math.dist(replayed.actor.frame[:2], there[:2]) < 1e-6


def test_a_body_that_only_slides_is_sent_too(session: ModuleType) -> None:
    driven = driving.start(session, making.add_armature())
    driven.walk_to(THERE)
    driving.go_on(driven, 8)
    assert math.dist(driven.actor.frame[:2], THERE) < 0.3
