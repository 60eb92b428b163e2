# SPDX-License-Identifier: MIT
"""Write the sample character with all its takes to a .blend. Run it with Blender 3.4 (to 4.3):

blender -b --factory-startup --python-exit-code 1 --python sample_rigs/make_sample_rig.py -- [OUTPUT.blend]
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import body  # noqa: E402
import bpy  # noqa: E402
import gait  # noqa: E402
import numpy as np  # noqa: E402
import rig  # noqa: E402
import rotations as rot  # noqa: E402
from gestures import GESTURES  # noqa: E402
from takes import FPS, Take, all_takes, move_takes  # noqa: E402

FIRST_FRAME = 1
KEY_STEP = 2.0**-14  # keys are multiples of this (0.06 mm, 0.007 degrees), so that the file packs well
STYLED_KEY_STEP = 2.0**-12  # those of styles
SHOWN = "walk forward"
MOVE_KEYS = {"wave": "F", "kick": "G", "sit": "H"}


def write_action(armature: bpy.types.Object, motion: gait.Motion) -> bpy.types.Action:
    """One Action with a quaternion key for every bone and frame, and locations for root and hips."""
    action = bpy.data.actions.new(motion.take.name)
    action.use_fake_user = True
    for key in ("fragmotion_rate", "fragmotion_scene_rate"):  # as of an imported take: in any scene it plays as fast
        action[key] = float(FPS)
    # Ticked, where the add-on is; a style is ticked by those who want it, a move is no locomotion.
    manner, gesture = motion.take.manner, motion.take.gesture
    action["fragmotion"] = {"use": False, "style": manner} if manner else {"use": not gesture}
    step = STYLED_KEY_STEP if manner else KEY_STEP
    for bone in armature.data.bones:
        rest = np.array(bone.matrix_local.to_3x3())
        quaternion = rot.to_quaternions(rest.T @ motion.local(bone.name) @ rest)
        _write_curves(action, bone.name, "rotation_quaternion", quaternion, step)
    for name, offset in (("root", motion.root), ("hips", _hips_offset(motion))):
        rest = np.array(armature.data.bones[name].matrix_local.to_3x3())
        _write_curves(action, name, "location", offset @ rest, step)
    return action


def _hips_offset(motion: gait.Motion) -> np.ndarray:
    """Displacement [N, 3] of the hips from rest, in the root's frame and armature axes, metres."""
    return rot.apply(rot.transpose(motion.world["root"]), motion.hips - motion.root) - body.mid_hips()


def _write_curves(action: bpy.types.Action, bone: str, channel: str, values: np.ndarray, step: float) -> None:
    """Curves of all components of one channel, values [N, components] in steps, linear between frames."""
    frames = np.arange(len(values), dtype=float) + FIRST_FRAME
    for index, column in enumerate(values.T):
        curve = action.fcurves.new(f'pose.bones["{bone}"].{channel}', index=index, action_group=bone)
        curve.keyframe_points.add(len(frames))
        points = np.stack([frames, np.round(column / step) * step], axis=1).ravel()
        for attribute in ("co", "handle_left", "handle_right"):
            curve.keyframe_points.foreach_set(attribute, points)
        linear = np.ones(len(frames), dtype=np.int32)
        curve.keyframe_points.foreach_set("interpolation", linear)
        curve.update()


def list_moves(armature: bpy.types.Object, takes: Sequence[Take]) -> None:
    """Have the add-on's list of moves hold these, each on its key, as the add-on keeps them with the armature."""
    keys = bpy.types.Event.bl_rna.properties["type"].enum_items
    armature["fragmotion"] = {"moves": [_move_row(take, keys[MOVE_KEYS[take.name]].value) for take in takes]}


def _move_row(take: Take, key: int) -> dict[str, object]:
    gesture = GESTURES[take.gesture]
    loop = [round(second * FPS) + FIRST_FRAME for second in gesture.loop or (0.0, 0.0)]
    return {
        "name": take.name,
        "action": bpy.data.actions[take.name],
        "upper_body": gesture.upper_body,
        "loop": gesture.loop is not None,
        "loop_first": loop[0],
        "loop_last": loop[1],
        "key": key,
    }


def build() -> bpy.types.Object:
    """Replace the contents of the open file by the sample character; returns the armature."""
    rig.clear_file()
    armature = rig.make_armature()
    rig.make_mesh(armature)
    rig.make_stage()
    rig.make_grounds()
    for take in [*all_takes(), *move_takes()]:
        write_action(armature, gait.synthesize(take))
    list_moves(armature, move_takes())
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
