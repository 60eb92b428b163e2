# SPDX-License-Identifier: MIT
"""What Bake to Controls keys shows the same when a limb is switched to the other way in which its rig moves it."""

from __future__ import annotations

from types import ModuleType

import bpy
import making
import numpy as np
import pytest
from numpy.typing import NDArray

WALK = making.MOCAP / "bandai-namco" / "dataset-1_walk_normal_001.bvh"
EXACT = 1e-3  # m
BENT = 2.5e-3  # m; at knees and elbows, as Rigify's solvers stretch bones of different length alike
TURNED = 0.5  # degrees
LIMBS = {"upper_arm", "lower_arm", "thigh", "shin"}


class Pose:
    """Where the parts of a body are on frames: joints [F,R,3], m, and axes [F,R,3,3] of the bones that deform them."""

    def __init__(self, addon: ModuleType, rig: bpy.types.Object, frames: range) -> None:
        joints = addon.control_rig.joints.find_joints(rig)
        self.roles, matrices = list(joints), []
        for frame in frames:
            bpy.context.scene.frame_set(frame)
            bones = rig.evaluated_get(bpy.context.evaluated_depsgraph_get()).pose.bones
            matrices.append([bones[joint.bone].matrix.normalized() for joint in joints.values()])
        placed: NDArray[np.float64] = np.array(matrices)
        self.joints, self.axes = placed[..., :3, 3], placed[..., :3, :3]

    def apart(self, other: Pose) -> dict[str, float]:
        """Role -> how far its joint is from that of another pose at most."""
        return dict(zip(self.roles, np.linalg.norm(self.joints - other.joints, axis=-1).max(0)))

    def turned(self, other: Pose) -> dict[str, float]:
        """Role -> degrees by which it is turned from another pose at most; of parts of limbs by where they point."""
        ways = np.einsum("frij,frij->frj", self.axes, other.axes)
        cosines = {role: ways[:, index, 1] for index, role in enumerate(self.roles)}
        for index, role in enumerate(self.roles):
            if role.partition("_")[2] not in LIMBS:
                cosines[role] = (ways[:, index].sum(-1) - 1) / 2
        return {role: float(np.degrees(np.arccos(np.clip(each, -1, 1))).max()) for role, each in cosines.items()}


def switch(addon: ModuleType, rig: bpy.types.Object) -> None:
    """Set the keys of the rig's switches to what they were before it was bound."""
    curves = addon.compat.versions.curves_of(rig.animation_data.action, rig)
    former = {f'pose.bones["{each.bone}"]["{each.name}"]': each.value for each in rig.fragmotion.control_rig.switches}
    keyed = [curve for curve in curves if curve.data_path in former]
    assert former and len(keyed) == len(former)
    for curve in keyed:
        curve.keyframe_points[0].co.y = former[curve.data_path]
        curve.update()


@pytest.mark.parametrize("bound", [pytest.param("rigify", marks=pytest.mark.thorough), "FK"], indirect=True)
def test_a_limb_that_is_switched_to_ik_shows_the_same(addon: ModuleType, bound: bpy.types.Object) -> None:
    rig, motion = bound, addon.control_rig.binding.motion_of(bound)
    if WALK.exists():
        files = [{"name": WALK.name}]
        assert bpy.ops.fragmotion.import_mocap(directory=str(WALK.parent), files=files, onto="ACTIVE") == {"FINISHED"}
    else:
        making.add_action(motion, 8, swing=0.35)  # about as far as a walk swings its joints
    assert bpy.ops.fragmotion.bake_to_controls("EXEC_DEFAULT") == {"FINISHED"}
    first, last = rig.animation_data.action.frame_range
    frames = range(int(first), int(last) + 1, 2)
    by_parts = Pose(addon, rig, frames)
    switch(addon, rig)
    assert_alike(by_parts, Pose(addon, rig, frames))
    with_poles = [bone for bone in rig.pose.bones if "pole_vector" in bone]
    for bone in with_poles:
        bone["pole_vector"] = True
    if with_poles:
        rig.update_tag()
        assert_alike(by_parts, Pose(addon, rig, frames))


def assert_alike(one: Pose, other: Pose) -> None:
    """The poses are within the bounds."""
    for role, distance in one.apart(other).items():
        most = BENT if role.endswith(("lower_arm", "shin")) else EXACT
        assert distance < most, f"{role} is {1000 * distance:.2f} mm off"
    for role, angle in one.turned(other).items():
        assert angle < TURNED, f"{role} is turned by {angle:.2f} degrees"
    assert np.ptp(other.joints, axis=0).max() > 0.1, "nothing moved"
