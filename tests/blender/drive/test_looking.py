# SPDX-License-Identifier: MIT
"""Head and chest look where it goes or at an object: in drives, recordings, changes of them, and bakes."""

from __future__ import annotations

import math
from types import ModuleType
from typing import Any

import bpy
import numpy as np
import pytest
from driving import go_on
from mathutils import Vector


def put(place: tuple[float, float, float]) -> bpy.types.Object:
    """An object to look at."""
    thing = bpy.data.objects.new("Thing", None)
    bpy.context.scene.collection.objects.link(thing)
    thing.location = place
    bpy.context.view_layer.update()
    return thing


def look_at(obj: bpy.types.Object, thing: bpy.types.Object | None) -> None:
    obj.fragmotion.look.kind, obj.fragmotion.look.object = "OBJECT", thing


def aside(obj: bpy.types.Object, frame: int, place: Vector) -> float:
    """How far the place is aside of where the head faces on a frame, as Blender shows it; rad. The head faces the front
    where it rests."""
    bpy.context.scene.frame_set(frame)
    head = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).pose.bones["head"]
    rest = obj.data.bones["head"].matrix_local.to_3x3()
    faces = obj.matrix_world.to_3x3() @ head.matrix.to_3x3() @ rest.inverted() @ Vector((0, -1, 0))
    way = place - obj.matrix_world @ head.head
    return math.remainder(math.atan2(way.y, way.x) - math.atan2(faces.y, faces.x), 2 * math.pi)


def test_a_bake_looks_at_an_object(addon: ModuleType, obj: bpy.types.Object) -> None:
    thing = put((7.0, -20.0, 1.6))
    actions = {}
    for name, at in (("plain", None), ("looks", thing)):
        look_at(obj, at)
        assert bpy.ops.fragmotion.bake(
            "EXEC_DEFAULT", trace_source="PLAYER", player="walker", seconds=6.0, action=name
        ) == {"FINISHED"}
        actions[name] = [abs(aside(obj, frame, thing.location)) for frame in range(30, 140, 3)]
    plain, looks = (np.array(actions[name]) for name in ("plain", "looks"))
    assert (looks <= plain + 0.05).all() and (plain > 0.3).any()
    near = plain < 0.4
    assert near.any() and (looks[near][5:] < 0.05).all()


def test_a_drive_is_replayed_with_where_it_looked(
    addon: ModuleType, session: ModuleType, obj: bpy.types.Object
) -> None:
    thing = put((1.0, -3.0, 1.2))
    driven = session.start(bpy.context, obj)
    driven.toggle_recording()
    driven.inputs.keyboard.press("W")
    go_on(driven, 1)
    look_at(obj, thing)
    go_on(driven, 1)
    thing.location.x = -2.0
    bpy.context.view_layer.update()
    go_on(driven, 1)
    obj.fragmotion.look.kind = "AHEAD"
    go_on(driven, 0.5)
    session.stop()
    recordings = addon.recordings.recordings
    recording = obj.fragmotion.recordings[0]
    looks = recordings.looks_of(recording)
    assert [(look.control, look.look) for look in looks] == [(10, 2), (20, 2), (30, 1)]
    assert looks[1].x == pytest.approx(-2.0)
    shown = recordings.shown_of(recording)[1]
    again = addon.edits.replaying.replay(
        obj, addon.character.building.load(obj), recording, recordings.trace_of(recording), recording.seed
    )
    np.testing.assert_allclose(again.rotations, shown.rotations, atol=1e-5)
    assert recordings.asked_between(recording, 15, 35).looks[0][:2] == (0, 2)


def test_a_recording_looks_elsewhere_from_the_playhead_on(
    addon: ModuleType, session: ModuleType, obj: bpy.types.Object
) -> None:
    recordings = addon.recordings.recordings
    trace = addon.compat.core.core.simulate_trace("walker", 5.0, 2)
    recording = recordings.add_recording(obj, trace, name="Stroll", seed=3)
    addon.edits.replaying.play_again(obj, recording, trace, 0)
    before = recordings.shown_of(recording)[1]
    thing = put((3.0, 3.0, 1.5))
    look_at(obj, thing)
    scene = bpy.context.scene
    scene.frame_set(obj.fragmotion.bake.frame_start + 2 * scene.render.fps)
    digest = recordings.digest_of(recording)
    assert bpy.ops.fragmotion.look_recording("EXEC_DEFAULT") == {"FINISHED"}
    recording = obj.fragmotion.recordings[0]
    after = recordings.shown_of(recording)[1]
    assert [look[:2] for look in recordings.looks_of(recording)] == [(20, 2)]
    assert recordings.digest_of(recording) != digest
    np.testing.assert_array_equal(after.rotations[:121], before.rotations[:121])
    np.testing.assert_allclose(after.root_positions, before.root_positions, atol=1e-6)
    assert np.abs(after.rotations[200:] - before.rotations[200:]).max() > 0.01
    obj.fragmotion.look.kind = "CAPTURED"
    assert bpy.ops.fragmotion.look_recording("EXEC_DEFAULT") == {"FINISHED"}
    assert not recordings.looks_of(obj.fragmotion.recordings[0])
    scene.frame_set(1000)
    with pytest.raises(RuntimeError, match="move it onto the recording"):
        bpy.ops.fragmotion.look_recording("EXEC_DEFAULT")


@pytest.mark.parametrize(
    "text", ["[[0, 3, 0, 0, 0]]", '[[0, 1, "x", 0, 0]]', "[[99, 1, 0, 0, 0]]", "[[0, 2, 1e12, 0, 0]]", "{"]
)
def test_damaged_looks_are_told(addon: ModuleType, obj: bpy.types.Object, text: str) -> None:
    recordings = addon.recordings.recordings
    recording: Any = recordings.add_recording(obj, np.zeros((5, 4)), name="Odd")
    recording.looks = text
    with pytest.raises(addon.errors.UserError, match="damaged"):
        recordings.looks_of(recording)
