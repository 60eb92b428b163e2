# SPDX-License-Identifier: MIT
"""The list of takes: found by name, put in order by length, ticked as they are shown, folded away by Build."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import bpy
import making
import pytest


def ticked() -> set[str]:
    return {action.name for action in bpy.data.actions if action.fragmotion.use}


def test_the_takes_are_listed_by_name_or_length(addon: ModuleType) -> None:
    making.open_sample()
    actions, scene = list(bpy.data.actions), bpy.context.scene
    rate = scene.render.fps / scene.render.fps_base
    seconds = [(action.frame_range[1] - action.frame_range[0]) / rate for action in actions]
    assert addon.panels.panel._order(actions, scene, "NAME") == []
    for order, sign in (("SHORTEST", 1), ("LONGEST", -1)):
        places = addon.panels.panel._order(actions, scene, order)
        assert sorted(places) == list(range(len(actions)))
        listed = [sign * length for _, length in sorted(zip(places, seconds))]
        assert listed == sorted(listed)


def test_an_imported_take_is_as_long_as_it_was_whatever_the_scenes_rate(addon: ModuleType, tmp_path: Path) -> None:
    bpy.context.scene.render.fps = 30
    path = making.write_bvh(tmp_path / "take.bvh", frames=61, frame_time=1 / 60)
    assert bpy.ops.fragmotion.import_mocap(directory=str(tmp_path), files=[{"name": path.name}]) == {"FINISHED"}
    (action,) = bpy.data.actions
    for rate in (30, 24):
        bpy.context.scene.render.fps = rate
        assert addon.mocap.actions.seconds_of(action, bpy.context.scene) == pytest.approx(1.0, abs=1e-4)


def test_only_what_is_found_is_ticked_and_no_move(addon: ModuleType) -> None:
    moves = {row.action.name for row in making.open_sample().fragmotion.moves}
    everything = {action.name for action in bpy.data.actions} - moves
    assert len(moves) == 3
    assert bpy.ops.fragmotion.tick_actions(use=False) == {"FINISHED"} and ticked() == set()
    assert bpy.ops.fragmotion.tick_actions(use=True, search="RUN") == {"FINISHED"}
    assert ticked() == {name for name in everything if "run" in name} and len(ticked()) > 3
    assert bpy.ops.fragmotion.tick_actions(use=True) == {"FINISHED"} and ticked() == everything


def test_build_folds_away_what_led_to_it(addon: ModuleType) -> None:
    making.open_sample()
    settings, panels = bpy.context.window_manager.fragmotion, addon.panels
    subs = [panels.bones.FRAGMOTION_PT_bones, panels.panel.FRAGMOTION_PT_training]
    settings.show_mocap = settings.show_build = False
    assert all(panel.poll(bpy.context) for panel in subs), "before there is a character all is open"
    settings.show_mocap = settings.show_build = True
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=20, synthesize=False) == {"FINISHED"}
    assert not (settings.show_mocap or settings.show_build or any(panel.poll(bpy.context) for panel in subs))
    settings.show_mocap = True
    assert [panel.poll(bpy.context) for panel in subs] == [True, False]


def test_what_moves_a_head_alone_is_offered_to_the_one_armature_that_has_it(addon: ModuleType) -> None:
    """An animal's Idle; that of a prop with a bone of the same name is not taken for one."""
    obj, fits = making.add_armature(), addon.mocap.actions.fits
    assert len(obj.data.bones) > 4
    obj.pose.bones["head"].keyframe_insert("rotation_quaternion", frame=1)
    action = obj.animation_data.action
    assert fits(action, obj) and addon.mocap.actions.fitting(obj) == [action]
    prop = making.add_armature([("head", None, (0, 0, 0), (0, 0, 1))], name="Prop")
    assert not fits(action, obj) and addon.mocap.actions.fitting(obj) == []
    assert fits(action, prop)
