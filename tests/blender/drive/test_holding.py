# SPDX-License-Identifier: MIT
"""Hands hold things or reach for them: in drives, recordings, changes of them, and bakes."""

from __future__ import annotations

from types import ModuleType
from typing import Any

import bpy
import numpy as np
import pytest
from driving import go_on
from mathutils import Vector


def put(place: tuple[float, float, float]) -> bpy.types.Object:
    """An object to hold."""
    thing = bpy.data.objects.new("Thing", None)
    bpy.context.scene.collection.objects.link(thing)
    thing.location = place
    bpy.context.view_layer.update()
    return thing


def key_weight(thing: bpy.types.Object, **weights: float) -> None:
    """Key how much it is held: f1=0.0 on frame 1."""
    for frame, weight in weights.items():
        thing.fragmotion.held = weight
        thing.keyframe_insert("fragmotion.held", frame=int(frame[1:]))


def palm(obj: bpy.types.Object, frame: int) -> Vector:
    """The middle of the right hand on a frame, as Blender shows it."""
    bpy.context.scene.frame_set(frame)
    return palm_now(obj)


def palm_now(obj: bpy.types.Object) -> Vector:
    """The middle of the right hand as Blender shows it."""
    hand = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).pose.bones["hand.R"]
    return obj.matrix_world @ ((hand.head + hand.tail) / 2)


def bake(name: str) -> None:
    assert bpy.ops.fragmotion.bake(
        "EXEC_DEFAULT", trace_source="PLAYER", player="walker", seconds=4.0, action=name
    ) == {"FINISHED"}


def test_a_bake_carries_an_object(addon: ModuleType, obj: bpy.types.Object) -> None:
    obj.location, obj.rotation_euler.z = (2.0, 1.0, 0.0), 0.7
    bpy.context.view_layer.update()
    thing = put(tuple(obj.matrix_world @ Vector((-0.25, -0.4, 1.2))))
    obj.fragmotion.right_hand.object, obj.fragmotion.right_hand.carried = thing, True
    bake("carries")
    carried = [palm(obj, frame) for frame in range(40, 90)]
    hips = []
    for frame in range(40, 90):
        bpy.context.scene.frame_set(frame)
        hips.append(obj.matrix_world @ obj.pose.bones["hips"].head)
    distances = [(a - b).xy.length for a, b in zip(carried, hips)]
    assert max(abs(place.z - 1.2) for place in carried) < 0.002
    assert max(distances) - min(distances) < 0.002
    assert distances[0] == pytest.approx(np.hypot(0.25, 0.4), abs=0.05)


def test_hands_reach_for_places_where_the_object_stretches_the_body(
    addon: ModuleType, session: ModuleType, obj: bpy.types.Object
) -> None:
    obj.scale.z *= 1.2
    bpy.context.view_layer.update()
    thing = put((-0.25, -0.4, 1.44))
    obj.fragmotion.right_hand.object, obj.fragmotion.right_hand.carried = thing, True
    bake("carries")
    assert max(abs(palm(obj, frame).z - 1.44) for frame in range(40, 90)) < 0.002
    driven = session.start(bpy.context, obj)
    go_on(driven, 2.0)
    assert palm_now(obj).z == pytest.approx(1.44, abs=0.002)


def test_a_bake_reaches_as_the_object_is_keyed(addon: ModuleType, obj: bpy.types.Object) -> None:
    bake("plain")
    plain = [palm(obj, frame) for frame in range(1, 97)]
    thing = put((-0.3, -0.35, 1.25))
    key_weight(thing, f1=0.0, f20=0.0, f40=1.0)
    obj.fragmotion.right_hand.object, obj.fragmotion.right_hand.carried = thing, True
    bpy.context.scene.frame_set(7)
    bake("reaches")
    assert bpy.context.scene.frame_current == 7
    reaches = [palm(obj, frame) for frame in range(1, 97)]
    off = [(a - b).length for a, b in zip(plain, reaches)]
    assert max(off[:18]) < 1e-4
    assert min(off[45:]) > 0.2
    assert 0.05 < off[30] < off[45]
    assert max(abs(place.z - 1.25) for place in reaches[45:]) < 0.002


def test_a_drive_is_replayed_with_what_it_held(addon: ModuleType, session: ModuleType, obj: bpy.types.Object) -> None:
    thing = put((-0.3, -0.4, 1.2))
    driven = session.start(bpy.context, obj)
    driven.toggle_recording()
    driven.inputs.keyboard.press("W")
    go_on(driven, 1)
    obj.fragmotion.right_hand.object, obj.fragmotion.right_hand.carried = thing, True
    go_on(driven, 1)
    thing.fragmotion.held = 0.5
    go_on(driven, 1)
    obj.fragmotion.right_hand.object = None
    go_on(driven, 0.5)
    session.stop()
    recordings = addon.recordings.recordings
    recording = obj.fragmotion.recordings[0]
    reaches = recordings.reaches_of(recording)
    assert [(reach.control, reach.hand, reach.weight, reach.carried) for reach in reaches] == [
        (10, 1, 1.0, 1),
        (20, 1, 0.5, 1),
        (30, 1, 0.0, 0),
    ]
    shown = recordings.shown_of(recording)[1]
    again = addon.edits.replaying.replay(
        obj, addon.character.building.load(obj), recording, recordings.trace_of(recording), recording.seed
    )
    np.testing.assert_allclose(again.rotations, shown.rotations, atol=1e-5)
    assert recordings.asked_between(recording, 15, 35).reaches[0][:4] == (0, 1, 1.0, 1)
    driven = session.start(bpy.context, obj)
    driven.play(*_played(recordings, recording))
    go_on(driven, 1.5)
    assert driven._holds[1].weight == 1.0


def _played(recordings: ModuleType, recording: Any) -> tuple[Any, ...]:
    asked = recordings.asked_of(recording)
    return (recordings.trace_of(recording), tuple(recording.start), [], recordings.numbered_styles(recording, []),
            asked.looks, asked.reaches)  # fmt: skip


def test_a_recording_holds_from_the_playhead_on(addon: ModuleType, session: ModuleType, obj: bpy.types.Object) -> None:
    recordings = addon.recordings.recordings
    trace = addon.compat.core.core.simulate_trace("walker", 5.0, 2)
    recording = recordings.add_recording(obj, trace, name="Stroll", seed=3)
    addon.edits.replaying.play_again(obj, recording, trace, 0)
    before = recordings.shown_of(recording)[1]
    obj.fragmotion.right_hand.object, obj.fragmotion.right_hand.carried = put((-0.3, -0.4, 1.2)), True
    scene = bpy.context.scene
    scene.frame_set(obj.fragmotion.bake.frame_start + 2 * scene.render.fps)
    digest = recordings.digest_of(recording)
    assert bpy.ops.fragmotion.reach_recording("EXEC_DEFAULT") == {"FINISHED"}
    recording = obj.fragmotion.recordings[0]
    after = recordings.shown_of(recording)[1]
    assert [reach[:3] for reach in recordings.reaches_of(recording)] == [(20, 1, 1.0)]
    assert recordings.digest_of(recording) != digest
    np.testing.assert_array_equal(after.rotations[:121], before.rotations[:121])
    np.testing.assert_allclose(after.root_positions, before.root_positions, atol=1e-6)
    assert np.abs(after.rotations[200:] - before.rotations[200:]).max() > 0.1
    scene.frame_set(obj.fragmotion.bake.frame_start + 3 * scene.render.fps)
    obj.fragmotion.right_hand.object = None
    assert bpy.ops.fragmotion.reach_recording("EXEC_DEFAULT") == {"FINISHED"}
    assert [reach[:3] for reach in recordings.reaches_of(obj.fragmotion.recordings[0])] == [(20, 1, 1.0), (30, 1, 0.0)]
    scene.frame_set(1000)
    with pytest.raises(RuntimeError, match="move it onto the recording"):
        bpy.ops.fragmotion.reach_recording("EXEC_DEFAULT")


@pytest.mark.parametrize(
    "text",
    [
        "[[0, 2, 1, 0, 0, 0, 0]]",
        "[[0, 1, 1.5, 0, 0, 0, 0]]",
        '[[0, 1, 1, 0, "x", 0, 0]]',
        "[[99, 1, 1, 0, 0, 0, 0]]",
        "[[0, 1, 1, 0, 1e12, 0, 0]]",
        "{",
    ],
)
def test_damaged_reaches_are_told(addon: ModuleType, obj: bpy.types.Object, text: str) -> None:
    recordings = addon.recordings.recordings
    recording: Any = recordings.add_recording(obj, np.zeros((5, 4)), name="Odd")
    recording.reaches = text
    with pytest.raises(addon.errors.UserError, match="damaged"):
        recordings.reaches_of(recording)
