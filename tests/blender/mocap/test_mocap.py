# SPDX-License-Identifier: MIT
"""Real takes: all of Bandai-Namco's on one armature, and CMU's Acclaim files."""

from __future__ import annotations

from pathlib import Path
from types import ModuleType

import bpy
import making
import numpy as np
import pytest

BANDAI = making.MOCAP / "bandai-namco"
CMU = making.MOCAP / "cmu"

pytestmark = [
    pytest.mark.measures,
    pytest.mark.skipif(not BANDAI.is_dir(), reason="no motion capture beside the project"),
]


@pytest.fixture(scope="module")
def imported(addon: ModuleType, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A .blend with all 159 takes on one armature."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.context.scene.render.fps = 30
    assert bpy.ops.fragmotion.import_mocap(directory=str(BANDAI)) == {"FINISHED"}
    path = tmp_path_factory.mktemp("mocap") / "bandai.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path))
    return path


def test_all_takes_come_onto_one_armature(addon: ModuleType, imported: Path) -> None:
    bpy.ops.wm.open_mainfile(filepath=str(imported))
    armatures = [obj for obj in bpy.data.objects if obj.type == "ARMATURE"]
    assert [obj.name for obj in armatures] == ["bandai-namco"]
    assert len(bpy.data.actions) == 159
    assert addon.mocap.actions.ticked(armatures[0]) == list(bpy.data.actions)


def test_every_take_poses_and_samples_as_its_file_says(addon: ModuleType, imported: Path) -> None:
    bpy.ops.wm.open_mainfile(filepath=str(imported))
    obj = bpy.data.objects["bandai-namco"]
    rig = addon.rig.rigs.make_rig(obj)
    body = making.body_bones(rig.skeleton)
    for action in bpy.data.actions:
        take = addon.compat.core.core.read_bvh(BANDAI / f"{action.name}.bvh")
        heads, _ = take.world_transforms()
        rows = np.array([0, len(heads) // 2, len(heads) - 1])
        matrices = making.blender_poses(obj, action, 1 + rows, take.skeleton.names)
        making.assert_same_poses(matrices, heads[rows], None, 1e-4)
        clip = addon.mocap.sampling.sample(bpy.context, obj, action, rig)
        assert len(clip.root_positions) == len(heads) and clip.rate == 30
        sampled, turned = clip.world_transforms(rig.skeleton)
        making.assert_same_poses(matrices[:, body], sampled[rows][:, body], None, 1e-4 + _shift(addon, obj, action))
        making.assert_same_poses(matrices[:, body], matrices[:, body][..., :3, 3], turned[rows][:, body], 1e-4)


def _shift(addon: ModuleType, obj: bpy.types.Object, action: bpy.types.Action) -> float:
    """How far, in metres, the take moves a joint from its offset: 0.4 mm in four takes, which clips leave out."""
    curves = [c for c in addon.compat.versions.curves_of(action, obj) if c.data_path.endswith("location")]
    inner = [c for c in curves if "Hips" not in c.data_path and "joint_Root" not in c.data_path]
    return max((abs(key.co.y) for curve in inner for key in curve.keyframe_points), default=0.0)


def test_a_character_of_all_takes_is_built_and_baked(addon: ModuleType, imported: Path) -> None:
    bpy.ops.wm.open_mainfile(filepath=str(imported))
    obj = bpy.data.objects["bandai-namco"]
    making.activate(obj)
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    figures = obj.fragmotion.figures
    assert figures.captured > 5000 and (figures.classes, figures.controls) == (97, 102)
    assert figures.quality > 80 and figures.performed > 40
    assert bpy.ops.fragmotion.bake(player="runner", seconds=10) == {"FINISHED"}
    action = obj.animation_data.action
    assert tuple(action.frame_range) == (1, 301)
    played = making.blender_poses(
        obj, action, range(1, 302, 10), [addon.character.building.load(obj).skeleton.roles["hips"]]
    )
    hips = played[:, 0, :3, 3]
    assert np.isfinite(hips).all() and np.ptp(hips[:, :2], axis=0).max() > 3
    assert hips[:, 2].min() > 0.3 and hips[:, 2].max() < 2.5


@pytest.mark.skipif(
    bpy.app.version < (4, 2, 0) or bpy.app.version >= (5, 0, 0),
    reason="this Blender's BVH importer is not that of 4.5 (3.4.1's fails on Python 3.11)",
)
def test_takes_move_as_with_blenders_own_importer(imported: Path) -> None:
    bpy.ops.wm.open_mainfile(filepath=str(imported))
    ours = bpy.data.objects["bandai-namco"]
    names = [bone.name for bone in ours.data.bones]
    for path in sorted(BANDAI.glob("*.bvh"))[::6]:
        bpy.ops.import_anim.bvh(filepath=str(path), global_scale=0.01, rotate_mode="QUATERNION", axis_forward="-Z")
        theirs = bpy.context.view_layer.objects.active
        action = theirs.animation_data.action
        times = np.linspace(*action.frame_range, 7).round()
        expected = making.blender_poses(theirs, action, times, names)[..., :3, 3]
        found = making.blender_poses(ours, bpy.data.actions[path.stem], times, names)[..., :3, 3]
        np.testing.assert_allclose(found, expected, atol=1e-4, err_msg=path.name)
        bpy.data.objects.remove(theirs)


def test_acclaim_takes_move_the_armature_as_their_files_say(addon: ModuleType) -> None:
    names = ["02_01.amc", "02_03.amc"]
    bpy.context.scene.render.fps = 30
    assert bpy.ops.fragmotion.import_mocap(directory=str(CMU), files=[{"name": n} for n in names]) == {"FINISHED"}
    obj = bpy.context.view_layer.objects.active
    for name in names:
        take = addon.compat.core.core.read_asf_amc(CMU / "02.asf", CMU / name)
        heads, _ = take.world_transforms()
        rows = np.array([0, 10, 101, len(heads) - 1])
        matrices = making.blender_poses(obj, bpy.data.actions[take.name], 1 + rows / 4, take.skeleton.names)
        making.assert_same_poses(matrices, heads[rows], None, 1e-4)
