# SPDX-License-Identifier: MIT
"""What a pointer in a .blend names is removed only where it was made for what holds the pointer."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
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


def stored(data: Any) -> Any:
    """The add-on's properties as the file holds them."""
    if bpy.app.version >= (5, 0, 0):
        return data.bl_system_properties_get(do_create=True)["fragmotion"]
    return data["fragmotion"]


def forge_pointers(kind: Any, group: Any, wrong: bpy.types.ID) -> int:
    """Point every pointer to data of a property group, and of the groups in it, to a mesh; how many there were."""
    count = 0
    for prop in kind.bl_rna.properties[1:]:
        name, inside = prop.identifier, getattr(prop, "fixed_type", None)
        if prop.type == "COLLECTION":
            count += sum(forge_pointers(inside, each, wrong) for each in group.get(name, ()))
        elif prop.type == "POINTER" and issubclass(getattr(bpy.types, inside.identifier, object), bpy.types.ID):
            group[name] = wrong
            count += 1
        elif prop.type == "POINTER":
            if name not in group:
                group[name] = {}
            count += forge_pointers(inside, group[name], wrong)
    return count


def pointers(group: Any) -> Iterator[Any]:
    """What the pointers to data of a property group point to, and of the groups in it."""
    for prop in group.bl_rna.properties[1:]:
        value = getattr(group, prop.identifier)
        if prop.type == "COLLECTION":
            for each in value:
                yield from pointers(each)
        elif prop.type == "POINTER" and isinstance(value, bpy.types.PropertyGroup):
            yield from pointers(value)
        elif prop.type == "POINTER":
            yield value


def test_a_pointer_to_data_of_another_type_is_taken_for_none(
    addon: ModuleType, rig: bpy.types.Object, tmp_path: Path
) -> None:
    rig.fragmotion.moves.add().name = "wave"
    mesh = making.add_mesh(rig).data
    count = forge_pointers(type(rig.fragmotion), stored(rig), mesh)
    assert count == len(list(pointers(rig.fragmotion))) > 10
    path = str(tmp_path / "forged.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    rig = bpy.data.objects["Rig"]
    assert list(pointers(rig.fragmotion)) == [None] * count
    rig.fragmotion.ground.kind = "COLLECTION"
    with pytest.raises(addon.errors.UserError, match="none is chosen"):
        addon.ground.meshes.find_ground(bpy.context, rig)


def test_takes_of_what_is_no_armature_are_refused_in_a_sentence(addon: ModuleType, rig: bpy.types.Object) -> None:
    mesh = making.add_mesh(rig)
    making.activate(rig)
    rig.fragmotion.source = mesh
    with pytest.raises(RuntimeError, match=f"'{mesh.name}' is no other armature") as failure:
        bpy.ops.fragmotion.retarget_actions()
    assert "Traceback" not in str(failure.value)
