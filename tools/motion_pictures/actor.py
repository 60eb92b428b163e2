# SPDX-License-Identifier: MIT
"""A character in Blender that is posed by motions and rendered by Workbench, which needs neither display nor GPU."""

from __future__ import annotations

import math
import sys
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from typing import Any

import fragmotion_core as core
import numpy as np
from numpy.typing import NDArray

from tools.measuring.blend import addon, read_actions
from tools.motion_pictures.motions import Motion
from tools.paths import TOP

bpy: Any = import_module("bpy")
mathutils: Any = import_module("mathutils")
sys.path.insert(0, str(TOP / "sample_rigs"))
filmstrip: Any = import_module("filmstrip")
stage: Any = import_module("stage")

PAPER = (0.93, 0.93, 0.92)
_GROUND = (1.6, 1.6, 1.56)  # much more than white, as it is lit at a slant
_FROM = (-62.0, 9.0)  # degrees, of the camera of a strip: to the left of the character's front, and upward
_BELOW = 0.1  # statures of ground that a strip shows
_FIRST = 1  # frame


class Actor:
    """An armature whose Action is the motion that it was last given; without meshes it is drawn as sticks."""

    def __init__(self, armature: Any) -> None:
        self.armature, self.rig = armature, addon("rig.rigs").make_rig(armature)
        self._moving = addon("rig.rigs").carriers(armature, self.rig)
        self.stature = self.rig.skeleton.stature

    def play(self, motion: Motion) -> None:
        """Let the armature do the motion, its frame f at the scene's frame f + 1."""
        action = bpy.data.actions.new(motion.name)
        channels = self.rig.channels(motion.roots, motion.rotations)
        times = np.arange(len(motion.roots), dtype=float) + _FIRST
        addon("rig.writing").write_poses(action, self.armature, times, *channels, self._moving)
        addon("compat.versions").assign(self.armature, action)

    def strip(
        self, motion: Motion, frames: Sequence[int], places: Sequence[float], width: float, pixels: tuple[int, int]
    ) -> NDArray[Any]:
        """A picture [H,W,3] of the frames side by side, their middles `places` m from its left edge, which is `width` m
        wide. Where the character faces at first lies to the right."""
        self.play(motion)
        with stage.stage() as scene:
            use_workbench(scene)
            heading, (side, up) = motion.path[0, 2], np.radians(_FROM)
            front = mathutils.Vector((-math.sin(side), math.cos(side), 0))
            right = mathutils.Vector((-front.y, front.x, 0))
            for frame, place in zip(frames, places):
                moment = filmstrip.freeze(self.armature, scene, frame + _FIRST)
                x, y, _ = motion.path[frame]
                add_disc(scene, right * place, 0.3 * self.stature)
                turned = mathutils.Matrix.Rotation(-heading, 4, "Z") @ mathutils.Matrix.Translation((-x, -y, 0))
                for ghost in moment.ghosts:
                    ghost.matrix_world = mathutils.Matrix.Translation(right * place) @ turned @ ghost.matrix_world
            _aim(scene, front, right, up, width, pixels, self.stature)
            return upright(stage.render(scene, pixels))


def seen(vector: NDArray[Any]) -> NDArray[Any]:
    """A vector [3], m in the character frame of a strip's first pose, as a strip shows it: m to the right and up."""
    side, up = np.radians(_FROM)
    front = np.array([-np.sin(side), np.cos(side), 0])
    right = np.array([-front[1], front[0], 0])
    return np.array([vector @ right, vector @ [0, 0, np.cos(up)] - vector @ front * np.sin(up)])


def above_the_lower_edge(height: float, stature: float) -> float:
    """How far over a strip's lower edge it shows what is so high over the ground, m."""
    return float((height + _BELOW * stature) * np.cos(np.radians(_FROM[1])))


def open_blend(path: Path) -> tuple[Actor, list[core.Clip]]:
    """The armature of a .blend, and its Actions."""
    _, clips = read_actions(path)
    return Actor(next(thing for thing in bpy.context.scene.objects if thing.type == "ARMATURE")), clips


def open_folder(folder: Path) -> tuple[Actor, list[core.Clip]]:
    """An armature with the bones of the folder's BVH files, and these on it."""
    bpy.ops.wm.read_homefile(use_empty=True)
    takes = [core.read_bvh(path) for path in sorted(folder.glob("*.bvh"))]
    actor = Actor(addon("mocap.importing").make_armature(bpy.context, folder.name, takes[0].skeleton))
    return actor, [actor.rig.clip(take.name, take.rate, *actor.rig.take_channels(take)) for take in takes]


def _aim(
    scene: Any, front: Any, right: Any, up: float, width: float, pixels: tuple[int, int], stature: float
) -> None:  # fmt: skip
    """An orthographic camera that sees the row of bodies from their front."""
    camera = scene.camera
    camera.data.type, camera.data.sensor_fit, camera.data.ortho_scale = "ORTHO", "HORIZONTAL", width
    camera.data.clip_end = 100 * stature
    tall = width * pixels[1] / pixels[0]
    target = right * (width / 2) + mathutils.Vector((0, 0, tall / 2 / math.cos(up) - _BELOW * stature))
    position = target + (front * math.cos(up) + mathutils.Vector((0, 0, math.sin(up)))) * 20 * stature
    camera.matrix_world = stage.looking_at(position, target)


def use_workbench(scene: Any) -> None:
    """Even light, materials' own colours, darker corners; shadows would take software ten times as long."""
    scene.render.engine = "BLENDER_WORKBENCH"
    scene.view_settings.view_transform = "Standard"
    shading = scene.display.shading
    shading.light, shading.color_type = "STUDIO", "MATERIAL"
    shading.show_cavity = True
    scene.world.color = tuple(value**2.2 for value in PAPER)


def add_disc(scene: Any, middle: Any, radius: float, colour: tuple[float, float, float] = _GROUND) -> Any:
    """A flat disc, as a piece of the ground or a mark on it."""
    angles = np.linspace(0, 2 * np.pi, 48, endpoint=False)
    return add_mesh(scene, [(radius * np.cos(a), radius * np.sin(a), 0) for a in angles], [range(48)], [colour], middle)


def add_mesh(
    scene: Any, points: Sequence[Any], faces: Sequence[Any], colours: Sequence[tuple[float, float, float]],
    middle: Any = (0, 0, 0),
) -> Any:  # fmt: skip
    """An object whose faces take turns with the colours."""
    mesh = bpy.data.meshes.new("Drawn")
    mesh.from_pydata(points, [], faces)
    for colour in colours:
        material = bpy.data.materials.new("Drawn")
        material.diffuse_color, material.roughness = (*colour, 1), 0.8
        mesh.materials.append(material)
    mesh.polygons.foreach_set("material_index", np.arange(len(faces), dtype=np.int32) % len(colours))
    drawn = bpy.data.objects.new("Drawn", mesh)
    drawn.location = middle
    scene.collection.objects.link(drawn)
    return drawn


def upright(picture: NDArray[Any]) -> NDArray[Any]:
    """First row at the top."""
    clipped: NDArray[Any] = np.clip(picture[::-1], 0, 1)
    return clipped
