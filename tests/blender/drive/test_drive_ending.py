# SPDX-License-Identifier: MIT
"""Whatever is taken away from a drive, it ends with one clear sentence, and what is still there is as it was."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import driving
import making
import numpy as np
import pytest
from driving import RATE, everything, go_on, start
from test_drive_restoring import spoil

NOTE = "fragmotion_put_aside"


def remove_view_layer() -> None:
    scene = bpy.context.scene
    scene.view_layers.new("Other")
    scene.view_layers.remove(bpy.context.view_layer)


def remove_scene() -> None:
    bpy.data.scenes.new("Other")
    bpy.data.scenes.remove(bpy.context.scene)


def show_another_scene() -> None:
    making.window().scene = bpy.data.scenes.new("Other")


def exclude_collection() -> None:
    bpy.context.view_layer.layer_collection.children["Cast"].exclude = True


def unlink() -> None:
    bpy.data.collections["Cast"].objects.unlink(bpy.data.objects["Rig"])


def swap_armature() -> None:
    obj = bpy.data.objects["Rig"]
    obj.data = bpy.data.armatures.new("Other")


def delete_bone() -> None:
    with making.editing(bpy.data.objects["Rig"]) as bones:
        bones.remove(bones["hand.L"])


def edit_bones() -> None:
    making.activate(bpy.data.objects["Rig"])
    bpy.ops.object.mode_set(mode="EDIT")


def delete_armature() -> None:
    bpy.data.objects.remove(bpy.data.objects["Rig"])


def purge_armature() -> None:
    bpy.data.armatures.remove(bpy.data.objects["Rig"].data)


REMOVALS: dict[Callable[[], None], str] = {
    remove_view_layer: "The view layer was removed",
    remove_scene: "The scene was deleted",
    show_another_scene: "Another scene is shown",
    exclude_collection: "Armature 'Rig' is not in the view layer any more",
    unlink: "Armature 'Rig' is not in the view layer any more",
    swap_armature: "Armature 'Rig' was given other armature data",
    delete_bone: "Bones of armature 'Rig' were added or deleted",
    edit_bones: "Armature 'Rig' is being edited",
    delete_armature: "Armature 'Rig' was deleted",
    purge_armature: "Armature 'Rig' was deleted",
}


@pytest.fixture
def cast(addon: ModuleType) -> bpy.types.Object:
    """An armature in an awkward state, in a collection of its own."""
    obj = making.add_armature()
    collection = bpy.data.collections.new("Cast")
    bpy.context.scene.collection.children.link(collection)
    collection.objects.link(obj)
    bpy.context.scene.collection.objects.unlink(obj)
    making.activate(obj)
    spoil(obj)
    bpy.data.armatures[obj.data.name].use_fake_user = True
    return obj


def own_state(obj: bpy.types.Object) -> dict[str, Any]:
    """What a drive puts aside of an armature, by bones."""
    data = obj.animation_data
    channels = ("location", "rotation_quaternion", "rotation_euler", "rotation_axis_angle", "scale")
    return {
        **{bone.name: (bone.rotation_mode, *(tuple(getattr(bone, c)) for c in channels)) for bone in obj.pose.bones},
        "/place": [tuple(getattr(obj, name)) for name in channels],
        "/data": (data.action, data.use_nla, getattr(data, "action_slot_handle", 0)),
        "/noted": NOTE in obj,
    }


@pytest.mark.parametrize("remove", REMOVALS, ids=lambda remove: remove.__name__)
def test_what_is_taken_away_ends_the_drive(session: ModuleType, cast: Any, remove: Callable[[], None]) -> None:
    before, armature = own_state(cast), cast.data
    driven = start(session, cast)
    driven.toggle_recording()
    driven.inputs.keyboard.press("W")
    go_on(driven, 0.5)
    assert driven.trouble() == ""
    remove()
    bpy.context.view_layer.update()  # as Blender does before the next event
    assert driven.trouble() == REMOVALS[remove]
    session.stop()
    assert session.current is None
    if remove in {delete_armature, purge_armature}:
        return
    after = own_state(cast)
    kept = after.keys() & before.keys()
    assert len(kept) >= (3 if remove == swap_armature else len(before) - 1)
    assert {key: after[key] for key in kept} == {key: before[key] for key in kept}
    assert armature.pose_position == "REST" and cast.data.pose_position == ("POSE" if armature != cast.data else "REST")
    assert [each.seconds for each in cast.fragmotion.recordings] == [0.5], "what was recorded is lost"


def test_the_armature_is_given_back_where_what_was_active_is_gone(session: ModuleType) -> None:
    obj = making.add_armature()
    spoil(obj)
    mesh, before = making.add_mesh(obj), own_state(obj)
    making.activate(mesh)
    go_on(start(session, obj), 0.2)
    bpy.data.objects.remove(mesh)
    assert session.current.trouble() == ""
    session.stop()
    assert own_state(obj) == before


def test_what_is_renamed_meanwhile_is_given_back_too(session: ModuleType) -> None:
    obj = making.add_armature()
    spoil(obj)
    obj.animation_data_clear()  # its curves go with their bones
    making.add_mesh().name = "Friend"
    bpy.data.objects["Friend"].select_set(True)
    before = everything(obj)
    driven = start(session, obj)
    go_on(driven, 0.2)
    obj.name, bpy.data.objects["Friend"].name = "Renamed", "Foe"
    obj.pose.bones["hand.L"].name, obj.pose.bones["head"].name = "hook", "skull"
    go_on(driven, 0.2)
    assert driven.trouble() == "" and driven.armature == "Renamed"
    session.stop()
    assert [obj.name, bpy.data.objects["Foe"].select_get()] == ["Renamed", True]
    after = everything(obj)
    assert list(after["bones"].values()) == list(before["bones"].values())
    assert (after["modes"], after["place"], after["position"]) == (before["modes"], before["place"], before["position"])


def test_saving_twice_between_two_updates_is_harmless(
    session: ModuleType, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    obj = making.add_armature()
    spoil(obj)
    before = everything(obj)
    driven = start(session, obj)
    go_on(driven, 0.2)
    for _ in range(2):
        bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "twice.blend"), copy=True)
    go_on(driven, 0.2)
    assert everything(obj)["matrices"] != before["matrices"], "the drive does not go on"
    bpy.data.objects.remove(obj)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "without.blend"), copy=True)
    assert "Traceback" not in capfd.readouterr().err


def test_a_note_that_is_not_ours_is_dropped(addon: ModuleType, session: ModuleType, tmp_path: Path) -> None:
    obj, mesh = making.add_armature(), making.add_mesh()
    obj[NOTE], mesh[NOTE] = {"slot": "?", "modes": 3}, 1
    other = making.add_armature(name="Other")
    spoil(other)
    before = own_state(other)
    addon.preview.suspended_state.put_aside(other)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "forged.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "forged.blend"))
    assert not any(NOTE in obj for obj in bpy.data.objects)
    assert own_state(bpy.data.objects["Other"]).keys() == before.keys()
    assert [bone.rotation_mode for bone in bpy.data.objects["Other"].pose.bones[:2]] == ["XYZ", "QUATERNION"]


def recording(session: ModuleType) -> Any:
    """A drive that records, a second long, of an armature to which another object was added in a step of its own."""
    obj = making.add_armature()
    spoil(obj)
    bpy.ops.ed.undo_push(message="spoilt")
    making.add_mesh().name = "Another"
    bpy.ops.ed.undo_push(message="another object")
    driven = start(session, obj)
    driven.toggle_recording()
    driven.inputs.keyboard.press("W")
    go_on(driven, 1)
    return driven


def test_undo_while_recording_keeps_the_recording_and_what_was_done_before(session: ModuleType) -> None:
    driven = recording(session)
    before = own_state(driven.obj).keys()
    bpy.ops.ed.undo()
    assert session.current is None and "undo" in driven.farewell and "is kept" in driven.farewell
    obj = bpy.data.objects["Rig"]
    assert [each.seconds for each in obj.fragmotion.recordings] == [1] and "Another" in bpy.data.objects
    assert own_state(obj).keys() == before and NOTE not in obj
    bpy.ops.ed.undo()
    assert not bpy.data.objects["Rig"].fragmotion.recordings and "Another" in bpy.data.objects, (
        "the recording is one step"
    )
    bpy.ops.ed.undo()
    assert "Another" not in bpy.data.objects, "nothing is in the way of further undoing"
    for _ in range(2):
        bpy.ops.ed.redo()
    assert [each.seconds for each in bpy.data.objects["Rig"].fragmotion.recordings] == [1]


def test_redo_while_recording_keeps_the_recording(session: ModuleType) -> None:
    obj = making.add_armature()
    bpy.ops.ed.undo_push(message="armature")
    making.add_mesh().name = "Another"
    bpy.ops.ed.undo_push(message="another object")
    bpy.ops.ed.undo()
    obj = bpy.data.objects["Rig"]
    driven = start(session, obj)
    driven.toggle_recording()
    go_on(driven, 1)
    bpy.ops.ed.redo()
    assert session.current is None and "Another" in bpy.data.objects
    assert [each.seconds for each in bpy.data.objects["Rig"].fragmotion.recordings] == [1]
    bpy.ops.ed.undo()
    assert "Another" in bpy.data.objects and not bpy.data.objects["Rig"].fragmotion.recordings


def test_a_recording_that_is_replayed_may_be_removed(addon: ModuleType, session: ModuleType) -> None:
    obj = making.add_armature()
    trace = np.tile((0, 1.0, 0, 0), (20, 1))
    driven = driving.recorded(session).replay(bpy.context, obj, addon.recordings.recordings.add_recording(obj, trace))
    go_on(driven, 0.5)
    addon.recordings.recordings.remove_recording(obj, 0)
    go_on(driven, 0.5)
    np.testing.assert_array_equal(driven.control, trace[0])


def test_an_armature_of_no_size_or_without_bones_is_refused(addon: ModuleType, session: ModuleType) -> None:
    for obj in (making.add_armature(name="Flat"), making.add_armature(bones=(), name="Empty")):
        obj.scale = (0, 0, 0)
        before = everything(obj)
        with pytest.raises(addon.errors.UserError, match=f"Armature '{obj.name}'"):
            start(session, obj)
        assert session.current is None and everything(obj) == before


def test_a_drive_goes_on_while_the_timeline_plays_and_after_a_bone_is_selected(session: ModuleType) -> None:
    obj = making.add_armature()
    spoil(obj)
    before = everything(obj)
    driven = start(session, obj)
    for frame in range(20):
        bpy.context.scene.frame_set(frame)
        driven.update(1 / RATE)
        assert driven.trouble() == ""
    session.stop()
    assert everything(obj) == before
