# SPDX-License-Identifier: MIT
"""Fingers that nothing moves are relaxed, or as in a pose of one's own; those that a take moves stay as they are."""

from __future__ import annotations

import math
from pathlib import Path
from types import ModuleType

import bpy
import making
import pytest
from mathutils import Matrix, Quaternion, Vector

FINGERS = ("thumb", "index", "middle", "ring", "pinky")
BENT = (45.0, 37.5, 15.0)
PACKED = 2e-3  # rad: within what a kept pose is as captured
ACROSS = Vector((0, 1, 0))  # a hand at rest, from its index finger on: the body faces -Y


@pytest.fixture(scope="module")
def built(addon: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Takes on a body with splayed fingers, of which no take says anything, saved."""
    path = tmp_path_factory.mktemp("hands") / "hands.blend"
    making.open_sample().fragmotion.moves.clear()
    obj = bpy.context.view_layer.objects.active
    with making.editing(obj) as bones:
        for side in "LR":
            hand = bones[f"hand.{side}"]
            along = (hand.tail - hand.head).normalized()
            for number, finger in enumerate(FINGERS):
                splay = Matrix.Rotation(math.radians(12) * (number - 2), 3, along.cross(ACROSS))
                way, parent = splay @ along, hand
                head = hand.head + 0.09 * along + 0.02 * (number - 2) * ACROSS
                for joint in range(3):
                    bone = bones.new(f"{finger}_{joint + 1}.{side}")
                    bone.parent, bone.head, bone.tail, bone.roll = parent, head, head + 0.03 * way, 0.4 * number
                    parent, head = bone, bone.tail.copy()
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


def build_and_bake(seconds: float = 2.0) -> None:
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=12, synthesize=False, seconds=10.0) == {"FINISHED"}
    assert bpy.ops.fragmotion.bake("EXEC_DEFAULT", trace_source="PLAYER", seconds=seconds) == {"FINISHED"}
    bpy.context.scene.frame_set(20)


def way(obj: bpy.types.Object, bone: str) -> Vector:
    """Where a bone points, as Blender shows it."""
    shown = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).pose.bones[bone]
    return (shown.tail - shown.head).normalized()


def test_fingers_are_bent_and_side_by_side(obj: bpy.types.Object) -> None:
    build_and_bake()
    for side in "LR":
        for finger in FINGERS[1:]:
            ways = [way(obj, f"{finger}_{joint}.{side}") for joint in (1, 2, 3)]
            for joint in (1, 2):
                assert math.degrees(ways[joint - 1].angle(ways[joint])) == pytest.approx(BENT[joint], abs=0.2)
            for joint in (1, 2, 3):
                assert way(obj, f"middle_{joint}.{side}").angle(ways[joint - 1]) < 0.01
        hand = obj.data.bones[f"hand.{side}"]
        shown = obj.pose.bones[f"hand.{side}"].matrix.to_3x3() @ hand.matrix_local.to_3x3().inverted()
        along = (hand.tail_local - hand.head_local).normalized()
        rested = shown @ along
        assert math.degrees(rested.angle(way(obj, f"middle_1.{side}"))) == pytest.approx(45, abs=1)
        palm = shown @ along.cross(ACROSS if side == "R" else -ACROSS)
        assert palm.dot(way(obj, f"middle_2.{side}")) > 0.9
        thumb = obj.pose.bones[f"thumb_1.{side}"].rotation_quaternion
        assert abs(Quaternion().rotation_difference(thumb).angle) < 1e-3


def test_a_hand_pose_of_ones_own_is_taken_in_mirror_images_too(addon: ModuleType, obj: bpy.types.Object) -> None:
    takes = list(bpy.data.actions)
    obj.animation_data.action = None
    fist = bpy.data.actions.new("Fist")
    obj.animation_data.action = fist
    bone = obj.pose.bones["index_1.L"]
    bone.rotation_mode = "QUATERNION"
    bone.rotation_quaternion = Quaternion((1, 0, 0), 0.8)
    bone.keyframe_insert("rotation_quaternion", frame=7)
    obj.animation_data.action = takes[0]
    obj.fragmotion.hands, obj.fragmotion.build.mirror = "ACTION", True
    with pytest.raises(RuntimeError, match="hand pose is chosen"):
        build_and_bake()
    obj.fragmotion.hand_action = fist
    build_and_bake(20.0)
    character, core = addon.character.building.load(obj), addon.compat.core.core
    trace = core.simulate_trace("walker", 20.0, 1, character.space)
    played = core.Player(character, seed=1).run(trace, 60.0).fragments
    assert "mirrored" in {character.fragment_origins[fragment] for fragment in played}, (
        "what is baked has no mirror image in it"
    )
    for frame in range(1, 600, 7):
        bpy.context.scene.frame_set(frame)
        turned = obj.pose.bones["index_1.L"].rotation_quaternion
        assert turned.rotation_difference(Quaternion((1, 0, 0), 0.8)).angle == pytest.approx(0, abs=PACKED)
        for bone in ("ring_1.L", "index_1.R"):
            assert obj.pose.bones[bone].rotation_quaternion.angle == pytest.approx(0, abs=PACKED)


def test_fingers_rest_where_that_is_wanted(obj: bpy.types.Object) -> None:
    obj.fragmotion.hands = "REST"
    build_and_bake()
    for finger in FINGERS:
        assert obj.pose.bones[f"{finger}_2.R"].rotation_quaternion.angle == pytest.approx(0, abs=1e-3)
