# SPDX-License-Identifier: MIT
"""Actions of a smaller body with bones of the same names are learned as far as the larger one's legs go."""

from __future__ import annotations

from types import ModuleType

import bpy
import making
import numpy as np
import pytest
from mathutils import Matrix

NAMES = ("stand", "walk forward", "run forward")


def smaller(obj: bpy.types.Object, size: float) -> bpy.types.Object:
    """A copy of an armature whose bones are so many times as long, and its object's scale the same."""
    other = obj.copy()
    other.data = obj.data.copy()
    bpy.context.scene.collection.objects.link(other)
    other.animation_data_clear()
    bpy.context.view_layer.objects.active = other
    bpy.ops.object.mode_set(mode="EDIT")
    other.data.transform(Matrix.Scale(size, 4))
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.context.view_layer.objects.active = obj
    return other


def lessen(addon: ModuleType, obj: bpy.types.Object, action: bpy.types.Action, size: float) -> None:
    for curve in addon.compat.versions.curves_of(action, obj):
        if curve.data_path.endswith(".location"):
            for key in curve.keyframe_points:
                key.co.y *= size
            curve.update()


def root_path(addon: ModuleType, obj: bpy.types.Object, name: str) -> np.ndarray:
    rig = addon.rig.rigs.make_rig(obj)
    return np.array(addon.mocap.sampling.sample(bpy.context, obj, bpy.data.actions[name], rig).root_positions)


@pytest.fixture(params=("read from keys", "posed by Blender"))
def paths(addon: ModuleType, request: pytest.FixtureRequest) -> dict[str, np.ndarray]:
    """The sample's Actions made for a body of a fourth of its size, one of which each copy of it plays; where they went
    before."""
    obj = making.open_sample()
    obj.fragmotion.moves.clear()
    obj.animation_data_clear()
    if request.param == "posed by Blender":
        obj.data.bones["head"].inherit_scale = "ALIGNED"
    for action in bpy.data.actions:
        action.fragmotion.use = action.name in NAMES
    went = {name: root_path(addon, obj, name) for name in NAMES}
    for name in NAMES:
        lessen(addon, obj, bpy.data.actions[name], 0.25)
        addon.compat.versions.assign(smaller(obj, 0.25), bpy.data.actions[name])
    return went


def test_a_smaller_bodys_actions_go_as_far_as_its_legs_would(
    addon: ModuleType, paths: dict[str, np.ndarray], capfd: pytest.CaptureFixture[str]
) -> None:
    obj = bpy.context.view_layer.objects.active
    for name, path in paths.items():
        assert root_path(addon, obj, name) == pytest.approx(path, abs=1e-4)
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    assert (
        "with legs 0.25 times as long: its ways are learned 4 times as far (and 2 more like it)"
        in capfd.readouterr().out
    )
    speeds = [
        np.linalg.norm(np.diff(paths[name][[0, -1], :2], axis=0)) / (len(paths[name]) - 1) * 30 for name in NAMES[1:]
    ]
    assert addon.character.building.load(obj).space.speeds == pytest.approx(speeds, rel=0.15)
    assert [row.severity for row in bpy.data.actions[NAMES[2]].fragmotion.findings if row.code == "other_body"] == [
        "info"
    ]


def test_it_is_known_when_the_smaller_body_is_gone(addon: ModuleType, paths: dict[str, np.ndarray]) -> None:
    obj = bpy.context.view_layer.objects.active
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    for other in [each for each in bpy.data.objects if each.type == "ARMATURE" and each != obj]:
        bpy.data.objects.remove(other)
    for name, path in paths.items():
        assert root_path(addon, obj, name) == pytest.approx(path, abs=1e-4)


def test_what_the_armature_plays_itself_is_its_own(addon: ModuleType, paths: dict[str, np.ndarray]) -> None:
    obj = bpy.context.view_layer.objects.active
    addon.compat.versions.assign(obj, bpy.data.actions["walk forward"])
    path, before = root_path(addon, obj, "walk forward"), paths["walk forward"]
    assert np.ptp(path[:, :2]) == pytest.approx(np.ptp(before[:, :2]) / 4, rel=0.05)


def test_what_is_mended_is_not_made_longer_again(addon: ModuleType, paths: dict[str, np.ndarray]) -> None:
    obj = bpy.context.view_layer.objects.active
    action = bpy.data.actions["walk forward"]
    for curve in addon.compat.versions.curves_of(action, obj):
        if curve.data_path == 'pose.bones["root"].location':
            curve.mute = True
    on_the_spot = root_path(addon, obj, action.name)
    assert np.ptp(on_the_spot[:, :2], axis=0).max() < 0.2
    bpy.context.window_manager.fragmotion.active_action = bpy.data.actions.find(action.name)
    assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
    (row,) = (i for i, each in enumerate(action.fragmotion.findings) if each.code == "in_place")
    assert bpy.ops.fragmotion.mend_finding(index=row) == {"FINISHED"}
    assert root_path(addon, obj, action.name)[:, 2] == pytest.approx(on_the_spot[:, 2], abs=1e-3)


def test_build_says_so_where_the_smaller_body_is_gone_before_it(
    addon: ModuleType, paths: dict[str, np.ndarray], capfd: pytest.CaptureFixture[str]
) -> None:
    obj = bpy.context.view_layer.objects.active
    for other in [each for each in bpy.data.objects if each.type == "ARMATURE" and each != obj]:
        bpy.data.objects.remove(other)
    actions = [bpy.data.actions[name] for name in NAMES]
    for times in (1, 4):
        for action in actions:
            lessen(addon, obj, action, times)
        assert bpy.ops.fragmotion.build("EXEC_DEFAULT") == {"FINISHED"}
        said = [a.name for a in actions if any(row.code == "smaller_body" for row in a.fragmotion.findings)]
        assert ("walk forward" in said) == (times == 1), "of a flight, as of the run, the legs tell nothing"
        assert ("as in an Action of a smaller body" in capfd.readouterr().out) == bool(said) == (times == 1)
