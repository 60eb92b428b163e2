# SPDX-License-Identifier: MIT
"""However a drive ends, all that it touched is given back, and nothing of it is left."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from types import ModuleType

import bpy
import making
import numpy as np
import pytest
from driving import everything, go_on, hips, start


def spoil(obj: bpy.types.Object) -> None:
    """Make the armature's state as awkward as a user can: odd modes, an edited pose, NLA, a selection, half a frame."""
    obj.location, obj.rotation_mode, obj.rotation_quaternion = (1, -2, 0.5), "QUATERNION", (0.8, 0, 0, 0.6)
    for index, bone in enumerate(obj.pose.bones):
        bone.rotation_mode = ("XYZ", "QUATERNION", "AXIS_ANGLE", "ZXY")[index % 4]
    making.add_action(obj, frames=20, name="own")
    data = obj.animation_data
    track = data.nla_tracks.new()
    track.strips.new("strip", 30, data.action)
    track.mute = True
    bpy.context.scene.frame_set(7, subframe=0.25)
    for bone in obj.pose.bones:  # over the Action
        bone.location, bone.scale = (0.1, 0.2, 0.3), (1, 1.5, 1)
        bone.rotation_euler, bone.rotation_axis_angle = (0.1, 0.2, 0.3), (0.5, 0, 1, 0)
        bone.rotation_quaternion = (2, 0.1, 0, 0)
    obj.data.pose_position = "REST"
    making.add_mesh().select_set(True)


@pytest.mark.parametrize("mode", ["OBJECT", "POSE"])
def test_everything_is_given_back_exactly(session: ModuleType, mode: str) -> None:
    obj = making.add_armature()
    spoil(obj)
    bpy.ops.object.mode_set(mode=mode)
    before = everything(obj)
    driven = start(session, obj)
    driven.inputs.keyboard.press("W")
    go_on(driven, 1)
    assert everything(obj)["matrices"] != before["matrices"]
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.context.scene.frame_set(3)
    obj.location.x = 9
    for other in bpy.context.view_layer.objects:
        other.select_set(other != obj)
    bpy.context.view_layer.objects.active = next(o for o in bpy.data.objects if o != obj)
    session.stop()
    assert everything(obj) == before
    assert session.current is None


def test_an_armature_without_animation_stays_without(session: ModuleType) -> None:
    obj = making.add_armature()
    before = everything(obj)
    go_on(start(session, obj), 0.5)
    session.stop()
    assert everything(obj) == before and obj.animation_data is None


@pytest.mark.skipif(bpy.app.version < (4, 4, 0), reason="this Blender has no slots, which came with 4.4")
def test_an_action_that_plays_no_slot_plays_none_afterwards(session: ModuleType) -> None:
    obj = making.add_armature()
    making.add_action(obj)
    obj.animation_data.action_slot = None
    go_on(start(session, obj), 0.1)
    session.stop()
    assert obj.animation_data.action is not None and obj.animation_data.action_slot is None


def test_the_action_does_not_fight_the_drive(session: ModuleType) -> None:
    obj = making.add_armature()
    making.add_action(obj, frames=30)
    driven = start(session, obj)
    driven.inputs.keyboard.press("W")
    go_on(driven, 0.5)
    place = hips(obj)
    for frame in (5, 9):
        bpy.context.scene.frame_set(frame)
        np.testing.assert_allclose(hips(obj), place, atol=1e-6)


def test_saving_meanwhile_saves_the_armature_as_it_was(session: ModuleType, tmp_path: Path) -> None:
    obj = making.add_armature()
    spoil(obj)
    before = everything(obj)
    driven = start(session, obj)
    driven.inputs.keyboard.press("W")
    go_on(driven, 0.5)
    path = str(tmp_path / "saved.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True)
    go_on(driven, 0.5)
    assert session.current is driven and everything(obj)["matrices"] != before["matrices"]
    session.stop()
    assert everything(obj) == before
    with bpy.data.libraries.load(path) as (_, wanted):
        wanted.objects = ["Rig"]
    saved = wanted.objects[0]
    assert [bone.rotation_mode for bone in saved.pose.bones] == before["modes"]
    assert saved.animation_data.action.name.startswith("own") and sorted(saved.keys()) == before["properties"]


def test_undo_ends_the_drive_and_gives_everything_back(session: ModuleType) -> None:
    obj = making.add_armature()
    spoil(obj)
    bpy.ops.ed.undo_push(message="spoilt")
    before = {**everything(obj), "data": None, "playing": None}
    making.add_mesh().name = "Another"
    bpy.ops.ed.undo_push(message="another object")
    go_on(start(session, obj), 0.5)
    bpy.ops.ed.undo()
    assert session.current is None and "Another" not in bpy.data.objects
    obj = bpy.data.objects["Rig"]
    assert {**everything(obj), "data": None, "playing": None} == before
    assert obj.animation_data.action == bpy.data.actions["own"]


def test_an_undo_step_of_the_users_from_the_middle_of_a_drive_is_healed(session: ModuleType) -> None:
    obj = making.add_armature()
    spoil(obj)
    bpy.ops.ed.undo_push(message="spoilt")
    driven = start(session, obj)
    go_on(driven, 0.5)
    making.add_mesh().name = "Added meanwhile"
    bpy.ops.ed.undo_push(message="add")
    before = None
    go_on(driven, 0.5)
    session.stop()
    before = {**everything(obj), "data": None, "playing": None}
    bpy.ops.ed.undo()
    assert "Added meanwhile" not in bpy.data.objects
    bpy.ops.ed.redo()
    assert "Added meanwhile" in bpy.data.objects
    obj = bpy.data.objects["Rig"]
    assert {**everything(obj), "data": None, "playing": None} == before
    assert obj.animation_data.action == bpy.data.actions["own"]


def test_a_file_from_the_middle_of_a_drive_is_healed(addon: ModuleType, session: ModuleType, tmp_path: Path) -> None:
    """As Blender's autosave writes it, which calls no handler."""
    obj = making.add_armature()
    spoil(obj)
    modes, pose = [bone.rotation_mode for bone in obj.pose.bones], everything(obj)["bones"]
    addon.preview.suspended_state.put_aside(obj)
    assert [bone.rotation_mode for bone in obj.pose.bones] != modes
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "autosave.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "autosave.blend"))
    obj = bpy.data.objects["Rig"]
    assert [bone.rotation_mode for bone in obj.pose.bones] == modes and everything(obj)["bones"] == pose
    assert obj.animation_data.action == bpy.data.actions["own"]
    assert "fragmotion_put_aside" not in obj


def test_loading_a_file_ends_the_drive(addon: ModuleType, session: ModuleType) -> None:
    driven = start(session, making.add_armature())
    go_on(driven, 0.1)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    assert session.current is None and driven.inputs.pads == []
    assert sdl_is_closed(addon)


def sdl_is_closed(addon: ModuleType) -> bool:
    """Whether nothing of SDL is in use."""
    return bool(import_module(f"{addon.__name__}.input.sdl").load().SDL_WasInit(0) == 0)


def test_switching_the_add_on_off_ends_the_drive(addon: ModuleType, session: ModuleType) -> None:
    obj = making.add_armature()
    spoil(obj)
    before = everything(obj)
    go_on(start(session, obj), 0.1)
    addon.unregister()
    addon.register()
    assert session.current is None and everything(obj) == before and sdl_is_closed(addon)


def test_a_drive_says_why_it_cannot_go_on(addon: ModuleType, session: ModuleType) -> None:
    obj = making.add_armature()
    driven = start(session, obj)
    assert driven.trouble() == ""
    bpy.ops.object.mode_set(mode="EDIT")
    assert "is being edited" in driven.trouble()
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.data.objects.remove(obj)
    assert driven.trouble() == "Armature 'Rig' was deleted"
    session.stop()
    assert session.current is None and sdl_is_closed(addon)


def test_one_drive_at_a_time(session: ModuleType) -> None:
    one, two = making.add_armature(name="One"), making.add_armature(name="Two")
    before = everything(one)["bones"]
    go_on(start(session, one), 0.2)
    go_on(start(session, two), 0.2)
    assert session.current.obj == two and everything(one)["bones"] == before


def test_an_armature_that_cannot_be_driven_is_refused_and_left_alone(addon: ModuleType, session: ModuleType) -> None:
    obj = making.add_armature(
        connected=("hips",),
        bones=[
            *making.BODY[:1],
            ("hips", "root", (0, 0.3, 0), (0, 0.3, 1)),
            ("head", "hips", (0, 0.3, 1), (0, 0.3, 2)),
        ],
    )
    before = everything(obj)
    with pytest.raises(addon.errors.UserError, match="'hips' carries the body"):
        start(session, obj)
    assert session.current is None and everything(obj) == before and sdl_is_closed(addon)
