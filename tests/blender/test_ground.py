# SPDX-License-Identifier: MIT
"""What an armature stands on: meshes and collections, in Drive, Bake and Populate, and what is no ground."""

from __future__ import annotations

import math
from types import ModuleType
from typing import Any

import bpy
import driving
import numpy as np
import pytest

ANGLE = math.radians(20)


def add_mesh(name: str, points: list[tuple[float, float, float]], faces: list[tuple[int, ...]]) -> bpy.types.Object:
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, [], faces)
    ground = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(ground)
    bpy.context.view_layer.update()
    return ground


def add_slope(size: float = 100.0) -> bpy.types.Object:
    """A square that rises along y, tilted by its object."""
    corners = [(-size, -size, 0.0), (size, -size, 0.0), (size, size, 0.0), (-size, size, 0.0)]
    ground = add_mesh("Slope", corners, [(0, 1, 2, 3)])
    ground.rotation_euler.x = ANGLE
    bpy.context.view_layer.update()
    return ground


def add_stairs() -> bpy.types.Object:
    points: list[tuple[float, float, float]] = []
    for step in range(-40, 40):
        points += [(x, 0.3 * (step + y), 0.18 * step) for x, y in ((-50, 0), (50, 0), (50, 1), (-50, 1))]
    return add_mesh("Stairs", points, [tuple(range(4 * i, 4 * i + 4)) for i in range(80)])


def stand_on(obj: bpy.types.Object, ground: Any) -> None:
    settings = obj.fragmotion.ground
    settings.kind = "OBJECT" if isinstance(ground, bpy.types.Object) else "COLLECTION"
    setattr(settings, settings.kind.lower(), ground)


def bake(obj: bpy.types.Object) -> np.ndarray:
    """The hips in the world [F,3] of two seconds of a walker."""
    assert bpy.ops.fragmotion.bake(seconds=2, trace_source="PLAYER", player="walker") == {"FINISHED"}
    hips = []
    for frame in range(1, 40):
        bpy.context.scene.frame_set(frame)
        hips.append(driving.hips(obj).copy())
    return np.array(hips)


@pytest.mark.parametrize(("make", "rise"), [(add_slope, math.tan(ANGLE)), (add_stairs, 0.6)])
@pytest.mark.parametrize("in_collection", [False, True])
def test_a_bake_follows_the_ground(obj: bpy.types.Object, make: Any, rise: float, in_collection: bool) -> None:
    plane, ground = bake(obj), make()
    collection = bpy.data.collections.new("Grounds")
    collection.objects.link(ground)
    stand_on(obj, collection if in_collection else ground)
    seen = bake(obj)
    np.testing.assert_allclose(seen[:, :2], plane[:, :2], atol=1e-4)
    assert np.ptp(seen[:, 1]) > 0.5, "it goes nowhere"
    np.testing.assert_allclose(seen[:, 2], plane[:, 2] + rise * seen[:, 1], atol=0.45)
    assert np.ptp(seen[:, 2] - plane[:, 2]) > 0.2


def lowest_feet(obj: bpy.types.Object) -> np.ndarray:
    """How high the lowest joint of a baked character's feet is over the slope, or a plane that rises so, [F]."""
    feet = [bone.name for bone in obj.data.bones if bone.name.startswith(("foot", "toe"))]
    lowest = []
    for frame in range(1, 40):
        bpy.context.scene.frame_set(frame)
        places = [obj.matrix_world @ obj.pose.bones[name].head for name in feet]
        lowest.append(min(place.z - math.tan(ANGLE) * place.y for place in places))
    return np.array(lowest)


def test_a_character_that_its_object_makes_taller_goes_as_far_and_stands_on_the_ground(obj: bpy.types.Object) -> None:
    plane = bake(obj)
    stand_on(obj, add_slope())
    bake(obj)
    stands = lowest_feet(obj)
    obj.fragmotion.ground.kind = "PLANE"
    obj.scale.z *= 1.206
    bpy.context.view_layer.update()
    np.testing.assert_allclose(bake(obj), plane * [1, 1, 1.206], atol=2e-4)
    obj.fragmotion.ground.kind = "OBJECT"
    bake(obj)
    np.testing.assert_allclose(lowest_feet(obj), stands, atol=0.05)


def test_a_drive_stands_on_the_ground_and_says_where_there_is_none(session: ModuleType, obj: bpy.types.Object) -> None:
    ground = add_slope(size=0.5)
    ground.location.z = 3
    bpy.context.view_layer.update()
    stand_on(obj, ground)
    driven = driving.start(session, obj)
    driving.go_on(driven, 0.5)
    assert 3 < driving.hips(obj)[2] < 5
    driven.play(np.tile([0, 1.2, 0, 0], (40, 1)))
    driving.go_on(driven, 3.0)
    assert any("no ground" in message for message in driven.inputs.messages)
    assert driving.hips(obj)[2] > 2, "it goes on at the height that it had"


def test_copies_stand_on_the_ground_at_their_places(obj: bpy.types.Object) -> None:
    stand_on(obj, add_slope())
    former = set(bpy.data.objects)
    assert bpy.ops.fragmotion.populate(count=4, seconds=1, spacing=3) == {"FINISHED"}
    bpy.context.scene.frame_set(1)
    for copy in set(bpy.data.objects) - former:
        if copy.type == "ARMATURE":
            hips = driving.hips(copy)
            assert 0.4 < hips[2] - math.tan(ANGLE) * hips[1] < 1.4, copy.name


def _no_faces() -> Any:
    return add_mesh("Points", [(0, 0, 0), (1, 0, 0)], [])


def _disabled() -> Any:
    ground = add_slope()
    ground.hide_viewport = True
    return ground


def _only_hidden() -> Any:
    collection = bpy.data.collections.new("Hidden")
    bpy.context.scene.collection.children.link(collection)
    ground = add_slope()
    collection.objects.link(ground)
    bpy.context.scene.collection.objects.unlink(ground)
    bpy.context.view_layer.update()
    ground.hide_set(True)
    return collection


@pytest.mark.parametrize(
    ("make", "cause"),
    [(_no_faces, "has no faces"), (_disabled, "is disabled"), (_only_hidden, "no mesh that is visible")],
)
def test_what_is_no_ground_is_refused_in_a_sentence(obj: bpy.types.Object, make: Any, cause: str) -> None:
    stand_on(obj, make())
    actions = set(bpy.data.actions)
    with pytest.raises(RuntimeError, match=cause):
        bpy.ops.fragmotion.bake(seconds=1)
    assert set(bpy.data.actions) == actions


def test_without_a_choice_it_says_so(obj: bpy.types.Object) -> None:
    for kind in ("OBJECT", "COLLECTION"):
        obj.fragmotion.ground.kind = kind
        with pytest.raises(RuntimeError, match="none is chosen"):
            bpy.ops.fragmotion.bake(seconds=1)


def test_ground_that_moves_is_said_to(addon: ModuleType, obj: bpy.types.Object) -> None:
    ground = add_slope()
    ground.keyframe_insert("location", frame=1)
    stand_on(obj, ground)
    assert "moves" in addon.ground.meshes.find_ground(bpy.context, obj).remark
