# SPDX-License-Identifier: MIT
"""Takes of NLA strips hold what Blender's NLA shows of them, and stand in place of the strips' own Actions."""

from __future__ import annotations

from typing import Any

import bpy
import making
import numpy as np
import pytest

FRAMES = 24
STRIPS: dict[str, dict[str, Any]] = {
    "as it is": {},
    "slow": {"scale": 1.7},
    "fast": {"scale": 0.5},
    "repeated": {"repeat": 3.0},
    "repeated in part": {"repeat": 1.6, "scale": 0.8},
    "reversed": {"use_reverse": True},
    "reversed and repeated": {"use_reverse": True, "repeat": 2.0, "scale": 1.25},
    "cut": {"action_frame_start": 5.0, "action_frame_end": 17.0},
    "cut, slow, repeated and reversed": {
        "action_frame_start": 4.0,
        "action_frame_end": 15.0,
        "scale": 1.3,
        "repeat": 2.5,
        "use_reverse": True,
    },
}


def add_strip(obj: bpy.types.Object, start: int = 11, name: str = "strip", **settings: Any) -> bpy.types.NlaStrip:
    """The Action that the armature plays, as a strip on a new track."""
    action, track = obj.animation_data.action, obj.animation_data.nla_tracks.new()
    strip = track.strips.new(name, start, action)
    strip.name = name  # Blender 3.4 names it after the Action
    if bpy.app.version >= (4, 4, 0):
        strip.action_slot = action.slots[0]
    for key, value in settings.items():
        setattr(strip, key, value)
    return strip


def poses(obj: bpy.types.Object, frames: np.ndarray) -> np.ndarray:
    """Pose matrices of the body [F,B,4,4], as Blender shows what the armature plays now; a bone above it may rest."""
    hips, shown = obj.data.bones["hips"], []
    names = [bone.name for bone in (hips, *hips.children_recursive)]
    for frame in frames:
        bpy.context.scene.frame_set(int(np.floor(frame + 1e-4)), subframe=max(frame - np.floor(frame + 1e-4), 0))
        posed = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
        shown.append([np.array(posed.pose.bones[name].matrix) for name in names])
    return np.array(shown)


@pytest.fixture
def rig() -> bpy.types.Object:
    """A body that plays an Action, at the origin."""
    obj = making.add_armature()
    making.add_action(obj, FRAMES, name="walk").fragmotion.use = True
    return obj


def assert_holds(obj: bpy.types.Object, strip: bpy.types.NlaStrip, made: bpy.types.Action, step: float = 1.0) -> None:
    """The Action shows from frame 1 on what the strip does alone from its first frame on."""
    frames = np.arange(strip.frame_start, strip.frame_end + 1e-3, step)
    obj.animation_data.action = None
    bpy.context.scene.frame_set(0)
    nla = poses(obj, frames)
    obj.animation_data.use_nla = False
    obj.animation_data.action = made
    assert abs(made.frame_range[1] - made.frame_range[0] - step * (len(frames) - 1)) < 1e-3
    np.testing.assert_allclose(poses(obj, 1 + step * np.arange(len(frames))), nla, atol=2e-5)


@pytest.mark.parametrize("name", STRIPS)
def test_a_take_holds_what_the_nla_shows(rig: bpy.types.Object, name: str) -> None:
    strip = add_strip(rig, **STRIPS[name])
    rig.animation_data.action = None
    assert bpy.ops.fragmotion.take_strips() == {"FINISHED"}
    made = bpy.data.actions["strip"]
    assert made.fragmotion.use and not bpy.data.actions["walk"].fragmotion.use
    assert_holds(rig, strip, made)


def test_a_time_that_is_animated_is_the_takes(rig: bpy.types.Object) -> None:
    strip = add_strip(rig)
    strip.use_animated_time = True
    for frame, time in ((11, 3.0), (20, 20.0), (34, 9.0)):
        strip.strip_time = time
        strip.keyframe_insert("strip_time", frame=frame)
    rig.animation_data.action = None
    assert bpy.ops.fragmotion.take_strips() == {"FINISHED"}
    assert_holds(rig, strip, bpy.data.actions["strip"])


def test_an_imported_take_keeps_its_rate(rig: bpy.types.Object) -> None:
    rate = bpy.context.scene.render.fps
    bpy.data.actions["walk"]["fragmotion_rate"] = 2.0 * rate
    bpy.data.actions["walk"]["fragmotion_scene_rate"] = float(rate)
    strip = add_strip(rig, scale=1.5)
    rig.animation_data.action = None
    assert bpy.ops.fragmotion.take_strips() == {"FINISHED"}
    made = bpy.data.actions["strip"]
    assert made["fragmotion_rate"] == 2 * rate
    assert_holds(rig, strip, made, 0.5)


def test_what_plays_no_take_makes_none(rig: bpy.types.Object) -> None:
    with pytest.raises(RuntimeError, match="No NLA track of the armature has a strip"):
        bpy.ops.fragmotion.take_strips()
    muted, kept = add_strip(rig, name="muted"), add_strip(rig, 100, name="kept")
    muted.mute = True
    rig.animation_data.nla_tracks.new().strips.new("chair", 1, bpy.data.actions.new("chair"))
    rig.animation_data.action = None
    assert bpy.ops.fragmotion.take_strips() == {"FINISHED"}
    assert {action.name for action in bpy.data.actions} == {"walk", "chair", kept.name}


def test_a_take_of_a_strip_keeps_the_style_and_what_is_left_out(rig: bpy.types.Object) -> None:
    strip = add_strip(rig, use_reverse=True, repeat=2.0)
    action = strip.action
    action.fragmotion.style = "tired"
    span = action.fragmotion.left_out.add()
    span.first, span.last = 1, 5
    rig.animation_data.action = None
    assert bpy.ops.fragmotion.take_strips() == {"FINISHED"}
    made = bpy.data.actions["strip"]
    assert made.fragmotion.style == "tired"
    length = int(action.frame_range[1] - action.frame_range[0])
    spans = [(span.first, span.last) for span in made.fragmotion.left_out]
    assert spans == [(1 + length - 4, length), (1 + 2 * length - 4, 1 + 2 * length)]
