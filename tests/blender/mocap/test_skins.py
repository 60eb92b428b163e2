# SPDX-License-Identifier: MIT
"""What a mesh that hangs on an armature tells of its bones."""

from __future__ import annotations

from types import ModuleType

import bpy
import making
import numpy as np
import pytest

WRIST = np.array([0.8, -0.1, 1.4])
ARMS = (
    ("lower_arm.L", "upper_arm.L", (0.5, 0, 1.4), tuple(WRIST)),
    ("hand.L", "lower_arm.L", tuple(WRIST), (0.8, -0.1, 1.5)),  # which ends as an importer makes it
)
WAY = np.array([0.1, -0.1, 0])


@pytest.fixture
def obj() -> bpy.types.Object:
    """A character away from the origin, whose left hand has no fingers and points up by its bone."""
    obj = making.add_armature([*(bone for bone in making.BODY if bone[0] != "hand.L"), *ARMS], name="Puppet")
    obj.location = (1, 2, 0)
    obj.rotation_euler.z = 0.5
    bpy.context.view_layer.update()
    return obj


def add_hand(obj: bpy.types.Object) -> bpy.types.Object:
    """A mesh like a mitten, in the armature's space but for its own scale."""
    mesh = making.add_mesh()
    side = np.array([0, 0, 0.02])
    points = [WRIST + share * WAY + sign * side for share in (0.2, 0.6, 1) for sign in (-1, 1)]
    mesh.data.from_pydata([tuple(2 * point) for point in points], [], [])
    mesh.scale = (0.5, 0.5, 0.5)
    mesh.matrix_world = obj.matrix_world @ mesh.matrix_basis
    return mesh


def deform(mesh: bpy.types.Object, obj: bpy.types.Object) -> None:
    """By vertex groups of which one is no bone's."""
    modifier = mesh.modifiers.new("Armature", "ARMATURE")
    modifier.object = obj
    vertices = range(len(mesh.data.vertices))
    for name, weight in (("clothes", 1.0), ("lower_arm.L", 0.2), ("hand.L", 0.6)):
        mesh.vertex_groups.new(name=name).add(list(vertices), weight, "REPLACE")


def hang(mesh: bpy.types.Object, obj: bpy.types.Object) -> None:
    """On the bone, before the armature is posed."""
    world = mesh.matrix_world.copy()
    mesh.parent, mesh.parent_type, mesh.parent_bone = obj, "BONE", "hand.L"
    bpy.context.view_layer.update()
    mesh.matrix_world = world
    pose = obj.pose.bones["upper_arm.L"]
    pose.rotation_mode, pose.rotation_euler = "XYZ", (1, 0.5, 0)


@pytest.mark.parametrize("attach", [deform, hang])
def test_a_hand_without_fingers_points_where_its_mesh_does(
    addon: ModuleType, obj: bpy.types.Object, attach: object
) -> None:
    assert callable(attach)
    attach(add_hand(obj), obj)
    bpy.context.view_layer.update()
    assert addon.rig.bodies.doubts_at_import(obj) == []
    body = addon.rig.bodies.make_body(obj, addon.rig.rigs.make_rig(obj))
    hand = body.skeleton.names.index("hand.L")
    tip = body.skeleton.rest_tails()[hand] - body.skeleton.rest_heads()[hand]
    np.testing.assert_allclose(tip, np.array(obj.matrix_world.to_3x3()) @ WAY, atol=1e-4)


def test_without_a_mesh_the_hand_is_doubtful(addon: ModuleType, obj: bpy.types.Object) -> None:
    making.add_mesh(obj)
    assert len(addon.rig.bodies.doubts_at_import(obj)) == 1


def test_a_foot_that_moves_no_mesh_is_none(addon: ModuleType, obj: bpy.types.Object) -> None:
    """Beside the one that does, which the names do not tell."""
    with making.editing(obj) as bones:
        real = bones["foot.L"]
        real.name = "joint.L"
        dead, toes = bones.new("foot.L"), bones.new("toes.L")
        dead.parent, dead.head, dead.tail = bones["shin.L"], real.head, real.tail
        toes.parent, toes.head, toes.tail = dead, real.tail, real.tail + real.tail - real.head
    rig = addon.rig.rigs.make_rig(obj)
    assert addon.rig.bodies.make_body(obj, rig).roles["left_foot"] == "foot.L"
    mesh = add_hand(obj)
    deform(mesh, obj)
    mesh.vertex_groups.new(name="joint.L").add([0], 0.5, "REPLACE")
    assert addon.rig.bodies.make_body(obj, rig).roles["left_foot"] == "joint.L"
    assert bpy.ops.fragmotion.find_bones() == {"FINISHED"}
    assert obj.fragmotion.roles["left_foot"].bone == "joint.L"


@pytest.fixture
def with_copies(obj: bpy.types.Object) -> bpy.types.Object:
    """Beside each leg is a copy of it that a mesh follows, as MMD's models have them; with an Action that turns all."""
    with making.editing(obj) as bones:
        for side in "LR":
            for part, above in (("thigh", "hips"), ("shin", f"thigh D.{side}"), ("foot", f"shin D.{side}")):
                real, copy = bones[f"{part}.{side}"], bones.new(f"{part} D.{side}")
                copy.head, copy.tail, copy.parent = real.head, real.tail, bones[above]
    mesh = add_hand(obj)
    deform(mesh, obj)
    for side in "LR":
        mesh.vertex_groups.new(name=f"foot D.{side}").add([0], 0.5, "REPLACE")
    making.add_action(obj, 40).fragmotion.use = True
    return obj


def test_of_two_legs_that_are_alike_build_takes_the_one_that_moves_the_mesh(
    addon: ModuleType, with_copies: bpy.types.Object
) -> None:
    assert bpy.ops.fragmotion.build() == {"FINISHED"}
    roles = addon.rig.rigs.make_rig(with_copies).skeleton.roles
    assert [roles[role] for role in ("left_thigh", "left_foot", "right_foot")] == ["thigh D.L", "foot D.L", "foot D.R"]
    assert with_copies.fragmotion.roles["left_shin"].bone == "shin D.L"


def test_copies_that_constraints_turn_are_no_legs(addon: ModuleType, with_copies: bpy.types.Object) -> None:
    for side in "LR":
        for part in ("thigh", "shin", "foot"):
            constraint = with_copies.pose.bones[f"{part} D.{side}"].constraints.new("COPY_ROTATION")
            constraint.target, constraint.subtarget = with_copies, f"{part}.{side}"
    assert bpy.ops.fragmotion.build() == {"FINISHED"}
    assert addon.rig.rigs.make_rig(with_copies).skeleton.roles["left_foot"] == "foot.L"
    assert bpy.ops.fragmotion.find_bones() == {"FINISHED"}
    assert with_copies.fragmotion.roles["left_foot"].bone == "foot.L"
