# SPDX-License-Identifier: MIT
"""What a pointer in a .blend names is removed only where it was made for what holds the pointer."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import bpy
import making
import numpy as np
import pytest


@pytest.fixture
def rig(addon: ModuleType) -> bpy.types.Object:
    """An armature with two recordings, the first selected."""
    obj = making.add_armature()
    for name in ("Stroll", "Other"):
        addon.recordings.recordings.add_recording(obj, np.zeros((50, 4)), name=name)
    obj.fragmotion.active_recording = 0
    return obj


def strangers(rig: bpy.types.Object) -> dict[str, bpy.types.Object]:
    """What a forged pointer may name."""
    empty, child = bpy.data.objects.new("Empty", None), bpy.data.objects.new("Child", None)
    child.parent = rig
    for obj in (empty, child):
        bpy.context.scene.collection.objects.link(obj)
    making.activate(rig)
    return {"rig": rig, "mesh": making.add_mesh(rig), "empty": empty, "child": child}


@pytest.mark.parametrize("name", ["rig", "mesh", "empty", "child"])
@pytest.mark.parametrize("press", ["delete_recording", "edit_curves"])
def test_what_a_forged_pointer_names_stays(rig: bpy.types.Object, name: str, press: str) -> None:
    named = strangers(rig)[name]
    making.activate(rig)
    rig.fragmotion.recordings[0].curves = named
    before = set(bpy.data.objects)
    assert getattr(bpy.ops.fragmotion, press)() == {"FINISHED"}
    assert before <= set(bpy.data.objects)


def test_curves_of_another_recording_stay(rig: bpy.types.Object) -> None:
    assert bpy.ops.fragmotion.edit_curves() == {"FINISHED"}
    curves = rig.fragmotion.recordings[0].curves
    rig.fragmotion.recordings[1].curves = curves
    making.activate(rig)
    rig.fragmotion.active_recording = 1
    assert bpy.ops.fragmotion.delete_recording() == {"FINISHED"}
    assert curves in set(bpy.data.objects)


def duplicated(rig: bpy.types.Object) -> Any:
    making.activate(rig)
    assert bpy.ops.object.duplicate() == {"FINISHED"}
    return bpy.context.active_object


def test_a_copys_recording_leaves_the_originals_curves(addon: ModuleType, rig: bpy.types.Object) -> None:
    assert bpy.ops.fragmotion.edit_curves() == {"FINISHED"}
    curves, action = rig.fragmotion.recordings[0].curves, rig.fragmotion.recordings[0].curves.animation_data.action
    copy = duplicated(rig)
    assert addon.recordings.curves.curves_of(copy, copy.fragmotion.recordings[0]) is None
    assert bpy.ops.fragmotion.edit_curves() == {"FINISHED"}
    own = copy.fragmotion.recordings[0].curves
    assert own != curves and own.parent == copy
    making.activate(copy)
    assert bpy.ops.fragmotion.delete_recording() == {"FINISHED"}
    assert curves in set(bpy.data.objects) and action in set(bpy.data.actions)
    assert addon.recordings.curves.curves_of(rig, rig.fragmotion.recordings[0]) == curves


def test_own_curves_go_with_their_recording(rig: bpy.types.Object) -> None:
    rig.fragmotion.recordings[0].name = "Stroll"
    assert bpy.ops.fragmotion.edit_curves() == {"FINISHED"}
    making.activate(rig)
    rig.fragmotion.recordings[0].name = "Renamed"
    rig.name = "Hero"
    assert bpy.ops.fragmotion.delete_recording() == {"FINISHED"}
    assert set(bpy.data.objects) == {rig} and not bpy.data.actions


@pytest.mark.parametrize("pointer", ["motion", "anchors"])
@pytest.mark.parametrize("itself", [False, True])
def test_unbinding_leaves_what_was_not_made_for_the_rig(
    addon: ModuleType, rig: bpy.types.Object, pointer: str, itself: bool
) -> None:
    victim = rig if itself else making.add_armature(name="Victim")
    rig.fragmotion.control_rig.rig = rig
    setattr(rig.fragmotion.control_rig, pointer, victim)
    addon.control_rig.binding.unbind(bpy.context, rig)
    assert {rig, victim} <= set(bpy.data.objects)


def test_unbinding_leaves_a_collection_that_the_user_made(addon: ModuleType, rig: bpy.types.Object) -> None:
    mine = bpy.data.collections.new("Mine")
    bpy.context.scene.collection.children.link(mine)
    motion = making.add_armature(name="Rig Motion")
    motion.users_collection[0].objects.unlink(motion)
    mine.objects.link(motion)
    motion.fragmotion.control_rig.rig, rig.fragmotion.control_rig.motion = rig, motion
    addon.control_rig.binding.unbind(bpy.context, rig)
    assert "Rig Motion" not in bpy.data.objects and mine in set(bpy.data.collections)


def test_a_copy_of_character_and_curves_has_curves_of_its_own(addon: ModuleType, rig: bpy.types.Object) -> None:
    assert bpy.ops.fragmotion.edit_curves() == {"FINISHED"}
    curves = rig.fragmotion.recordings[0].curves
    rig.select_set(True)
    assert bpy.ops.object.duplicate() == {"FINISHED"}
    copy = next(obj for obj in bpy.data.objects if obj.type == "ARMATURE" and obj != rig)
    own = copy.fragmotion.recordings[0].curves
    assert own != curves and addon.recordings.curves.curves_of(copy, copy.fragmotion.recordings[0]) == own
    addon.recordings.curves.remove_curves(copy, copy.fragmotion.recordings[0])
    assert set(bpy.data.objects) == {rig, copy, curves}
