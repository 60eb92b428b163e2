# SPDX-License-Identifier: MIT
"""A temporary Cycles stage for pictures, and pictures as arrays; no display, GPU or imaging library needed.

Pictures are float arrays [height, width, 3] of display values, first row at the bottom as Blender keeps them.
"""

from __future__ import annotations

import contextlib
import math
import os
import sys
import tempfile
from collections.abc import Iterator

import bpy
import numpy as np
from mathutils import Matrix, Vector

SAMPLES = 8
TEXT_HEIGHT = 22  # pixels
_PAPER = (0.93, 0.93, 0.92)
_COLLECTIONS = ("scenes", "objects", "meshes", "curves", "cameras", "lights", "materials", "worlds", "images")


@contextlib.contextmanager
def stage() -> Iterator[bpy.types.Scene]:
    """A temporary scene set up for quick Cycles renders."""
    kept = {name: set(getattr(bpy.data, name)) for name in _COLLECTIONS}
    scene = bpy.data.scenes.new("Filmstrip")
    scene.render.fps = bpy.context.scene.render.fps
    _set_up(scene)
    try:
        yield scene
    finally:
        for name in _COLLECTIONS:
            for block in set(getattr(bpy.data, name)) - kept[name]:
                getattr(bpy.data, name).remove(block)


def _set_up(scene: bpy.types.Scene) -> None:
    scene.render.engine = "CYCLES"
    scene.cycles.device, scene.cycles.samples, scene.cycles.use_denoising = "CPU", SAMPLES, False
    scene.cycles.use_adaptive_sampling, scene.cycles.max_bounces = False, 1
    scene.render.image_settings.file_format = "PNG"
    scene.render.resolution_percentage = 100
    scene.view_settings.view_transform = "Standard"
    world = bpy.data.worlds.new("Filmstrip")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.80, 0.86, 0.95, 1)
    world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.5
    scene.world = world
    sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    sun.data.energy, sun.data.angle = 2.2, math.radians(2)
    sun.rotation_euler = (math.radians(35), math.radians(-12), math.radians(20))
    scene.camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    for thing in (sun, scene.camera):
        scene.collection.objects.link(thing)


def add_ground(scene: bpy.types.Scene, size: float) -> None:
    """A checkered plane whose squares are 0.28 statures wide (half a metre for a person)."""
    far = 400 * size
    mesh = bpy.data.meshes.new("Ground")
    mesh.from_pydata([(-far, -far, 0), (far, -far, 0), (far, far, 0), (-far, far, 0)], [], [(0, 1, 2, 3)])
    grey = material("Filmstrip Ground", (0.5, 0.5, 0.5))
    nodes, links = grey.node_tree.nodes, grey.node_tree.links
    checker, place = nodes.new("ShaderNodeTexChecker"), nodes.new("ShaderNodeNewGeometry")
    checker.inputs["Scale"].default_value = 3.6 / size
    checker.inputs["Color1"].default_value = (0.62, 0.62, 0.61, 1)
    checker.inputs["Color2"].default_value = (0.50, 0.50, 0.49, 1)
    lift = nodes.new("ShaderNodeVectorMath")
    lift.inputs[1].default_value = (0, 0, 0.07 * size)  # away from the texture's own plane of change
    links.new(place.outputs["Position"], lift.inputs[0])
    links.new(lift.outputs["Vector"], checker.inputs["Vector"])
    links.new(checker.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
    mesh.materials.append(grey)
    scene.collection.objects.link(bpy.data.objects.new("Ground", mesh))


def material(name: str, colour: tuple[float, float, float]) -> bpy.types.Material:
    made = bpy.data.materials.get(name) or bpy.data.materials.new(name)
    made.use_nodes = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*colour, 1.0)
    shader.inputs["Roughness"].default_value = 0.7
    made.diffuse_color = (*colour, 1.0)  # which Workbench shows
    return made


def caption(text: str, width: int) -> np.ndarray:
    """Dark text on paper, TEXT_HEIGHT pixels high: a text curve rendered in a scene of its own."""
    scene = bpy.data.scenes.new("Caption")
    _set_up(scene)
    scene.cycles.samples, scene.cycles.max_bounces = 8, 0
    background = scene.world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (*(value**2.2 for value in _PAPER), 1)
    background.inputs["Strength"].default_value = 1.0
    for light in [thing for thing in scene.objects if thing.type == "LIGHT"]:
        scene.collection.objects.unlink(light)
    curve = bpy.data.curves.new("Caption", "FONT")
    curve.body, curve.size, curve.align_x = text, 0.85, "CENTER"
    curve.materials.append(_ink())
    scene.collection.objects.link(bpy.data.objects.new("Caption", curve))
    camera = scene.camera
    camera.data.type, camera.data.sensor_fit = "ORTHO", "VERTICAL"
    camera.data.ortho_scale = 1.0
    camera.matrix_world = Matrix.Translation((0, 0.28, 5))
    picture = render(scene, (width, TEXT_HEIGHT))
    bpy.data.scenes.remove(scene)
    return picture


def _ink() -> bpy.types.Material:
    """Black that needs no light."""
    ink = material("Filmstrip Ink", (0, 0, 0))
    shader = ink.node_tree.nodes["Principled BSDF"]
    shader.inputs["Roughness"].default_value = 1.0
    specular = shader.inputs.get("Specular IOR Level") or shader.inputs.get("Specular")
    specular.default_value = 0.0
    return ink


def looking_at(position: Vector, target: Vector) -> Matrix:
    """World matrix of an upright camera."""
    return Matrix.Translation(position) @ (target - position).to_track_quat("-Z", "Y").to_matrix().to_4x4()


def render(scene: bpy.types.Scene, size: tuple[int, int]) -> np.ndarray:
    """Render a scene to pixels by way of a temporary file (a background Blender keeps no render result)."""
    scene.render.resolution_x, scene.render.resolution_y = size
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = os.path.join(folder, "tile.png")
        with quiet():
            bpy.ops.render.render(write_still=True, scene=scene.name)
        image = bpy.data.images.load(scene.render.filepath)
        pixels = np.empty(size[0] * size[1] * 4, dtype=np.float32)
        image.pixels.foreach_get(pixels)
        bpy.data.images.remove(image)
    return pixels.reshape(size[1], size[0], 4)[:, :, :3]


@contextlib.contextmanager
def quiet() -> Iterator[None]:
    """Keep Cycles' progress lines, which C code prints, from the terminal."""
    sys.stdout.flush()
    saved, null = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(null, 1)
    try:
        yield
    finally:
        os.dup2(saved, 1)
        os.close(saved)
        os.close(null)


def stack(pictures: list[np.ndarray]) -> np.ndarray:
    """Pictures of one width from top to bottom."""
    return np.concatenate(pictures[::-1], axis=0)


def grid(tiles: list[np.ndarray], columns: int) -> np.ndarray:
    """Tiles in rows, left to right and top to bottom, two pixels of paper between them."""
    tall, wide, _ = tiles[0].shape
    rows = math.ceil(len(tiles) / columns)
    sheet = np.empty((rows * tall, columns * (wide + 2) - 2, 3), dtype=np.float32)
    sheet[:] = _PAPER
    for index, tile in enumerate(tiles):
        row, column = divmod(index, columns)
        top = (rows - 1 - row) * tall
        sheet[top : top + tall, column * (wide + 2) : column * (wide + 2) + wide] = tile
    return sheet


def write(picture: np.ndarray, output: str) -> str:
    """Write a PNG with Blender's own image code."""
    output = os.path.abspath(output)
    tall, wide, _ = picture.shape
    image = bpy.data.images.new("Filmstrip", wide, tall)
    rgba = np.ones((tall, wide, 4), dtype=np.float32)
    rgba[:, :, :3] = picture
    image.pixels.foreach_set(rgba.ravel())
    image.filepath_raw, image.file_format = output, "PNG"
    image.save()
    bpy.data.images.remove(image)
    return output
