# SPDX-License-Identifier: MIT
"""Render a character's motion as one picture: a strip of moments and a bird's-eye view of its path.

blender -b FILE.blend --python sample_rigs/filmstrip.py -- --object NAME --action NAME --frames 12 --output OUT.png

Needs neither display nor GPU (Cycles on the CPU, a fraction of a second a tile); runs in Blender 3.4 to 5.x and in the
bpy module. The user's scene is left as it was: poses are frozen to meshes and rendered in a scene of their own.
"""

from __future__ import annotations

import argparse
import contextlib
import math
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import bpy
import numpy as np
from mathutils import Matrix, Vector

sys.path.insert(0, str(Path(__file__).resolve().parent))

import stage

TILE = (240, 330)  # pixels, width and height


@dataclass
class Moment:
    """A frozen pose: its frame, mesh objects, ground position of the body's middle and the way it faces (unit)."""

    frame: int
    ghosts: list[bpy.types.Object]
    middle: Vector
    facing: Vector


def render_filmstrip(
    armature: bpy.types.Object, action: bpy.types.Action | None, output: str, frames: int = 12, rows: int | None = None,
    frame_range: tuple[float, float] | None = None, birdseye: bool = True, azimuth: float = 50.0,
) -> str:  # fmt: skip
    """Write the PNG `output` and return its path. action None renders what the armature now plays.

    azimuth is the camera's angle from the character's front to its left at the first frame, degrees; the camera then
    follows without turning, so that turning on the spot can be seen.
    """
    with stage.stage() as scene, _playing(armature, action):
        span = frame_range or _span(armature)
        numbers = sorted({round(f) for f in np.linspace(span[0], span[1], max(frames, 2))})
        moments = [freeze(armature, scene, frame) for frame in numbers]
        size = _stature(armature)
        stage.add_ground(scene, size)
        height = max([0.98 * size] + [_top(moment) for moment in moments])
        tiles = [_tile(scene, moments, moment, height, azimuth) for moment in moments]
        columns = math.ceil(len(tiles) / (rows or (1 if frames <= 8 else 2)))
        picture = stage.grid(tiles, columns)
        if birdseye:
            picture = stage.stack([picture, _birdseye(scene, moments, size, picture.shape[1])])
        name = action.name if action else armature.name
        title = f"{name}   frames {numbers[0]}-{numbers[-1]}, {scene.render.fps} fps"
        picture = stage.stack([stage.caption(title, picture.shape[1]), picture])
    return stage.write(picture, output)


# Poses.

_CHANNELS = ("location", "rotation_quaternion", "rotation_euler", "rotation_axis_angle", "scale")


@contextlib.contextmanager
def _playing(armature: bpy.types.Object, action: bpy.types.Action | None) -> Iterator[None]:
    """Let the armature play the action; afterwards its action, pose and the frame are as before."""
    scene = bpy.context.scene
    had_data, frame = armature.animation_data is not None, (scene.frame_current, scene.frame_subframe)
    data = armature.animation_data or armature.animation_data_create()
    before, slot, use_nla = data.action, getattr(data, "action_slot", None), data.use_nla
    pose = {bone.name: [tuple(getattr(bone, c)) for c in _CHANNELS] for bone in armature.pose.bones}
    try:
        if action:
            data.use_nla = False
            assign_action(data, action)
        yield
    finally:
        data.action, data.use_nla = before, use_nla
        if slot:
            data.action_slot = slot
        scene.frame_set(frame[0], subframe=frame[1])
        if not had_data:
            armature.animation_data_clear()
        for name, values in pose.items():
            for channel, value in zip(_CHANNELS, values):
                setattr(armature.pose.bones[name], channel, value)
        bpy.context.view_layer.update()


def assign_action(data: bpy.types.AnimData, action: bpy.types.Action) -> None:
    """Assign an Action and, from Blender 4.4, the slot it needs to have any effect."""
    data.action = action
    if hasattr(data, "action_slot") and data.action_slot is None:
        fitting = [slot for slot in action.slots if slot.target_id_type in ("OBJECT", "UNSPECIFIED")]
        if not fitting:
            raise ValueError(f"Action {action.name!r} has no slot for an object")
        data.action_slot = fitting[0]


def _span(armature: bpy.types.Object) -> tuple[float, float]:
    """First and last frame of the action that plays, or of the scene."""
    data, scene = armature.animation_data, bpy.context.scene
    if data and data.action:
        return tuple(data.action.frame_range)
    return scene.frame_start, scene.frame_end


def freeze(armature: bpy.types.Object, scene: bpy.types.Scene, frame: int) -> Moment:
    """Copy the deformed meshes (or sticks for the bones) at a frame to the stage."""
    bpy.context.scene.frame_set(frame)
    depsgraph = bpy.context.evaluated_depsgraph_get()
    ghosts = []
    for skin in skins(armature):
        evaluated = skin.evaluated_get(depsgraph)
        mesh = bpy.data.meshes.new_from_object(evaluated, depsgraph=depsgraph)
        ghosts.append(_ghost(scene, mesh, evaluated.matrix_world))
    if not ghosts:
        ghosts.append(_ghost(scene, _sticks(armature), armature.matrix_world))
    heads = [armature.matrix_world @ bone.head for bone in armature.pose.bones if bone.parent]
    middle = sum(heads, Vector()) / max(len(heads), 1)
    return Moment(frame, ghosts, Vector((middle.x, middle.y, 0)), _facing(armature))


def skins(armature: bpy.types.Object) -> list[bpy.types.Object]:
    """Visible meshes that the armature deforms or carries."""

    def moved(thing: bpy.types.Object) -> bool:
        modified = any(m.type == "ARMATURE" and m.object == armature for m in thing.modifiers)
        return modified or (thing.parent == armature and thing.parent_type == "BONE")

    return [o for o in bpy.context.scene.objects if o.type == "MESH" and not o.hide_render and moved(o)]


def _ghost(scene: bpy.types.Scene, mesh: bpy.types.Mesh, matrix: Matrix) -> bpy.types.Object:
    ghost = bpy.data.objects.new("Ghost", mesh)
    ghost.matrix_world = matrix.copy()
    scene.collection.objects.link(ghost)
    return ghost


def _sticks(armature: bpy.types.Object) -> bpy.types.Mesh:
    """One mesh with an octahedron along every posed bone; bones of the left and right side are coloured."""
    least = _stature(armature) * 0.004 / armature.matrix_world.median_scale
    vertices: list[Vector] = []
    faces: list[list[int]] = []
    slots: list[int] = []
    for bone in (b for b in armature.pose.bones if b.length > least and not _is_root(b)):
        width, start = max(bone.length * 0.11, 2.5 * least), len(vertices)
        ring = [(width, 0.12, 0), (0, 0.12, width), (-width, 0.12, 0), (0, 0.12, -width)]
        points = [(0, 0, 0), *((x, y * bone.length, z) for x, y, z in ring), (0, bone.length, 0)]
        vertices += [bone.matrix @ Vector(point) for point in points]
        for k in range(4):
            this, following = start + 1 + k, start + 1 + (k + 1) % 4
            faces += [[start, this, following], [start + 5, following, this]]
        slots += [_side(bone.name)] * 8
    mesh = bpy.data.meshes.new("Sticks")
    mesh.from_pydata(vertices, [], faces)
    for name, colour in (("Middle", (0.5, 0.5, 0.5)), ("Left", (0.02, 0.3, 0.42)), ("Right", (0.8, 0.2, 0.03))):
        mesh.materials.append(stage.material("Filmstrip " + name, colour))
    mesh.polygons.foreach_set("material_index", np.array(slots, dtype=np.int32))
    return mesh


def _is_root(bone: bpy.types.PoseBone) -> bool:
    """A control bone on the ground, not a part of the body."""
    return bone.parent is None and bone.bone.head_local.z < 0.05 * bone.length and abs(bone.bone.vector.z) < 1e-6


def _side(name: str) -> int:
    """0 middle, 1 left, 2 right, by the bone's name."""
    if re.search(r"(\.L|_L|\.l|_l)$|[Ll]eft|^l[A-Z]|^l(femur|tibia|foot|toes|hum|rad|hand|clav|hip)", name):
        return 1
    right = r"(\.R|_R|\.r|_r)$|[Rr]ight|^r[A-Z]|^r(femur|tibia|foot|toes|hum|rad|hand|clav|hip)"
    return 2 if re.search(right, name) else 0


def _facing(armature: bpy.types.Object) -> Vector:
    """Horizontal unit vector ahead, from the posed left and right bones; -y if names do not tell."""
    sides = [Vector(), Vector(), Vector()]
    counts = [0, 0, 0]
    for bone in armature.pose.bones:
        sides[_side(bone.name)] += armature.matrix_world @ bone.head
        counts[_side(bone.name)] += 1
    if not counts[1] or counts[1] != counts[2]:
        return Vector((0, -1, 0))
    ahead = (sides[1] - sides[2]).cross(Vector((0, 0, 1)))
    return ahead.normalized() if ahead.length > 1e-6 else Vector((0, -1, 0))


def _stature(armature: bpy.types.Object) -> float:
    """Height of the character as it is posed now, in world units. The rest pose of mocap may be no pose at all."""
    body = [bone for bone in armature.pose.bones if not _is_root(bone)] or list(armature.pose.bones)
    if not body:
        raise ValueError(f"armature {armature.name!r} has no bones")
    heights = [(armature.matrix_world @ end).z for bone in body for end in (bone.head, bone.tail)]
    return max(heights) - min(heights) or 1.0


def _top(moment: Moment) -> float:
    """Height of the highest vertex."""
    corners = [ghost.matrix_world @ Vector(corner) for ghost in moment.ghosts for corner in ghost.bound_box]
    return max(corner.z for corner in corners)


def _tile(scene: bpy.types.Scene, moments: list[Moment], shown: Moment, height: float, azimuth: float) -> np.ndarray:
    """One moment, seen by the following camera, with its frame number."""
    _show(moments, [shown])
    target = shown.middle + Vector((0, 0, 0.51 * height))
    ahead = Matrix.Rotation(math.radians(azimuth), 3, "Z") @ moments[0].facing
    camera = scene.camera
    camera.data.type, camera.data.lens, camera.data.sensor_fit = "PERSP", 70, "VERTICAL"
    camera.data.clip_end = 1000 * height
    position = target + ahead * 3.8 * height + Vector((0, 0, 1.0 * height))
    camera.matrix_world = stage.looking_at(position, target)
    picture = stage.render(scene, TILE)
    return stage.stack([picture, stage.caption(str(shown.frame), TILE[0])])


def _birdseye(scene: bpy.types.Scene, moments: list[Moment], size: float, width: int) -> np.ndarray:
    """All moments from above with the path of the body's middle; the longer side of the path lies across."""
    _show(moments, _apart(moments, 0.42 * size))
    points = np.array([moment.middle[:2] for moment in moments])
    centre, (extent, depth), across = _box(points)
    span = extent + 1.3 * size
    height = int(np.clip(width * (depth + 1.0 * size) / span, 160, 520))
    _add_path(scene, moments, size)
    camera = scene.camera
    camera.data.type, camera.data.sensor_fit = "ORTHO", "HORIZONTAL"
    camera.data.ortho_scale = max(span, (depth + 1.0 * size) * width / height)
    turned = Matrix.Rotation(math.atan2(across[1], across[0]), 4, "Z")
    camera.matrix_world = Matrix.Translation((centre[0], centre[1], 10 * size)) @ turned
    return stage.render(scene, (width, height))


def _show(moments: list[Moment], shown: list[Moment]) -> None:
    """Hide the ghosts of all other moments."""
    for moment in moments:
        for ghost in moment.ghosts:
            ghost.hide_render = not any(moment is one for one in shown)


def _apart(moments: list[Moment], least: float) -> list[Moment]:
    """Moments whose bodies do not stand in one another: the first, then each that is far enough from all before."""
    chosen: list[Moment] = []
    for moment in moments:
        if all((moment.middle - other.middle).length > least for other in chosen):
            chosen.append(moment)
    return chosen


def _box(points: np.ndarray) -> tuple[np.ndarray, tuple[float, float], np.ndarray]:
    """Centre, extents and long direction of the points' box, turned to their first-to-last or longest direction."""
    spread = points - points.mean(axis=0)
    across = np.linalg.svd(spread)[2][0] if len(points) > 1 and np.ptp(spread) > 1e-3 else np.array([1.0, 0.0])
    across = across if across @ (points[-1] - points[0]) >= 0 else -across
    axes = np.stack([across, [-across[1], across[0]]])
    local = points @ axes.T
    centre = (local.min(axis=0) + local.max(axis=0)) / 2
    extent, depth = np.ptp(local, axis=0)
    return centre @ axes, (float(extent), float(depth)), across


def _add_path(scene: bpy.types.Scene, moments: list[Moment], size: float) -> None:
    """A ribbon just above the ground through the moments' positions."""
    curve = bpy.data.curves.new("Path", "CURVE")
    curve.dimensions, curve.bevel_depth = "3D", 0.008 * size
    spline = curve.splines.new("POLY")
    spline.points.add(len(moments) - 1)
    for point, moment in zip(spline.points, moments):
        point.co = (moment.middle.x, moment.middle.y, 0.02 * size, 1)
    curve.materials.append(stage.material("Filmstrip Path", (0.9, 0.65, 0.02)))
    scene.collection.objects.link(bpy.data.objects.new("Path", curve))


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="filmstrip.py", description=__doc__)
    parser.add_argument("--object", help="armature object; the only one if left out")
    parser.add_argument("--action", help="Action to play; what is assigned if left out")
    parser.add_argument("--frames", type=int, default=12, help="how many moments")
    parser.add_argument("--range", type=float, nargs=2, metavar=("FIRST", "LAST"), help="frames; the whole Action")
    parser.add_argument("--rows", type=int, help="rows of the strip; 1 up to 8 frames, else 2")
    parser.add_argument("--azimuth", type=float, default=50.0, help="camera, degrees from the front to the left")
    parser.add_argument("--output", required=True, help="PNG to write")
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else [])


def main() -> None:
    """Command line: see the module's text."""
    arguments = _arguments()
    armatures = [o for o in bpy.context.scene.objects if o.type == "ARMATURE"]
    found = [o for o in armatures if arguments.object in (None, o.name)]
    if len(found) != 1:
        raise SystemExit(f"--object: choose one armature of {[o.name for o in armatures]}")
    action = bpy.data.actions.get(arguments.action) if arguments.action else None
    if arguments.action and not action:
        raise SystemExit(f"--action: {arguments.action!r} is none of {[a.name for a in bpy.data.actions]}")
    path = render_filmstrip(
        found[0], action, arguments.output, arguments.frames, arguments.rows, arguments.range,
        azimuth=arguments.azimuth,
    )  # fmt: skip
    print(f"Filmstrip: {path}")


if __name__ == "__main__":
    main()
