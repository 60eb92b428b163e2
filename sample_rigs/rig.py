# SPDX-License-Identifier: MIT
"""The sample character in Blender: armature, skinned mesh and a small stage. Metres; the character faces -y."""

from __future__ import annotations

import math

import body
import bpy
import mannequin
import numpy as np
from mathutils import Vector
from stage import looking_at

NAME = "Fragmotion Sample"
# Viewport and render colour (linear RGB) and roughness, by material slot of mannequin.py.
_MATERIALS = (
    ("Sample Shell", (0.72, 0.70, 0.66), 0.45),
    ("Sample Joint", (0.035, 0.038, 0.045), 0.5),
    ("Sample Left", (0.02, 0.30, 0.42), 0.4),
    ("Sample Right", (0.80, 0.20, 0.03), 0.4),
)


def clear_file() -> None:
    """Remove all objects and their data from the open file."""
    for data in (bpy.data.objects, bpy.data.meshes, bpy.data.materials, bpy.data.cameras, bpy.data.lights,
                 bpy.data.armatures, bpy.data.actions):  # fmt: skip
        for block in list(data):
            data.remove(block)


def make_armature() -> bpy.types.Object:
    """The armature object with the bones of body.py, quaternion rotations, no constraints."""
    data = bpy.data.armatures.new(NAME)
    data.display_type = "STICK"
    armature = bpy.data.objects.new(NAME, data)
    armature.show_in_front = True
    bpy.context.scene.collection.objects.link(armature)
    bpy.context.view_layer.objects.active = armature
    bpy.ops.object.mode_set(mode="EDIT")
    for bone in body.BONES:
        _add_bone(data, bone)
    bpy.ops.object.mode_set(mode="OBJECT")
    data.bones["root"].use_deform = False
    for pose_bone in armature.pose.bones:
        pose_bone.rotation_mode = "QUATERNION"
    return armature


def _add_bone(data: bpy.types.Armature, bone: body.Bone) -> None:
    edit = data.edit_bones.new(bone.name)
    edit.head, edit.tail = bone.head, bone.tail
    edit.align_roll(Vector(bone.roll_towards))
    if bone.parent:
        edit.parent = data.edit_bones[bone.parent]
        edit.use_connect = bone.connected


def make_mesh(armature: bpy.types.Object) -> bpy.types.Object:
    """The mannequin as one mesh object, skinned to the armature."""
    parts = mannequin.parts()
    starts = np.cumsum([0] + [len(part.vertices) for part in parts])
    vertices = np.concatenate([part.vertices for part in parts])
    faces = [[start + k for k in face] for start, part in zip(starts, parts) for face in part.faces]
    mesh = bpy.data.meshes.new(NAME + " Body")
    mesh.from_pydata(vertices.tolist(), [], faces)
    for name, colour, roughness in _MATERIALS:
        mesh.materials.append(_material(name, colour, roughness))
    slots = np.concatenate([np.full(len(part.faces), part.material) for part in parts])
    mesh.polygons.foreach_set("material_index", slots.astype(np.int32))
    mesh.polygons.foreach_set("use_smooth", np.ones(len(faces), dtype=bool))
    character = bpy.data.objects.new(NAME + " Body", mesh)
    bpy.context.scene.collection.objects.link(character)
    _skin(character, armature, parts, starts)
    return character


def _skin(character: bpy.types.Object, armature: bpy.types.Object, parts: list, starts: np.ndarray) -> None:
    """Vertex groups, parent and armature modifier."""
    groups = {bone.name: character.vertex_groups.new(name=bone.name) for bone in body.BONES if bone.name != "root"}
    for start, part in zip(starts, parts):
        for name, weights in part.weights.items():
            _add_weights(groups[name], int(start), weights)
    character.parent = armature
    modifier = character.modifiers.new("Armature", "ARMATURE")
    modifier.object = armature


def _add_weights(group: bpy.types.VertexGroup, start: int, weights: np.ndarray) -> None:
    """Equal weights in one call, so that rigid parts are quick."""
    for value in np.unique(np.round(weights, 4)):
        if value > 0:
            chosen = np.flatnonzero(np.round(weights, 4) == value) + start
            group.add(chosen.tolist(), float(value), "REPLACE")


def _material(name: str, colour: tuple[float, float, float], roughness: float) -> bpy.types.Material:
    material = bpy.data.materials.new(name)
    material.diffuse_color = (*colour, 1.0)
    material.roughness = roughness
    material.use_nodes = True
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*colour, 1.0)
    shader.inputs["Roughness"].default_value = roughness
    return material


def make_stage() -> None:
    """Ground with a half-metre checker, sun, sky and a camera that frames the character."""
    scene = bpy.context.scene
    side = 40.0
    mesh = bpy.data.meshes.new("Ground")
    mesh.from_pydata([(x * side, y * side, 0) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))], [], [(0, 1, 2, 3)])
    mesh.materials.append(_checker())
    ground = bpy.data.objects.new("Ground", mesh)
    ground.hide_select = True
    sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
    sun.data.energy, sun.data.angle = 3.0, math.radians(6)
    sun.rotation_euler = (math.radians(42), math.radians(8), math.radians(28))
    sun.location = (2, -3, 5)
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    camera.matrix_world = looking_at(Vector((2.3, -4.6, 1.7)), Vector((0, 0, 0.92)))
    camera.data.lens = 50
    for thing in (ground, sun, camera):
        scene.collection.objects.link(thing)
    scene.camera = camera
    world = scene.world or bpy.data.worlds.new("World")
    scene.world = world
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.42, 0.50, 0.60, 1)


def make_grounds() -> bpy.types.Collection:
    """A slope of 20 degrees and stairs of 18 cm, 8 m before the character, and the level ground."""
    collection = bpy.data.collections.new("Sample Grounds")
    bpy.context.scene.collection.children.link(collection)
    collection.objects.link(bpy.data.objects["Ground"])
    rise, tread, steps = 0.18, 0.3, 8
    corners = [(step * tread, height * rise) for step in range(steps) for height in (step, step + 1)]
    stairs = [*corners, (steps * tread + 3, steps * rise)]
    slope = [(0.0, 0.0), (5.0, 5 * math.tan(math.radians(20))), (8.0, 5 * math.tan(math.radians(20)))]
    for name, profile, aside in (("Sample Slope", slope, 3.0), ("Sample Stairs", stairs, -3.0)):
        collection.objects.link(_extruded(name, profile, aside))
    return collection


def _extruded(name: str, profile: list[tuple[float, float]], aside: float) -> bpy.types.Object:
    """A profile of way and height, m, 4 m wide, that begins 8 m before the character and so much to its left."""
    points = [(aside + side, -8 - way, height) for way, height in profile for side in (-2.0, 2.0)]
    faces = [(2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1) for i in range(len(profile) - 1)]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, [], faces)
    mesh.materials.append(bpy.data.materials["Sample Ground"])
    return bpy.data.objects.new(name, mesh)


def _checker() -> bpy.types.Material:
    """Two greys in squares of half a metre, in world coordinates."""
    material = _material("Sample Ground", (0.22, 0.23, 0.24), 0.9)
    nodes, links = material.node_tree.nodes, material.node_tree.links
    checker, place = nodes.new("ShaderNodeTexChecker"), nodes.new("ShaderNodeNewGeometry")
    checker.inputs["Scale"].default_value = 2.0
    checker.inputs["Color1"].default_value = (0.24, 0.25, 0.26, 1)
    checker.inputs["Color2"].default_value = (0.18, 0.19, 0.20, 1)
    links.new(place.outputs["Position"], checker.inputs["Vector"])
    links.new(checker.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
    return material


def frame_viewports() -> None:
    """Let every 3D view of the saved file show the character from the front, three-quarter, with the sidebar open."""
    view = looking_at(Vector((1.6, -4.0, 1.9)), Vector((0, 0, 0.9))).to_quaternion()
    for screen in bpy.data.screens:
        for area in screen.areas:
            for space in area.spaces:
                if space.type == "VIEW_3D":
                    space.region_3d.view_location = (0, 0, 0.9)
                    space.region_3d.view_distance = 5.0
                    space.region_3d.view_rotation = view
                    space.region_3d.view_perspective = "PERSP"
                    space.shading.color_type = "MATERIAL"
                    space.overlay.show_extras = False  # camera and sun
                    space.show_region_ui = True
