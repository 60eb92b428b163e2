# SPDX-License-Identifier: MIT
"""Write the sample character with all its takes to a .blend. Run it with Blender 3.4 (to 4.3):

blender -b --factory-startup --python-exit-code 1 --python sample_rigs/make_sample_rig.py -- [OUTPUT.blend]
"""

from __future__ import annotations

import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import body  # noqa: E402
import bpy  # noqa: E402
import gait  # noqa: E402
import numpy as np  # noqa: E402
import rig  # noqa: E402
import rotations as rot  # noqa: E402
from takes import FPS, all_takes  # noqa: E402

FIRST_FRAME = 1
KEY_STEP = 2.0**-14  # keys are multiples of this (0.06 mm, 0.007 degrees), so that the file packs well
SHOWN = "walk forward"


def write_action(armature: bpy.types.Object, motion: gait.Motion) -> bpy.types.Action:
    """One Action with a quaternion key for every bone and frame, and locations for root and hips."""
    action = bpy.data.actions.new(motion.take.name)
    action.use_fake_user = True
    for key in ("fragmotion_rate", "fragmotion_scene_rate"):  # as of an imported take: in any scene it plays as fast
        action[key] = float(FPS)
    action["fragmotion"] = {"use": True}  # ticked, where the add-on is
    for bone in armature.data.bones:
        rest = np.array(bone.matrix_local.to_3x3())
        quaternion = rot.to_quaternions(rest.T @ motion.local(bone.name) @ rest)
        _write_curves(action, bone.name, "rotation_quaternion", quaternion)
    for name, offset in (("root", motion.root), ("hips", _hips_offset(motion))):
        rest = np.array(armature.data.bones[name].matrix_local.to_3x3())
        _write_curves(action, name, "location", offset @ rest)
    return action


def _hips_offset(motion: gait.Motion) -> np.ndarray:
    """Displacement [N, 3] of the hips from rest, in the root's frame and armature axes, metres."""
    return rot.apply(rot.transpose(motion.world["root"]), motion.hips - motion.root) - body.mid_hips()


def _write_curves(action: bpy.types.Action, bone: str, channel: str, values: np.ndarray) -> None:
    """Curves of all components of one channel, values [N, components], linear between frames."""
    frames = np.arange(len(values), dtype=float) + FIRST_FRAME
    for index, column in enumerate(values.T):
        curve = action.fcurves.new(f'pose.bones["{bone}"].{channel}', index=index, action_group=bone)
        curve.keyframe_points.add(len(frames))
        points = np.stack([frames, np.round(column / KEY_STEP) * KEY_STEP], axis=1).ravel()
        for attribute in ("co", "handle_left", "handle_right"):
            curve.keyframe_points.foreach_set(attribute, points)
        linear = np.ones(len(frames), dtype=np.int32)
        curve.keyframe_points.foreach_set("interpolation", linear)
        curve.update()


def build() -> bpy.types.Object:
    """Replace the contents of the open file by the sample character; returns the armature."""
    rig.clear_file()
    armature = rig.make_armature()
    rig.make_mesh(armature)
    rig.make_stage()
    for take in all_takes():
        write_action(armature, gait.synthesize(take))
    scene = bpy.context.scene
    scene.render.fps = FPS
    shown = bpy.data.actions[SHOWN]
    armature.animation_data_create().action = shown
    scene.frame_start, scene.frame_end = (int(frame) for frame in shown.frame_range)
    scene.frame_set(FIRST_FRAME)
    rig.frame_viewports()
    return armature


def main() -> None:
    """Build and save to the path after "--", or beside this script."""
    arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    output = Path(arguments[0]).resolve() if arguments else HERE / "fragmotion_sample.blend"
    build()
    bpy.context.preferences.filepaths.save_version = 0
    bpy.ops.wm.save_as_mainfile(filepath=str(output), compress=True, check_existing=False)
    print(f"{output}: {len(bpy.data.actions)} actions, {output.stat().st_size / 1e6:.2f} MB")


if __name__ == "__main__":
    main()
