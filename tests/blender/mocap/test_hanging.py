# SPDX-License-Identifier: MIT
"""Feet that are targets of baked IK, and so no children of their legs, are learned and baked with them."""

from __future__ import annotations

import itertools
from types import ModuleType

import bpy
import making
import numpy as np
import pytest

FEET = {"foot.L": "shin.L", "foot.R": "shin.R"}


@pytest.fixture
def baked_ik(addon: ModuleType) -> bpy.types.Object:
    """The sample, whose feet hang on the root, with keys that bring them to where the legs end, as they were."""
    obj = making.open_sample()
    obj.fragmotion.moves.clear()
    action = bpy.data.actions["walk forward"]
    for each in bpy.data.actions:
        each.fragmotion.use = each == action
    first, last = (int(frame) for frame in action.frame_range)
    frames = range(first, last + 1)
    with addon.rig.posing.playing(bpy.context, obj, action):
        seen = {frame: _matrices(obj, frame) for frame in frames}
    with making.editing(obj) as bones:
        for name in FEET:
            bones[name].use_connect, bones[name].parent = False, bones["root"]
    addon.compat.versions.assign(obj, action)
    for frame in frames:
        bpy.context.scene.frame_set(frame)
        for name in FEET:
            obj.pose.bones[name].matrix = seen[frame][name]
            for channel in ("location", "rotation_quaternion"):
                obj.pose.bones[name].keyframe_insert(channel)
    return obj


def _matrices(obj: bpy.types.Object, frame: int) -> dict[str, object]:
    bpy.context.scene.frame_set(frame)
    posed = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return {name: posed.pose.bones[name].matrix.copy() for name in FEET}


def test_they_are_learned_as_parts_of_their_legs(addon: ModuleType, baked_ik: bpy.types.Object) -> None:
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    assert {row.name: row.on for row in baked_ik.fragmotion.hanging} == FEET
    skeleton = addon.character.building.load(baked_ik).skeleton
    for foot, shin in FEET.items():
        assert skeleton.names[skeleton.parents[skeleton.names.index(foot)]] == shin
    assert "alks" in baked_ik.fragmotion.figures.abilities


def test_bakes_bring_them_to_where_the_legs_end(addon: ModuleType, baked_ik: bpy.types.Object) -> None:
    rest = {foot: _seen_from(baked_ik.data.bones, foot, shin, "matrix_local") for foot, shin in FEET.items()}
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    assert bpy.ops.fragmotion.bake("EXEC_DEFAULT", trace_source="PLAYER", seconds=4) == {"FINISHED"}
    for frame in range(1, 90, 8):
        bpy.context.scene.frame_set(frame)
        for foot, shin in FEET.items():
            place = _seen_from(baked_ik.pose.bones, foot, shin, "matrix")
            assert np.linalg.norm(place - rest[foot]) < 1e-3


def test_motion_comes_onto_them_as_the_armature_s_own_actions_show(
    addon: ModuleType, baked_ik: bpy.types.Object
) -> None:
    rest = {foot: _seen_from(baked_ik.data.bones, foot, shin, "matrix_local") for foot, shin in FEET.items()}
    bpy.data.batch_remove([action for action in bpy.data.actions if action.name != "walk forward"])
    source = making.add_armature(name="Source")
    making.add_action(source, 30).fragmotion.use = True
    making.activate(baked_ik)
    baked_ik.fragmotion.source = source
    assert bpy.ops.fragmotion.retarget_actions() == {"FINISHED"}
    assert {row.name: row.on for row in baked_ik.fragmotion.hanging} == FEET
    addon.compat.versions.assign(baked_ik, bpy.data.actions["take on " + baked_ik.name])
    places = []
    for frame in range(1, 30, 4):
        bpy.context.scene.frame_set(frame)
        places.append([baked_ik.pose.bones[foot].head.copy() for foot in FEET])
        for foot, shin in FEET.items():
            assert np.linalg.norm(_seen_from(baked_ik.pose.bones, foot, shin, "matrix") - rest[foot]) < 1e-3
    assert np.ptp(places, axis=0).max() > 0.01


def _seen_from(bones: object, foot: str, shin: str, matrix: str) -> np.ndarray:
    """The head of a foot as its shin sees it, m."""
    frames = (np.array(getattr(bones[name], matrix)) for name in (shin, foot))  # type: ignore[index]
    above, below = frames
    return (np.linalg.inv(above) @ below)[:3, 3]


def test_build_says_which(addon: ModuleType, baked_ik: bpy.types.Object) -> None:
    told = addon.rig.hanging.find_hanging(bpy.context, baked_ik, [bpy.data.actions["walk forward"]])
    assert len(told) == 1
    assert "'foot.L' with 'shin.L', 'foot.R' with 'shin.R'" in told[0]


def test_they_are_found_again_beside_a_bone_that_is_left_out(addon: ModuleType, baked_ik: bpy.types.Object) -> None:
    action = bpy.data.actions["walk forward"]
    with making.editing(baked_ik) as bones:
        bones["hand.L"].use_connect = False
    for frame, off in ((1, 0.0), (10, 0.3)):
        baked_ik.pose.bones["hand.L"].location = (off, 0, 0)
        baked_ik.pose.bones["hand.L"].keyframe_insert("location", frame=frame)
    first, second = (addon.rig.hanging.find_hanging(bpy.context, baked_ik, [action]) for _ in range(2))
    assert {row.name: row.on for row in baked_ik.fragmotion.hanging} == FEET
    assert second == first
    assert "what keys of bone 'hand.L' move away" in second[1]


def test_a_tail_beside_the_hips_goes_where_they_go(addon: ModuleType) -> None:
    obj = making.open_sample()
    action = bpy.data.actions["walk forward"]
    with making.editing(obj) as bones:
        for name, parent in (("body", "root"), ("tail", "body")):
            bone = bones.new(name)
            bone.head, bone.tail, bone.parent = (0, 0.1, 0.9), (0, 0.4, 0.9), bones[parent]
        bones["hips"].use_connect, bones["hips"].parent = False, bones["body"]
    addon.compat.versions.assign(obj, action)
    for frame, height in ((1, 0.0), (10, 0.3)):
        obj.pose.bones["body"].location = (0, 0, height)
        obj.pose.bones["body"].keyframe_insert("location", frame=frame)
    assert addon.rig.hanging.find_hanging(bpy.context, obj, [action]) == [
        "Learned, and baked, as bones that move with others than their parents: 'tail' with 'hips'"
    ]
    rig = addon.rig.rigs.make_rig(obj)
    clip = addon.mocap.sampling.sample(bpy.context, obj, action, rig)
    heads = clip.world_transforms(rig.skeleton)[0]
    tail = rig.skeleton.names.index("tail")
    for frame in (1, 10):
        bpy.context.scene.frame_set(frame)
        seen = np.array(obj.matrix_world @ obj.pose.bones["tail"].head)
        off = np.linalg.norm(heads[frame - int(action.frame_range[0]), tail] - seen)
        assert off < np.linalg.norm(obj.pose.bones["hips"].location) + 1e-3, "by what the hips go on their own"


def test_a_trunk_that_moves_with_the_root_stays_on_the_hips(addon: ModuleType) -> None:
    obj = making.open_sample()
    obj.fragmotion.moves.clear()
    action = bpy.data.actions["walk forward"]
    for each in bpy.data.actions:
        each.fragmotion.use = each == action
    (trunk,) = [bone.name for bone in obj.data.bones["hips"].children if not bone.name.startswith("thigh")]
    with making.editing(obj) as bones:
        bones[trunk].use_connect = False
    addon.compat.versions.assign(obj, action)
    beside = obj.data.bones["root"].matrix_local.inverted() @ obj.data.bones[trunk].matrix_local
    for frame in range(int(action.frame_range[0]), int(action.frame_range[1]) + 1):
        bpy.context.scene.frame_set(frame)
        obj.pose.bones[trunk].matrix = obj.pose.bones["root"].matrix @ beside
        for channel in ("location", "rotation_quaternion"):
            obj.pose.bones[trunk].keyframe_insert(channel)
    told = addon.rig.hanging.find_hanging(bpy.context, obj, [action])
    assert trunk not in {row.name for row in obj.fragmotion.hanging}
    assert any(f"Left out: what keys of bone '{trunk}'" in each for each in told)


def test_feet_are_learned_where_they_are_shown_though_the_legs_move_away_from_the_hips(addon: ModuleType) -> None:
    obj, action = making.open_sample(), bpy.data.actions["walk forward"]
    with making.editing(obj) as bones:
        for side in ("L", "R"):
            bones[f"thigh.{side}"].use_connect = False
    addon.compat.versions.assign(obj, action)
    frames = range(int(action.frame_range[0]), int(action.frame_range[1]) + 1)
    for frame in frames:
        for side in ("L", "R"):
            obj.pose.bones[f"thigh.{side}"].location = (0, -0.05 - 0.03 * np.sin(frame / 4), 0)
            obj.pose.bones[f"thigh.{side}"].keyframe_insert("location", frame=frame)
    addon.rig.hanging.find_hanging(bpy.context, obj, [action])
    rig = addon.rig.rigs.make_rig(obj)
    clip = addon.mocap.sampling.sample(bpy.context, obj, action, rig)
    heads = clip.world_transforms(rig.skeleton)[0]
    seen = []
    with addon.rig.posing.playing(bpy.context, obj, action):
        for frame in frames:
            seen.append({name: obj.matrix_world @ matrix.translation for name, matrix in _matrices(obj, frame).items()})
    for name in FEET:
        off = heads[:, rig.skeleton.names.index(name)] - np.array([each[name] for each in seen])
        assert np.linalg.norm(off, axis=1).max() < 1e-3


@pytest.mark.parametrize(("times", "is_said"), ((1, False), (40, True)))
def test_build_says_that_location_keys_are_of_another_size_than_the_bones(
    addon: ModuleType, baked_ik: bpy.types.Object, times: float, is_said: bool
) -> None:
    action = bpy.data.actions["walk forward"]
    for curve in addon.compat.versions.curves_of(action, baked_ik):
        if curve.data_path.endswith(".location") and "foot" in curve.data_path:
            for key in curve.keyframe_points:
                key.co[1] *= times
    told = addon.rig.hanging.find_hanging(bpy.context, baked_ik, [action])
    assert any("as far as the body is large" in each and "Ctrl+A" in each for each in told) == is_said


def test_what_hangs_on_no_bone_goes_along(addon: ModuleType) -> None:
    obj = making.open_sample()
    action = bpy.data.actions["walk forward"]
    with making.editing(obj) as bones:
        for side in ("L", "R"):
            bones[f"thigh.{side}"].use_connect, bones[f"thigh.{side}"].parent = False, None
        bones.new("target").tail = (0, 0, 1)
        bones["target"].use_deform = False
    addon.rig.hanging.find_hanging(bpy.context, obj, [action])
    assert {row.name: row.on for row in obj.fragmotion.hanging} == {"thigh.L": "root", "thigh.R": "root"}
    assert {"shin.L", "foot.R"} < set(addon.rig.rigs.make_rig(obj).skeleton.names)


def test_build_says_which_feet_are_not_held(addon: ModuleType) -> None:
    obj = making.open_sample()
    assert addon.character.building.say_feet(addon.rig.rigs.make_rig(obj).skeleton) == []
    with making.editing(obj) as bones:
        for side, end in ((1, ".L"), (-1, ".R")):
            above, heights = bones["hips"], (0.9, 0.4, 0.05, 0.02)
            for number, (head, tail) in enumerate(itertools.pairwise(heights)):
                bone = bones.new(f"more{number}{end}")
                bone.head, bone.tail, bone.parent = (0.4 * side, 0.2, head), (0.4 * side, 0.2, tail), above
                above = bone
    told = addon.character.building.say_feet(addon.rig.rigs.make_rig(obj).skeleton)
    assert told == ["Held where they stand are foot.L and foot.R alone; more2.L, more2.R go as in the takes"]


def test_build_says_that_no_feet_are_known(addon: ModuleType) -> None:
    obj = making.open_sample()
    with making.editing(obj) as bones:
        for bone in [bone for bone in bones if bone.name.startswith(("thigh", "shin", "foot", "toe"))]:
            bones.remove(bone)
    (told,) = addon.character.building.say_feet(addon.rig.rigs.make_rig(obj).skeleton)
    assert told.startswith("No feet are known")
    assert "Find Bones" in told


def test_build_says_what_is_scaled(addon: ModuleType, capfd: pytest.CaptureFixture[str]) -> None:
    obj = making.open_sample()
    obj.fragmotion.moves.clear()
    action = bpy.data.actions["walk forward"]
    for each in bpy.data.actions:
        each.fragmotion.use = each == action
    addon.compat.versions.assign(obj, action)
    for name, scale in (("head", 1.0), ("shin.L", 1.5), ("shin.R", 0.02)):
        obj.pose.bones[name].scale = (scale, 1, 1)
    obj.pose.bones["shin.R"].keyframe_insert("scale", frame=1)
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    (told,) = (line for line in capfd.readouterr().out.splitlines() if "the scale of" in line)
    assert "the scale of bone 'shin.R' and 1 more, up to 50 times" in told


@pytest.fixture
def exported_whole(addon: ModuleType) -> bpy.types.Object:
    """The sample as Auto-Rig Pro's rigs are exported with their controls: the mesh's bones hang on a path, and bones
    that are named as legs lie where they rest."""
    obj = making.open_sample()
    obj.fragmotion.moves.clear()
    action = bpy.data.actions["walk forward"]
    for each in bpy.data.actions:
        each.fragmotion.use = each == action
    frames = range(*(int(frame) for frame in action.frame_range))
    with addon.rig.posing.playing(bpy.context, obj, action):
        seen = {frame: _all_matrices(obj, frame) for frame in frames}
    with making.editing(obj) as bones:
        followed = [bone for bone in bones if bone.name != "root"]
        copies = {
            bone.name: (bone.parent.name, *(vector.copy() for vector in (bone.head, bone.tail))) for bone in followed
        }
        for bone in followed:
            bone.use_connect, bone.parent = False, bones["root"]
            bone.name = _of_mesh(bone.name)
        for name, (parent, head, tail) in copies.items():
            copy = bones.new(name)
            copy.head, copy.tail, copy.parent = head, tail, bones[parent]
    bpy.data.actions.remove(action)
    obj.animation_data.action = baked = bpy.data.actions.new("walk")
    for frame in frames:
        bpy.context.scene.frame_set(frame)
        for name, matrix in seen[frame].items():
            bone = obj.pose.bones["root" if name == "root" else _of_mesh(name)]
            bone.rotation_mode, bone.matrix = "QUATERNION", matrix
            bpy.context.view_layer.update()
            for channel in ("location", "rotation_quaternion"):
                bone.keyframe_insert(channel)
    baked.fragmotion.use = True
    return obj


def _of_mesh(name: str) -> str:
    """As "thigh_stretch.L" of "thigh.L"."""
    stem, dot, side = name.partition(".")
    return f"{stem}_stretch{dot}{side}"


def _all_matrices(obj: bpy.types.Object, frame: int) -> dict[str, object]:
    bpy.context.scene.frame_set(frame)
    posed = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return {bone.name: bone.matrix.copy() for bone in posed.pose.bones}


def test_what_the_mesh_follows_is_the_body_of_a_rig_that_was_exported_whole(
    addon: ModuleType, exported_whole: bpy.types.Object
) -> None:
    for _ in range(2):  # again, with the roles that were found
        assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
        hanging = {row.name: row.on for row in exported_whole.fragmotion.hanging}
        for bone, on in (("shin", "thigh"), ("foot", "shin"), ("upper_arm", "shoulder"), ("hand", "forearm")):
            assert hanging[_of_mesh(f"{bone}.L")] == _of_mesh(f"{on}.L")
        assert hanging["thigh_stretch.R"] == "hips_stretch"
        skeleton = addon.character.building.load(exported_whole).skeleton
        assert {role: skeleton.roles[role] for role in ("hips", "head", "left_foot", "right_thigh", "left_hand")} == {
            "hips": "hips_stretch",
            "head": "head_stretch",
            "left_foot": "foot_stretch.L",
            "right_thigh": "thigh_stretch.R",
            "left_hand": "hand_stretch.L",
        }
        assert "alks" in exported_whole.fragmotion.figures.abilities


def test_a_bake_moves_what_the_mesh_follows_as_build_has_learned_it(
    addon: ModuleType, exported_whole: bpy.types.Object
) -> None:
    joints = {_of_mesh(f"{bone}.L"): _of_mesh(f"{on}.L") for bone, on in (("shin", "thigh"), ("foot", "shin"))}
    rest = {bone: _seen_from(exported_whole.data.bones, bone, on, "matrix_local") for bone, on in joints.items()}
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    assert bpy.ops.fragmotion.bake("EXEC_DEFAULT", trace_source="PLAYER", seconds=4) == {"FINISHED"}
    knees = []
    for frame in range(1, 90, 8):
        bpy.context.scene.frame_set(frame)
        knees.append(exported_whole.pose.bones["shin_stretch.L"].head.copy())
        for bone, on in joints.items():
            assert np.linalg.norm(_seen_from(exported_whole.pose.bones, bone, on, "matrix") - rest[bone]) < 1e-3
    assert np.ptp(knees, axis=0).max() > 0.1


def test_a_rig_whose_mesh_follows_its_named_feet_is_as_its_names_tell(addon: ModuleType) -> None:
    obj = making.open_sample()
    assert addon.rig.mesh_bones.bones_beside_names(obj) == []
    assert addon.rig.hanging.find_hanging(bpy.context, obj, addon.mocap.actions.ticked(obj)) == []
