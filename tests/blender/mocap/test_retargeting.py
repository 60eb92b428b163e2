# SPDX-License-Identifier: MIT
"""Takes and Actions of another skeleton move the user's own character; which bone is which can be said and kept."""

from __future__ import annotations

import json
from pathlib import Path
from types import ModuleType

import bpy
import making
import numpy as np
import pytest

WALK = making.MOCAP / "bandai-namco" / "dataset-1_walk_normal_001.bvh"
ODD_UNIT = making.MOCAP / "cmu" / "01_01.bvh"
PARTS = (("thigh.L", "shin.L"), ("shin.R", "foot.R"), ("upper_arm.R", "hand.R"))  # bones, and what they point to


def add_character() -> bpy.types.Object:
    """A body of other proportions and names than the sample's, active."""
    longer = [
        (name, parent, tuple(1.2 * np.array(head)), tuple(1.2 * np.array(tail)))
        for name, parent, head, tail in making.BODY
    ]
    return making.add_armature(longer, name="Hero")


def directions(obj: bpy.types.Object, action: bpy.types.Action, parts: object, times: np.ndarray) -> np.ndarray:
    """[F,P,3]: where parts point as Blender shows them, parts as pairs of bones."""
    names = [name for pair in parts for name in pair]
    heads = making.blender_poses(obj, action, times, names)[..., :3, 3]
    ways = heads[:, 1::2] - heads[:, ::2]
    return ways / np.linalg.norm(ways, axis=-1, keepdims=True)


def angles(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    return np.degrees(np.arccos(np.clip((one * other).sum(-1), -1, 1)))


def role_pairs(obj: bpy.types.Object) -> list[tuple[str, str]]:
    """The sample's bones that PARTS are."""
    bones = {role.name: role.bone for role in obj.fragmotion.roles}
    roles = (("left_thigh", "left_shin"), ("right_shin", "right_foot"), ("right_upper_arm", "right_lower_arm"))
    return [(bones[a], bones[b]) for a, b in roles]


def test_actions_of_another_armature_move_this_one_likewise() -> None:
    source = making.open_sample()
    assert bpy.ops.fragmotion.tick_actions(use=False) == {"FINISHED"}
    ticked = [action for action in bpy.data.actions if "walk" in action.name.lower()][:2]
    for action in ticked:
        action.fragmotion.use = True
    assert bpy.ops.fragmotion.find_bones() == {"FINISHED"}
    obj = add_character()
    obj.fragmotion.source = source
    assert bpy.ops.fragmotion.retarget_actions() == {"FINISHED"}
    for action in ticked:
        made = bpy.data.actions[f"{action.name} on Hero"]
        assert made.fragmotion.use and made.use_fake_user
        times = np.arange(2, 30, 5)
        apart = angles(directions(source, action, role_pairs(source), times), directions(obj, made, PARTS, times))
        assert apart.max() < 20 and apart.mean() < 8


@pytest.mark.skipif(not WALK.exists(), reason="no motion capture beside the project")
def test_takes_play_where_the_armature_is(tmp_path: Path) -> None:
    (tmp_path / WALK.name).write_bytes(WALK.read_bytes())
    obj, ways = add_character(), []
    for place in ((0, 0, 0), (3, -2, 0)):
        obj.location = place
        bpy.context.view_layer.update()
        assert bpy.ops.fragmotion.import_mocap(directory=str(tmp_path), onto="ACTIVE") == {"FINISHED"}
        heads = making.blender_poses(obj, obj.animation_data.action, np.arange(2, 100, 20), ["foot.L", "hips"])
        ways.append(heads[..., :3, 3])
    np.testing.assert_allclose(ways[1], ways[0] + np.array((3, -2, 0)), atol=1e-3)


@pytest.mark.skipif(not WALK.exists(), reason="no motion capture beside the project")
def test_takes_of_another_skeleton_move_the_active_character_and_are_learned(tmp_path: Path) -> None:
    for path in WALK.parent.glob("dataset-1_walk_normal_00[12].bvh"):
        (tmp_path / path.name).write_bytes(path.read_bytes())
    obj = add_character()
    assert bpy.ops.fragmotion.import_mocap(directory=str(tmp_path), onto="ACTIVE") == {"FINISHED"}
    assert [o.name for o in bpy.data.objects] == ["Hero"]
    action = obj.animation_data.action
    heads = making.blender_poses(obj, action, np.arange(2, 100, 3), ["foot.L", "foot.R", "hips"])[..., :3, 3]
    assert 1 < heads[:, 2, 2].mean() < 1.25 and heads[:, :2, 2].min() > 0.05
    assert np.linalg.norm(heads[-1, 2, :2] - heads[0, 2, :2]) > 0.5, "it goes nowhere"
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    assert bpy.ops.fragmotion.bake("EXEC_DEFAULT") == {"FINISHED"}


def test_what_cannot_be_retargeted_changes_nothing(tmp_path: Path) -> None:
    making.write_bvh(tmp_path / "stiff.bvh")
    obj = add_character()
    before = making.contents()
    with pytest.raises(RuntimeError, match="Take 'stiff'"):
        bpy.ops.fragmotion.import_mocap(directory=str(tmp_path), onto="ACTIVE")
    assert making.contents() == before
    obj.fragmotion.source = making.add_armature(name="Idle")
    making.activate(obj)
    with pytest.raises(RuntimeError, match="No Action of armature 'Idle' is ticked"):
        bpy.ops.fragmotion.retarget_actions()


def test_bones_are_found_changed_and_kept_as_a_preset(addon: ModuleType, tmp_path: Path) -> None:
    obj = add_character()
    assert bpy.ops.fragmotion.find_bones() == {"FINISHED"}
    roles = obj.fragmotion.roles
    assert roles["hips"].bone == "hips" and roles["left_thigh"].bone == "thigh.L" and not roles["neck_1"].bone
    roles["head"].bone = ""
    path = tmp_path / "hero.json"
    assert bpy.ops.fragmotion.save_bones(filepath=str(path)) == {"FINISHED"}
    kept = json.loads(path.read_text())
    assert kept["right_shin"] == "shin.R" and "head" not in kept
    roles.clear()
    assert bpy.ops.fragmotion.load_bones(filepath=str(path)) == {"FINISHED"}
    assert addon.rig.bodies.chosen_roles(obj) == kept


@pytest.mark.parametrize(
    ("text", "message"),
    [('{"hips": "Tail"}', "'Tail'"), *((text, "no preset") for text in ("[", "[1]", "[" * 100_000))],
)
def test_a_preset_that_does_not_fit_is_refused(tmp_path: Path, text: str, message: str) -> None:
    obj = add_character()
    path = tmp_path / "other.json"
    path.write_text(text)
    with pytest.raises(RuntimeError, match=message):
        bpy.ops.fragmotion.load_bones(filepath=str(path))
    assert not len(obj.fragmotion.roles)


@pytest.mark.skipif(not WALK.exists(), reason="no motion capture beside the project")
def test_a_take_that_is_there_twice_is_told(tmp_path: Path) -> None:
    for name in ("a", "b"):
        (tmp_path / f"{name}.bvh").write_bytes(WALK.read_bytes())
    assert bpy.ops.fragmotion.import_mocap(directory=str(tmp_path)) == {"FINISHED"}
    told = [row.text for action in bpy.data.actions for row in action.fragmotion.findings]
    assert len(bpy.data.actions) == 2 and sum("counts twice" in text for text in told) == 1


@pytest.mark.skipif(not ODD_UNIT.exists(), reason="no motion capture beside the project")
def test_a_unit_is_told_by_the_body_and_said(addon: ModuleType, tmp_path: Path) -> None:
    (tmp_path / "odd.bvh").write_bytes(ODD_UNIT.read_bytes())
    assert bpy.ops.fragmotion.import_mocap(directory=str(tmp_path), unit="CENTIMETRES") == {"FINISHED"}
    assert bpy.ops.fragmotion.import_mocap(directory=str(tmp_path)) == {"FINISHED"}
    first, second = bpy.data.objects
    assert addon.rig.rigs.make_rig(first).skeleton.stature < 1
    assert 1.5 < addon.rig.rigs.make_rig(second).skeleton.stature < 2
    assert any(row.mended for row in second.animation_data.action.fragmotion.findings)


@pytest.mark.parametrize(("first", "rate"), [(1, 30.0), (11, 30.0), (-4, 60.0)])
def test_an_action_brought_over_keeps_its_style_and_what_is_left_out(
    addon: ModuleType, first: int, rate: float
) -> None:
    source = making.add_armature(name="Actor")
    action = making.add_action(source, 60, name="limp")
    for curve in addon.compat.versions.curves_of(action, source):
        for key in curve.keyframe_points:
            key.co.x += first - 1
        curve.update()
    bpy.context.scene.render.fps = 30
    action["fragmotion_scene_rate"], action["fragmotion_rate"] = 30.0, rate
    action.fragmotion.use, action.fragmotion.style = True, "tired"
    for begin, end in ((0, 4), (20, 29)):
        span = action.fragmotion.left_out.add()
        span.first, span.last = first + begin, first + end
    obj = add_character()
    obj.fragmotion.source = source
    assert bpy.ops.fragmotion.retarget_actions() == {"FINISHED"}
    made = bpy.data.actions["limp on Hero"]
    assert made.fragmotion.style == "tired"
    parts = [
        [len(part.rotations) for part in addon.mocap.sampling.sample_parts(bpy.context, owner, take, rig)]
        for owner, take in ((source, action), (obj, made))
        for rig in (addon.rig.rigs.make_rig(owner),)
    ]
    assert len(parts[0]) == 2 and parts[1] == parts[0]
    assert addon.mocap.left_out.spans_of(made) == [(1, 5), (21, 30)]


def test_retargeting_that_is_stopped_in_the_middle_leaves_nothing(addon: ModuleType) -> None:
    source = making.open_sample()
    other = making.add_armature()
    bpy.context.view_layer.update()
    actions = [bpy.data.actions[name] for name in ("stand", "walk forward", "run forward")]
    before = making.contents()
    steps = addon.mocap.retargeting.retarget_actions(bpy.context, source, other, actions)
    done = [share for share, _ in zip(steps, range(5))]
    assert done == sorted(done) and 0.5 < done[-1] < 1
    assert len(bpy.data.actions) > len(before["actions"])
    steps.close()
    assert making.contents() == before


def add_doubtful_character() -> bpy.types.Object:
    """Whose arms end in hands without fingers, the left of which points up."""
    arms = (
        ("lower_arm.L", "upper_arm.L", (0.5, 0, 1.4), (0.8, -0.1, 1.4)),
        ("hand.L", "lower_arm.L", (0.8, -0.1, 1.4), (0.8, -0.1, 1.5)),
    )
    return making.add_armature([*(bone for bone in making.BODY if bone[0] != "hand.L"), *arms], name="Doubtful")


@pytest.fixture
def doubtful(addon: ModuleType, tmp_path: Path) -> bpy.types.Object:
    """A doubtful character onto which a take was imported."""
    if not WALK.exists():
        pytest.skip("no motion capture beside the project")
    (tmp_path / WALK.name).write_bytes(WALK.read_bytes())
    obj = add_doubtful_character()
    assert import_again(tmp_path) == {"FINISHED"}
    return obj


def import_again(folder: Path) -> set[str]:
    done: set[str] = bpy.ops.fragmotion.import_mocap(directory=str(folder), onto="ACTIVE")
    return done


def open_doubts(addon: ModuleType, obj: bpy.types.Object) -> list[tuple[str, str]]:
    return [(doubt.name, doubt.bone) for doubt in addon.rig.bodies.open_doubts(obj)]


def test_what_is_doubtful_about_bones_is_shown_at_the_import_and_chooses_no_role(
    addon: ModuleType, doubtful: bpy.types.Object
) -> None:
    assert open_doubts(addon, doubtful) == [("left_hand", "hand.L")]
    assert "'hand.L'" in doubtful.fragmotion.doubts["left_hand"].text
    assert addon.rig.bodies.chosen_roles(doubtful) is None and doubtful.data.bones.active.name == "hand.L"
    selected = addon.compat.versions.get_bone_selection(doubtful)
    assert [name for name, (whole, _, _) in selected.items() if whole] == ["hand.L"]


def test_a_bone_is_confirmed_by_one_click_and_stays_that_part(
    addon: ModuleType, doubtful: bpy.types.Object, tmp_path: Path
) -> None:
    assert bpy.ops.fragmotion.confirm_bone(role="left_hand") == {"FINISHED"}
    assert import_again(tmp_path) == {"FINISHED"}
    assert not open_doubts(addon, doubtful) and addon.rig.bodies.chosen_roles(doubtful) is None
    rig = addon.rig.rigs.make_rig(doubtful)
    assert addon.rig.bodies.make_body(doubtful, rig).roles["left_hand"] == "hand.L"
    doubtful.fragmotion.doubts["left_hand"].bone = "lower_arm.L"  # as if that had been found and confirmed
    assert addon.rig.bodies.make_body(doubtful, rig).roles["left_hand"] == "lower_arm.L"
    with pytest.raises(RuntimeError, match="nothing is doubtful about its left_foot"):
        bpy.ops.fragmotion.confirm_bone(role="left_foot")


def test_another_bone_that_is_chosen_ends_a_doubt(addon: ModuleType, doubtful: bpy.types.Object) -> None:
    assert bpy.ops.fragmotion.find_bones() == {"FINISHED"}
    assert open_doubts(addon, doubtful) == [("left_hand", "hand.L")]
    doubtful.fragmotion.roles["left_hand"].bone = "lower_arm.L"
    assert not open_doubts(addon, doubtful)


def test_a_doubtful_bone_is_shown_in_pose_mode(addon: ModuleType, doubtful: bpy.types.Object) -> None:
    addon.rig.selection.highlight(doubtful, ["head"])
    assert bpy.ops.fragmotion.show_bone(role="left_hand") == {"FINISHED"}
    assert doubtful.mode == "POSE" and bpy.context.active_pose_bone.name == "hand.L"
    assert [bone.name for bone in bpy.context.selected_pose_bones] == ["hand.L"]
    bpy.ops.object.mode_set(mode="OBJECT")
    doubtful.hide_set(True)
    with pytest.raises(RuntimeError, match="is hidden"):
        bpy.ops.fragmotion.show_bone(role="left_hand")


@pytest.mark.skipif(not WALK.exists(), reason="no motion capture beside the project")
def test_a_usual_character_keeps_no_roles_at_the_import(tmp_path: Path) -> None:
    (tmp_path / WALK.name).write_bytes(WALK.read_bytes())
    obj = add_character()
    assert bpy.ops.fragmotion.import_mocap(directory=str(tmp_path), onto="ACTIVE") == {"FINISHED"}
    assert not len(obj.fragmotion.roles) and not len(obj.fragmotion.doubts)
    assert not any(row.code == "limb" for action in bpy.data.actions for row in action.fragmotion.findings)


@pytest.mark.skipif(not WALK.exists(), reason="no motion capture beside the project")
def test_a_broken_wrist_is_an_error_in_the_doctor(tmp_path: Path) -> None:
    """Of a character whose hand is bent by a right angle at rest."""
    (tmp_path / WALK.name).write_bytes(WALK.read_bytes())
    obj = add_doubtful_character()
    with making.editing(obj) as bones:
        finger = bones.new("f_index.01.L")
        finger.parent, finger.head, finger.tail = bones["hand.L"], (0.8, -0.1, 1.5), (0.8, -0.1, 1.55)
    assert bpy.ops.fragmotion.import_mocap(directory=str(tmp_path), onto="ACTIVE") == {"FINISHED"}
    rows = [(row.severity, row.text) for row in obj.animation_data.action.fragmotion.findings if row.code == "limb"]
    assert len(rows) == 1 and rows[0][0] == "error" and "left hand" in rows[0][1]
