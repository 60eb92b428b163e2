# SPDX-License-Identifier: MIT
"""Hundreds of things that a user can do while driving, in any order: no error's text, all is given back."""

from __future__ import annotations

import random
import re
from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import driving
import making
import pytest
from driving import RATE

NOTE = "fragmotion_put_aside"
OPERATIONS = 200
PROGRAMMERS = re.compile(r"Traceback|StructRNA|KeyError|has no attribute|index out of range|NoneType")
MODES = ("XYZ", "QUATERNION", "AXIS_ANGLE", "ZXY")


class User:
    """Somebody who does anything, with the drive's operator played by `look`."""

    def __init__(self, addon: ModuleType, session: ModuleType, folder: Path, seed: int) -> None:
        self.addon, self.session, self.folder = addon, session, folder
        self.random = random.Random(seed)
        self.begin_anew()

    def begin_anew(self) -> None:
        """An empty file with an armature in an awkward state and something beside it."""
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        obj = making.add_armature()
        for index, bone in enumerate(obj.pose.bones):
            bone.rotation_mode = MODES[index % 4]
        making.add_action(obj, name="own")
        obj.animation_data.action.use_fake_user = True
        obj.data.pose_position = "REST"
        making.add_mesh()
        making.activate(obj)
        bpy.ops.ed.undo_push(message="begin")

    @property
    def rig(self) -> Any:
        """The armature, if it is there."""
        return next((obj for obj in bpy.data.objects if obj.type == "ARMATURE"), None)

    def do_anything(self) -> str:
        """Do something; its name."""
        deeds = [name for name in dir(self) if name.startswith("do_") and name != "do_anything"]
        name = self.random.choice(deeds)
        getattr(self, name)()
        bpy.context.view_layer.update()
        self.look()
        return name

    def look(self) -> None:
        """As the operator does when its timer wakes it; and nothing is driven half way."""
        driven = self.session.current
        if driven is not None and driven.trouble():
            assert driven.trouble()[0].isupper() and not PROGRAMMERS.search(driven.trouble())
            self.session.stop()
        elif driven is not None:
            driven.update(1 / RATE)
        if self.session.current is None:
            self.assert_given_back()

    def assert_given_back(self) -> None:
        """The armature's bones rotate as they did, it plays its Action, and nothing is noted."""
        assert not any(NOTE in obj for obj in bpy.data.objects)
        for obj in bpy.data.objects:
            if obj.type == "ARMATURE" and len(obj.pose.bones) == len(making.BODY):
                assert [bone.rotation_mode for bone in obj.pose.bones] == [
                    MODES[i % 4] for i in range(len(making.BODY))
                ]
                assert obj.animation_data.action == bpy.data.actions["own"] and obj.data.pose_position == "REST"

    def do_drive(self) -> None:
        if self.rig is None:
            self.begin_anew()
        if self.rig.mode == "EDIT":
            return
        try:
            self.session.start(bpy.context, self.rig)
        except self.addon.errors.UserError as error:
            assert not PROGRAMMERS.search(str(error))

    do_drive_again = do_drive_on = do_drive_at_last = do_drive_now = do_drive_once_more = do_drive

    def do_replay(self) -> None:
        if self.rig is not None and self.rig.fragmotion.recordings and self.rig.mode != "EDIT":
            driving.recorded(self.session).replay(bpy.context, self.rig, self.rig.fragmotion.recordings[0])

    def do_go_on(self) -> None:
        for _ in range(self.random.randrange(20)):
            self.look()

    def do_press(self) -> None:
        if self.session.current is not None:
            self.session.current.inputs.keyboard.press(self.random.choice(("W", "A", "Q", "SPACE")))

    def do_record(self) -> None:
        if bpy.ops.fragmotion.record.poll():
            bpy.ops.fragmotion.record()

    do_record_again = do_record

    def do_stop(self) -> None:
        self.session.stop()

    def do_save(self) -> None:
        for _ in range(self.random.randrange(1, 3)):
            bpy.ops.wm.save_as_mainfile(filepath=str(self.folder / "saved.blend"), copy=True)

    def do_load(self) -> None:
        if (self.folder / "saved.blend").exists() and self.random.random() < 0.3:
            bpy.ops.wm.open_mainfile(filepath=str(self.folder / "saved.blend"))
            bpy.ops.ed.undo_push(message="load")

    def do_undo(self) -> None:
        if bpy.ops.ed.undo.poll():
            bpy.ops.ed.undo()

    def do_redo(self) -> None:
        if bpy.ops.ed.redo.poll():
            bpy.ops.ed.redo()

    def do_push(self) -> None:
        bpy.ops.ed.undo_push(message="push")

    def do_delete(self) -> None:
        bpy.data.objects.remove(self.random.choice(list(bpy.data.objects)))
        if self.rig is None:
            self.session.stop()
            self.begin_anew()

    def do_add(self) -> None:
        making.activate(making.add_mesh())

    def do_remove_recording(self) -> None:
        if self.rig is not None and self.rig.fragmotion.recordings:
            self.addon.recordings.recordings.remove_recording(self.rig, 0)

    def do_rename(self) -> None:
        self.rig.name = self.random.choice(("Rig", "Hero", "\N{SNOWMAN}"))
        bone = self.random.choice(list(self.rig.pose.bones))
        if self.session.current is not None:  # the Action's keys go with the name
            bone.name = self.random.choice(("a", "b", bone.name))

    def do_frame(self) -> None:
        bpy.context.scene.frame_set(self.random.randrange(20))

    def do_edit(self) -> None:
        if self.rig.name in bpy.context.view_layer.objects and bpy.context.mode == "OBJECT":
            bpy.context.view_layer.objects.active = self.rig
            bpy.ops.object.mode_set(mode="EDIT")
            self.look()
            if bpy.context.mode != "OBJECT":
                bpy.ops.object.mode_set(mode="OBJECT")

    def do_pose(self) -> None:
        if bpy.context.view_layer.objects.active == self.rig and bpy.ops.object.posemode_toggle.poll():
            bpy.ops.object.posemode_toggle()

    def do_unlink(self) -> None:
        collection = bpy.context.scene.collection
        if self.rig.name in collection.objects:
            collection.objects.unlink(self.rig)
            bpy.context.view_layer.update()
            self.look()
        if self.rig.name not in collection.objects:
            collection.objects.link(self.rig)

    def do_switch_layer(self) -> None:
        scene = bpy.context.scene
        former, layer = bpy.context.view_layer, scene.view_layers.new("Layer")
        making.window().view_layer = layer
        if self.random.random() < 0.5:
            scene.view_layers.remove(former)

    def do_switch_scene(self) -> None:
        former = bpy.context.scene
        making.window().scene = bpy.data.scenes.new("Scene")
        self.look()
        making.window().scene = former

    def do_switch_off(self) -> None:
        self.addon.unregister()
        self.addon.register()


@pytest.mark.thorough
@pytest.mark.parametrize("seed", range(2))
def test_whatever_is_done_the_drive_ends_well(
    addon: ModuleType, session: ModuleType, tmp_path: Path, capfd: pytest.CaptureFixture[str], seed: int
) -> None:
    user, done, driven = User(addon, session, tmp_path, seed), [], 0
    errors: list[str] = []
    for _ in range(OPERATIONS):
        try:
            done.append(user.do_anything())
        except Exception as error:
            raise AssertionError(f"after {done[-8:]}: {type(error).__name__}: {error}") from error
        driven += session.current is not None
        output = capfd.readouterr()
        errors += [line for line in (output.out + output.err).splitlines() if PROGRAMMERS.search(line)]
        assert not errors, f"after {done[-8:]}: {errors}"
    session.stop()
    user.assert_given_back()
    assert driven > OPERATIONS / 8 and len(set(done)) > 20, "too little was tried"
