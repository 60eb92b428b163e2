# SPDX-License-Identifier: MIT
"""A control rig follows its motion skeleton, live and as keys, and is let go as it was."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from types import ModuleType

import bpy
import layouts
import making
import numpy as np
import pytest
from mathutils import Matrix

WALK = making.MOCAP / "bandai-namco" / "dataset-1_walk_normal_001.bvh"
EXACT, BENT = 1e-3, 2e-3  # m; the latter for a knee that the rig's own IK bends
FRAMES = 8
FINGERS = {"thumb": "thumb", "index": "f_index", "middle": "f_middle", "ring": "f_ring", "pinky": "f_pinky"}
SIDED = {
    **{part: part for part in ("shoulder", "upper_arm", "hand", "thigh", "shin", "foot", "toe")},
    "lower_arm": "forearm",
    **{f"{role}_{number}": f"{bone}.0{number}" for role, bone in FINGERS.items() for number in (1, 2, 3)},
}
RIGIFY_ROLES = {
    **{"hips": "spine", "spine_1": "spine.001", "spine_2": "spine.002", "spine_3": "spine.003"},
    **{"neck_1": "spine.004", "neck_2": "spine.005", "head": "spine.006"},
    **{f"{side}_{role}": f"{bone}.{side[0].upper()}" for role, bone in SIDED.items() for side in ("left", "right")},
}


def bind(addon: ModuleType, rig: bpy.types.Object) -> bpy.types.Object:
    """The rig's new motion skeleton."""
    assert bpy.ops.fragmotion.bind_rig() == {"FINISHED"}
    return addon.control_rig.binding.motion_of(rig)


def heads(addon: ModuleType, rig: bpy.types.Object, frames: Iterable[int]) -> tuple[list[str], np.ndarray, np.ndarray]:
    """Roles, and the places [F,R,3], m, of their joints in their armatures: of the rig as it deforms, and of its motion
    skeleton."""
    motion, joints = addon.control_rig.binding.motion_of(rig), addon.control_rig.joints.find_joints(rig)
    name_of = addon.control_rig.following.bone_name
    roles = [role for role in joints if name_of(role) in motion.data.bones]
    places = []
    for frame in frames:
        bpy.context.scene.frame_set(frame)
        graph = bpy.context.evaluated_depsgraph_get()
        posed, plain = rig.evaluated_get(graph).pose.bones, motion.evaluated_get(graph).pose.bones
        deformed = [posed[joints[role].bone].head.copy() for role in roles]
        places.append((deformed, [plain[name_of(role)].head.copy() for role in roles]))
    metres = rig.matrix_world.median_scale * np.array(places)
    return roles, metres[:, 0], metres[:, 1]


def assert_follows(addon: ModuleType, rig: bpy.types.Object, frames: Iterable[int]) -> np.ndarray:
    """The rig's joints are where its motion skeleton's are; where they are."""
    roles, deformed, plain = heads(addon, rig, frames)
    apart = np.linalg.norm(deformed - plain, axis=-1).max(axis=0)
    by_ik = {"left_shin", "right_shin"} if "c_leg_pole.l" in rig.data.bones and "c_leg.l" not in rig.data.bones else {}
    for role, distance in zip(roles, apart):
        assert distance < (BENT if role in by_ik else EXACT), f"{role} is {1000 * distance:.1f} mm off"
    assert np.ptp(plain, axis=0).max() > 0.1, "nothing moved"
    return deformed


@pytest.mark.thorough
def test_the_parts_of_rigifys_body_are_told_right(addon: ModuleType, rigify: bpy.types.Object) -> None:
    joints = addon.control_rig.joints.find_joints(rigify)
    assert {role: joint.bone for role, joint in joints.items()} == {
        role: f"DEF-{bone}" for role, bone in RIGIFY_ROLES.items()
    }


def test_the_motion_skeleton_is_where_its_rig_is(addon: ModuleType) -> None:
    rig = layouts.add_layout()
    rig.matrix_world = ((0, -2, 0, 3), (2, 0, 0, -1), (0, 0, 2, 0.5), (0, 0, 0, 1))
    bpy.context.view_layer.update()
    np.testing.assert_allclose(bind(addon, rig).matrix_world, rig.matrix_world, atol=1e-6)


def test_the_motion_skeleton_is_plain_bones_through_the_same_joints(addon: ModuleType, bound: bpy.types.Object) -> None:
    rig, motion = bound, addon.control_rig.binding.motion_of(bound)
    assert not any(bone.constraints for bone in motion.pose.bones)
    assert motion.hide_get() and bpy.context.view_layer.objects.active == rig
    roles = addon.rig.rigs.make_rig(motion).skeleton.role_map()
    joints = addon.control_rig.joints.find_joints(rig)
    for role, bone in addon.rig.bodies.chosen_roles(motion).items():
        assert roles[role][0] == bone
        np.testing.assert_allclose(motion.data.bones[bone].head_local, joints[role].head, atol=1e-6)
    knees = motion.data.bones["thigh.L"].tail_local - motion.data.bones["shin.L"].head_local
    assert knees.length < 1e-6


@pytest.mark.parametrize("bound", [pytest.param("rigify", marks=pytest.mark.thorough), "FK"], indirect=True)
def test_the_rig_follows_any_pose_and_its_keys_show_the_same(addon: ModuleType, bound: bpy.types.Object) -> None:
    rig, motion = bound, addon.control_rig.binding.motion_of(bound)
    rig.location, rig.rotation_euler.z = (1, 2, 0), 0.6
    making.add_action(motion, FRAMES, name="waves")
    live = assert_follows(addon, rig, range(1, FRAMES + 1))
    bpy.context.scene.frame_set(3)
    assert bpy.ops.fragmotion.bake_to_controls("EXEC_DEFAULT") == {"FINISHED"}
    assert bpy.context.scene.frame_current == 3 and not addon.control_rig.binding.follows(rig)
    motion.animation_data.action = None
    _, baked, _ = heads(addon, rig, range(1, FRAMES + 1))
    np.testing.assert_allclose(baked, live, atol=1e-4)
    action = bpy.data.actions["waves on " + rig.name]
    assert rig.animation_data.action == action and action not in addon.mocap.actions.fitting(motion)
    assert bpy.ops.fragmotion.follow_motion() == {"FINISHED"} and addon.control_rig.binding.follows(rig)


def test_the_panel_of_a_rig_that_follows_leaves_bake_where_it_was(addon: ModuleType) -> None:
    layouts.add_layout()
    classes = addon.panels.panel.CLASSES

    def panels() -> list[str]:
        tops = [each for each in classes if issubclass(each, bpy.types.Panel) and not hasattr(each, "bl_parent_id")]
        return [each.bl_label for each in tops if getattr(each, "poll", bool)(bpy.context)]

    before = panels()
    assert before.index("Control Rig") < before.index("Mocap") and before.count("Control Rig") == 1
    bind(addon, bpy.context.object)
    after = panels()
    assert after.index("Control Rig") == after.index("Bake") + 1 and after.count("Control Rig") == 1


@pytest.mark.parametrize("size", [0.01, 100])
def test_a_rig_of_another_unit_follows(addon: ModuleType, size: float) -> None:
    rig = layouts.add_layout()
    rig.data.transform(Matrix.Scale(size, 4))
    rig.scale = 3 * [1 / size]
    bpy.context.view_layer.update()
    making.add_action(bind(addon, rig), FRAMES)
    assert len(rig.fragmotion.control_rig.switches) == 2
    assert_follows(addon, rig, range(1, FRAMES + 1))


@pytest.mark.skipif(not WALK.exists(), reason="no motion capture beside the project")
def test_takes_build_and_bake_work_with_the_rig_selected(
    addon: ModuleType, bound: bpy.types.Object, tmp_path: Path
) -> None:
    rig, motion = bound, addon.control_rig.binding.motion_of(bound)
    for path in WALK.parent.glob("dataset-1_walk_normal_00[12].bvh"):
        (tmp_path / path.name).write_bytes(path.read_bytes())
    assert bpy.ops.fragmotion.import_mocap(directory=str(tmp_path), onto="ACTIVE") == {"FINISHED"}
    assert_follows(addon, rig, range(1, 150, 4))
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"} and motion.fragmotion.policy
    assert bpy.ops.fragmotion.bake("EXEC_DEFAULT", seconds=2) == {"FINISHED"}
    live = assert_follows(addon, rig, range(1, 40, 3))
    assert bpy.ops.fragmotion.bake_to_controls("EXEC_DEFAULT") == {"FINISHED"}
    np.testing.assert_allclose(heads(addon, rig, range(1, 40, 3))[1], live, atol=1e-3)
    assert bpy.ops.fragmotion.unbind_rig() == {"FINISHED"}
    assert rig.animation_data.action.name.endswith(f"on {rig.name}")


def test_unbinding_gives_the_rig_back_as_it_was(addon: ModuleType, rig: bpy.types.Object) -> None:
    control = next(bone for bone in rig.pose.bones if bone.custom_shape and "shoulder" in bone.name)
    control["note"] = 3
    control.location.x = 0.1
    control.keyframe_insert("location", frame=1)
    rig.animation_data.nla_tracks.new().name = "Dance"
    rig.animation_data.action.use_fake_user = True
    bpy.ops.object.mode_set(mode="POSE")
    before = layouts.everything(rig)
    motion = bind(addon, rig)
    assert rig.animation_data.action is None and bpy.context.mode == "POSE"
    making.add_action(motion, 3).use_fake_user = True
    bpy.context.scene.frame_set(2)
    bpy.context.scene.frame_set(1)
    bpy.data.actions.remove(bpy.data.actions["take"])
    assert bpy.ops.fragmotion.unbind_rig() == {"FINISHED"}
    after = layouts.everything(rig)
    assert {key: (before[key], after[key]) for key in before if before[key] != after[key]} == {}


def test_unbinding_a_copy_leaves_the_rig_its_motion_skeleton(addon: ModuleType) -> None:
    rig = layouts.add_layout()
    making.add_action(bind(addon, rig))
    copy = rig.copy()
    bpy.context.scene.collection.objects.link(copy)
    making.activate(copy)
    assert bpy.ops.fragmotion.unbind_rig() == {"FINISHED"}
    assert not any(True for _ in addon.control_rig.following.constraints_of(copy))
    assert_follows(addon, rig, range(1, 6))


def test_a_cancelled_bake_leaves_everything(addon: ModuleType) -> None:
    rig = layouts.add_layout()
    making.add_action(bind(addon, rig))
    bpy.context.scene.frame_set(4)
    assert bpy.ops.fragmotion.follow_motion() == {"FINISHED"}
    before = layouts.everything(rig)
    baking = addon.control_rig.baking
    job = addon.jobs.SteppedJob("Baking", "frames", baking.step(bpy.context, rig, baking.span(rig)))
    job.start()
    job.wait(0)
    assert job.running and 0 < job.fraction < 1 and bpy.context.scene.frame_current == 1
    job.cancel()
    assert not job.running and layouts.everything(rig) == before
    with pytest.raises(addon.compat.core.core.Cancelled):
        job.result()


@pytest.mark.thorough
def test_a_cancelled_search_for_controls_leaves_everything(addon: ModuleType, rigify: bpy.types.Object) -> None:
    before = layouts.everything(rigify)
    binding = addon.control_rig.binding
    job = addon.jobs.SteppedJob("Trying", "switches", binding.bind(bpy.context, rigify))
    job.start()
    for _ in range(3):
        job.wait(0)
    assert job.running and 0 < job.fraction < 1
    job.cancel()
    assert not job.running and not binding.is_bound(rigify)
    assert layouts.everything(rigify) == before


def test_a_file_keeps_what_follows(addon: ModuleType, tmp_path: Path) -> None:
    making.add_action(bind(addon, layouts.add_layout()))
    path = tmp_path / "bound.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    bpy.ops.wm.open_mainfile(filepath=str(path))
    rig = bpy.data.objects["Hero"]
    assert_follows(addon, rig, range(1, 6))
    assert bpy.ops.fragmotion.unbind_rig() == {"FINISHED"}
    assert [obj.name for obj in bpy.data.objects if obj.type == "ARMATURE"] == ["Hero"]
