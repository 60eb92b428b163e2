# SPDX-License-Identifier: MIT
"""The pictures of docs/retargeting.md: Rigify's human, which follows a take, or a character of an FBX file, which does
what it does. `dev.py docs retargeting` runs this in Debian's Blender; arguments after `--`: the add-on's zip, the take,
the picture, and for the second kind the FBX file."""

from __future__ import annotations

import sys
from importlib import import_module
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

TOP = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(TOP / "tests" / "blender"), str(TOP / "sample_rigs")]

making: Any = import_module("making")
filmstrip: Any = import_module("filmstrip")
stage: Any = import_module("stage")

MOMENTS, QUALITY = 12, 85
AROUND, RINGS = 16, 9  # of a part of the body
COLOURS = {"": (0.5, 0.5, 0.52), "left": (0.02, 0.3, 0.42), "right": (0.8, 0.2, 0.03)}
THICK = {  # half width and half depth of a part of the body, m
    **{"hips": (0.17, 0.11), "spine_1": (0.14, 0.1), "spine_2": (0.16, 0.11), "spine_3": (0.17, 0.11)},
    **{"neck_1": (0.05, 0.05), "head": (0.085, 0.1), "shoulder": (0.05, 0.05), "upper_arm": (0.05, 0.05)},
    **{"lower_arm": (0.04, 0.04), "hand": (0.045, 0.025), "thigh": (0.085, 0.085), "shin": (0.055, 0.055)},
    **{"foot": (0.045, 0.04), "toe": (0.045, 0.03)},
}
OVER = 0.12  # of its length, how far a part reaches beyond its joints


def main(package: str, take: str, picture: str, *character: str) -> None:
    """Let the character do what the take does, and draw it."""
    addon = import_module(making.install(package))
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.context.scene.render.fps = 30
    path, target = Path(take).resolve(), Path(picture)
    obj, action = performed(path, *character) if character else followed(addon, path)
    with TemporaryDirectory() as folder:
        strip = filmstrip.render_filmstrip(obj, action, str(Path(folder) / "strip.png"), MOMENTS, birdseye=False)
        save_jpeg(strip, target)
    print(f"{target}: {target.stat().st_size / 1000:.0f} kB")


def save_jpeg(picture: str, target: Path) -> None:
    """A PNG as a JPEG, its colours unchanged."""
    scene = bpy.context.scene
    scene.view_settings.view_transform = "Standard"
    scene.render.image_settings.file_format = "JPEG"
    scene.render.image_settings.quality = QUALITY
    bpy.data.images.load(picture).save_render(str(target), scene=scene)


def followed(addon: Any, take: Path) -> tuple[bpy.types.Object, bpy.types.Action]:
    """Rigify's human with the keys of its controls for a take."""
    rig = rigify_human()
    making.activate(rig)
    add_body(rig, addon.control_rig.joints.find_joints(rig))
    assert bpy.ops.fragmotion.bind_rig() == {"FINISHED"}
    import_take(take)
    assert bpy.ops.fragmotion.bake_to_controls("EXEC_DEFAULT") == {"FINISHED"}
    action = rig.animation_data.action
    action.name = f"{take.stem} on Rigify's human"
    return rig, action


def performed(take: Path, character: str) -> tuple[bpy.types.Object, bpy.types.Action]:
    """A file's character with the Action that the take became on it."""
    bpy.ops.import_scene.fbx(filepath=str(Path(character).resolve()))
    obj = next(obj for obj in bpy.data.objects if obj.type == "ARMATURE")
    making.activate(obj)
    return obj, import_take(take)


def import_take(take: Path) -> bpy.types.Action:
    """The take on the active armature."""
    before = set(bpy.data.actions)
    files = [{"name": take.name}]
    assert bpy.ops.fragmotion.import_mocap(directory=str(take.parent), files=files, onto="ACTIVE") == {"FINISHED"}
    return next(action for action in bpy.data.actions if action not in before)


def rigify_human() -> bpy.types.Object:
    """The rig that Rigify generates from its human meta-rig."""
    bpy.ops.preferences.addon_enable(module="rigify")
    bpy.ops.object.armature_human_metarig_add()
    metarig = bpy.context.object
    bpy.ops.pose.rigify_generate()
    return next(obj for obj in bpy.data.objects if obj.type == "ARMATURE" and obj != metarig)


def add_body(rig: bpy.types.Object, joints: Any) -> None:
    """A mesh that the rig deforms: a rounded part for each joint's bone."""
    for role, joint in joints.items():
        side, _, part = role.partition("_") if role.startswith(("left_", "right_")) else ("", "", role)
        if part not in THICK:
            continue
        mesh = bpy.data.meshes.new(role)
        vertices, faces = rounded(np.array(joint.head), np.array(joint.tail), *THICK[part])
        mesh.from_pydata(vertices.tolist(), [], faces)
        mesh.materials.append(stage.material(f"Body {side}", COLOURS[side]))
        mesh.polygons.foreach_set("use_smooth", [True] * len(faces))
        obj = bpy.data.objects.new(role, mesh)
        bpy.context.scene.collection.objects.link(obj)
        obj.vertex_groups.new(name=joint.bone).add(range(len(vertices)), 1.0, "REPLACE")
        modifier: Any = obj.modifiers.new("Rig", "ARMATURE")
        modifier.object = rig


def rounded(
    head: NDArray[np.float64], tail: NDArray[np.float64], width: float, depth: float
) -> tuple[NDArray[np.float64], list[list[int]]]:
    """Vertices and faces of a closed tube from head to tail with round ends."""
    way = tail - head
    along = way / np.linalg.norm(way)
    aside = np.array((1.0, 0, 0) if abs(along[0]) < 0.7 else (0, 1.0, 0))
    aside -= (aside @ along) * along
    aside /= np.linalg.norm(aside)
    height, turn = np.meshgrid(
        np.linspace(0.03, np.pi - 0.03, RINGS), 2 * np.pi * np.arange(AROUND) / AROUND, indexing="ij"
    )
    thickness = np.sin(height) ** 0.6
    offsets = (
        -(0.5 + OVER) * np.cos(height)[..., None] * way
        + (width * thickness * np.cos(turn))[..., None] * aside
        + (depth * thickness * np.sin(turn))[..., None] * np.cross(along, aside)
    )
    vertices = ((head + tail) / 2 + offsets).reshape(-1, 3)
    ring = np.arange(AROUND)
    faces = [
        [AROUND * k + i, AROUND * k + j, AROUND * (k + 1) + j, AROUND * (k + 1) + i]
        for k in range(RINGS - 1)
        for i, j in zip(ring.tolist(), np.roll(ring, -1).tolist())
    ]
    ends = [ring[::-1].tolist(), (AROUND * (RINGS - 1) + ring).tolist()]
    return vertices, [*faces, *ends]


main(*sys.argv[sys.argv.index("--") + 1 :])
