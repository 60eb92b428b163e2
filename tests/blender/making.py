# SPDX-License-Identifier: MIT
"""What the tests inside Blender make and measure: BVH files, armatures, Actions, and Blender's own poses."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import bpy
import numpy as np

SAMPLE = Path(__file__).parents[2] / "sample_rigs" / "fragmotion_sample.blend"
ARMATURE = "Fragmotion Sample"
MOCAP = Path(__file__).parents[3] / "shared" / "mocap"

# name, parent, head and tail in metres; a person facing -Y
BODY: tuple[tuple[str, str, tuple[float, float, float], tuple[float, float, float]], ...] = (
    ("root", "", (0, 0, 0), (0, 0.3, 0)),
    ("hips", "root", (0, 0, 1), (0, 0, 1.15)),
    ("spine", "hips", (0, 0, 1.15), (0, 0.02, 1.5)),
    ("head", "spine", (0, 0.02, 1.5), (0, 0, 1.8)),
    ("upper_arm.L", "spine", (0.2, 0, 1.45), (0.5, 0, 1.4)),
    ("hand.L", "upper_arm.L", (0.5, 0, 1.4), (0.8, -0.1, 1.4)),
    ("upper_arm.R", "spine", (-0.2, 0, 1.45), (-0.5, 0, 1.4)),
    ("hand.R", "upper_arm.R", (-0.5, 0, 1.4), (-0.8, -0.1, 1.4)),
    ("thigh.L", "hips", (0.1, 0, 1), (0.1, -0.02, 0.5)),
    ("shin.L", "thigh.L", (0.1, -0.02, 0.5), (0.1, 0, 0.1)),
    ("foot.L", "shin.L", (0.1, 0, 0.1), (0.1, -0.15, 0.02)),
    ("thigh.R", "hips", (-0.1, 0, 1), (-0.1, -0.02, 0.5)),
    ("shin.R", "thigh.R", (-0.1, -0.02, 0.5), (-0.1, 0, 0.1)),
    ("foot.R", "shin.R", (-0.1, 0, 0.1), (-0.1, -0.15, 0.02)),
)

BVH_HIERARCHY = """HIERARCHY
ROOT Root
{
  OFFSET 0 0 0
  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
  JOINT Hips
  {
    OFFSET 1 95 3
    CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation
    JOINT Spine
    {
      OFFSET 0 20 0
      CHANNELS 3 Yrotation Xrotation Zrotation
      End Site
      {
        OFFSET 0 40 5
      }
    }
    JOINT LeftUpLeg
    {
      OFFSET 10 0 0
      CHANNELS 3 Zrotation Xrotation Yrotation
      JOINT LeftFoot
      {
        OFFSET 0 -85 0
        CHANNELS 3 Xrotation Yrotation Zrotation
        End Site
        {
          OFFSET 0 0 0.01
        }
      }
    }
    JOINT RightUpLeg
    {
      OFFSET -10 0 0
      CHANNELS 3 Zrotation Xrotation Yrotation
      JOINT RightFoot
      {
        OFFSET 0 -85 0
        CHANNELS 3 Xrotation Yrotation Zrotation
        End Site
        {
          OFFSET 0 -3 12
        }
      }
    }
  }
}
"""
BVH_CHANNELS = 6 + 6 + 5 * 3

WALK, RUN, TURN = 1.2, 3.0, 1.2  # m/s, m/s, rad/s
GAITS = (  # velocity forward and to the left, turn rate to the left
    (0, 0, 0),
    (WALK, 0, 0),
    (-WALK, 0, 0),
    (0, WALK, 0),
    (0, -WALK, 0),
    (RUN, 0, 0),
    (WALK, 0, TURN),
    (WALK, 0, -TURN),
    (0, 0, TURN),
    (0, 0, -TURN),
)

OTHER_JSON = ("null", "true", "1e999", '""', '"text"', "{}", '{"a": 1}', '["abc"]', '[{"a": 1}]', "[null]", "[" * 9000)
"""Text that is JSON, or begins like it, and no list of rows."""


def install(package: str) -> str:
    """Install and enable the add-on's zip with Blender's own operators, and return the name of its module."""
    if bpy.app.version >= (4, 2, 0):
        bpy.ops.extensions.package_install_files(filepath=package, repo="user_default", enable_on_install=True)
        return "bl_ext.user_default.fragmotion"
    bpy.ops.preferences.addon_install(filepath=package)
    bpy.ops.preferences.addon_enable(module="fragmotion")
    return "fragmotion"


def window() -> bpy.types.Window:
    """The window, by what owns it: up to Blender 4.3 the context's may be owned by a scene that is gone, into which it
    then writes (compat.versions.own_by_shown_scene)."""
    return bpy.context.window_manager.windows[0]


def export_gltf(path: Path | str, **options: object) -> None:
    """Write by Blender's exporter, which shows scenes in the context's window; the one that is shown owns that."""
    _ = bpy.context.layer_collection
    assert bpy.ops.export_scene.gltf(filepath=str(path), **options) == {"FINISHED"}


def open_sample() -> bpy.types.Object:
    """The sample file's armature, active."""
    return open_armature(SAMPLE)


def open_armature(path: Path) -> bpy.types.Object:
    """The armature of the sample file or of one made from it, active."""
    bpy.ops.wm.open_mainfile(filepath=str(path))
    obj = bpy.data.objects[ARMATURE]
    activate(obj)
    return obj


def waves(frames: int, channels: int, seed: int) -> np.ndarray:
    """Smooth pseudo-random curves [frames, channels] in [-1, 1]."""
    random = np.random.default_rng(seed)
    speed, phase = random.uniform(0.05, 0.3, channels), random.uniform(0, 6, channels)
    return np.sin(np.arange(frames)[:, None] * speed + phase)


def write_bvh(path: Path, frames: int = 40, seed: int = 1, frame_time: float = 1 / 30) -> Path:
    """A small take: a walker's bones moving at random, root and hips travelling."""
    rows = 40 * waves(frames, BVH_CHANNELS, seed)
    rows[:, 6:9] = (1, 95, 3) + 5 * waves(frames, 3, seed + 1)
    rows[:, 2] += 3 * np.arange(frames)
    return _write_motion(path, rows, frame_time)


def _write_motion(path: Path, rows: np.ndarray, frame_time: float) -> Path:
    motion = "\n".join(" ".join(f"{value:.6f}" for value in row) for row in rows)
    path.write_text(f"{BVH_HIERARCHY}MOTION\nFrames: {len(rows)}\nFrame Time: {frame_time:.7f}\n{motion}\n")
    return path


def write_gaits(folder: Path) -> None:
    """Takes of a walker that goes where it is told: standing, ways in four directions, a run, curves and turns."""
    for index, gait in enumerate(GAITS):
        _write_motion(folder / f"gait {index}.bvh", _walk(*gait), 1 / 30)


def _walk(forward: float, left: float, turn: float, frames: int = 91) -> np.ndarray:
    """A stiff-legged gait that faces z at first: BVH_HIERARCHY's channels [frames, BVH_CHANNELS] at 30 frames a second,
    two steps a second."""
    time = np.arange(frames) / 30
    heading, stride = turn * time, 2 * np.pi * time
    velocity = (left + 1j * forward) * (np.cos(heading) - 1j * np.sin(heading))  # x + iz
    moving = min(1.0, math.hypot(forward, left) / WALK)
    rows = np.zeros((frames, BVH_CHANNELS))
    path = 100 * np.cumsum(velocity) / 30
    rows[:, 6:9] = np.column_stack([path.real, 95 + 2 * moving * np.cos(2 * stride), path.imag])
    rows[:, 11] = np.degrees(heading)
    for thigh, foot, side in ((16, 18, 1), (22, 24, -1)):
        rows[:, thigh] = side * 23 * moving * np.sin(stride)
        rows[:, foot] = -rows[:, thigh]
    return rows


def add_armature(bones: Iterable[Any] = BODY, name: str = "Rig", connected: Sequence[str] = ()) -> bpy.types.Object:
    """An armature object with these bones, each with a roll of its own, active."""
    obj = bpy.data.objects.new(name, bpy.data.armatures.new(name))
    bpy.context.scene.collection.objects.link(obj)
    activate(obj)
    bpy.ops.object.mode_set(mode="EDIT")
    for index, (bone_name, parent, head, tail) in enumerate(bones):
        bone = obj.data.edit_bones.new(bone_name)
        bone.head, bone.tail, bone.roll = head, tail, 0.3 * index
        bone.parent = obj.data.edit_bones[parent] if parent else None
        bone.use_connect = bone_name in connected
    bpy.ops.object.mode_set(mode="OBJECT")
    return obj


@contextmanager
def editing(obj: bpy.types.Object) -> Iterator[Any]:
    """The armature's edit bones, in Edit Mode."""
    activate(obj)
    bpy.ops.object.mode_set(mode="EDIT")
    yield obj.data.edit_bones
    bpy.ops.object.mode_set(mode="OBJECT")


def add_mesh(parent: bpy.types.Object | None = None) -> bpy.types.Object:
    """A mesh object without vertices, a child of `parent`."""
    obj = bpy.data.objects.new("Body", bpy.data.meshes.new("Body"))
    obj.parent = parent
    bpy.context.scene.collection.objects.link(obj)
    return obj


def activate(obj: bpy.types.Object) -> None:
    """Select the object alone and make it active."""
    for other in bpy.context.view_layer.objects:
        other.select_set(other == obj)
    bpy.context.view_layer.objects.active = obj


def add_action(
    obj: bpy.types.Object, frames: int = 12, seed: int = 1, name: str = "take", swing: float = 0.7
) -> bpy.types.Action:
    """Key every bone's rotation in its own mode, up to `swing` rad about each axis, and the locations of root and hips,
    on frames 1, 2, ..., by Blender's own keyframe_insert; the object keeps playing the Action."""
    obj.animation_data_clear()
    for index, bone in enumerate(obj.pose.bones):
        channel = {"QUATERNION": "rotation_quaternion", "AXIS_ANGLE": "rotation_axis_angle"}.get(
            bone.rotation_mode, "rotation_euler"
        )
        size = len(getattr(bone, channel))
        angles = waves(frames, 4, seed + 10 * index)
        rest = np.array([1, 0, 0, 0]) if bone.rotation_mode == "QUATERNION" else np.zeros(size)
        for frame in range(frames):
            setattr(bone, channel, (rest + swing * angles[frame, :size]).tolist())
            bone.keyframe_insert(channel, frame=frame + 1)
    for name_moving in ("root", "hips"):
        if name_moving in obj.pose.bones:
            for frame, place in enumerate(waves(frames, 3, seed + 5)):
                obj.pose.bones[name_moving].location = place.tolist()
                obj.pose.bones[name_moving].keyframe_insert("location", frame=frame + 1)
    action = obj.animation_data.action
    action.name = name
    return action


def play(obj: bpy.types.Object, action: bpy.types.Action, time: float) -> bpy.types.Object:
    """The object as Blender evaluates it at a time while it plays the Action."""
    data = obj.animation_data or obj.animation_data_create()
    if data.action != action:
        data.action = action
        if bpy.app.version >= (4, 4, 0):
            data.action_slot = action.slots[0]
    whole = int(np.floor(time + 1e-4))
    bpy.context.scene.frame_set(whole, subframe=min(max(time - whole, 0), 0.9999))
    return obj.evaluated_get(bpy.context.evaluated_depsgraph_get())


def blender_poses(
    obj: bpy.types.Object, action: bpy.types.Action, times: Iterable[float], bones: Sequence[str]
) -> np.ndarray:
    """World matrices [F, B, 4, 4] of bones as Blender evaluates them."""
    matrices = []
    for time in times:
        posed = play(obj, action, time)
        matrices.append([np.array(posed.matrix_world @ posed.pose.bones[name].matrix) for name in bones])
    return np.array(matrices)


def to_matrices(rotations: np.ndarray) -> np.ndarray:
    """Quaternions [..., 4] to rotation matrices [..., 3, 3]."""
    w, x, y, z = np.moveaxis(np.asarray(rotations), -1, 0)
    rows = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]
    return np.moveaxis(np.array(rows), (0, 1), (-2, -1))


def assert_same_poses(matrices: np.ndarray, heads: np.ndarray, rotations: np.ndarray | None, tolerance: float) -> None:
    """Blender's matrices [F,B,4,4] and the core's heads [F,B,3] (and rotations [F,B,4]) tell the same pose."""
    np.testing.assert_allclose(matrices[..., :3, 3], heads, atol=tolerance)
    if rotations is not None:
        blender = matrices[..., :3, :3] / np.linalg.norm(matrices[..., :3, :3], axis=-2, keepdims=True)
        np.testing.assert_allclose(blender, to_matrices(rotations), atol=tolerance)


def body_bones(skeleton: Any) -> list[int]:
    """Indices of the skeleton's bones from the hips down; those above follow the character frame."""
    below: list[int] = []
    hips = skeleton.names.index(skeleton.roles["hips"])
    for index, parent in enumerate(skeleton.parents):
        if index == hips or parent in below:
            below.append(index)
    return below


def contents() -> dict[str, Any]:
    """What is in the file, to tell whether something changed it."""
    bpy.context.view_layer.update()  # an operator's call does so too
    obj = bpy.context.view_layer.objects.active
    return {
        "objects": sorted(o.name for o in bpy.data.objects),
        "armatures": sorted(a.name for a in bpy.data.armatures),
        "actions": sorted((a.name, a.users, tuple(a.frame_range)) for a in bpy.data.actions),
        "frame": bpy.context.scene.frame_current_final,
        "end": bpy.context.scene.frame_end,
        "active": obj and obj.name,
        "mode": bpy.context.mode,
        "selected": sorted(o.name for o in bpy.context.selected_objects),
        "poses": {o.name: [b.matrix_basis.copy() for b in o.pose.bones] for o in bpy.data.objects if o.pose},
        "policies": {o.name: o.fragmotion.policy for o in bpy.data.objects},
        "playing": {o.name: o.animation_data and o.animation_data.action for o in bpy.data.objects},
    }
