# SPDX-License-Identifier: GPL-3.0-or-later
"""A character as two files for a game: its .policy, and its meshes with the armature as .glb."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import bpy

from ..character.building import save_policy
from ..compat import versions
from ..errors import UserError
from ..rig.rigs import sizes_of

POLICY, MESH = ".policy", ".glb"


def meshes_of(context: bpy.types.Context, obj: bpy.types.Object) -> list[bpy.types.Object]:
    """The meshes in sight that the armature moves."""
    return [thing for thing in context.visible_objects if thing.type == "MESH" and _is_moved_by(thing, obj)]


def export(context: bpy.types.Context, obj: bpy.types.Object, path: Path) -> tuple[Path, Path]:
    """Write both files beside each other under the path's name, or none; UserError says why none."""
    if not meshes_of(context, obj):
        raise UserError(
            f"No mesh in sight is moved by armature '{obj.name}': show its mesh, or parent one to it with weights"
        )
    targets = path.with_suffix(POLICY), path.with_suffix(MESH)
    try:
        with tempfile.TemporaryDirectory(dir=path.parent) as folder:
            sources = [Path(folder) / target.name for target in targets]
            save_policy(obj, sources[0])
            export_mesh(context, obj, sources[1])
            for source, target in zip(sources, targets):
                os.replace(source, target)
    except OSError as error:
        raise UserError(f"'{path.parent}' takes no files ({error.strerror}): choose another folder") from error
    return targets


def export_mesh(context: bpy.types.Context, obj: bpy.types.Object, path: Path) -> None:
    """Write the armature and its meshes at rest by Blender's own exporter; UserError where that fails."""
    _check_size(obj)
    options = {"use_selection": True, "export_animations": False, "export_format": "GLB"}
    versions.own_by_shown_scene()
    with _selected(context, [obj, *meshes_of(context, obj)]), _at_rest(obj):
        try:
            bpy.ops.export_scene.gltf(filepath=str(path), **options)
        except AttributeError as error:
            raise UserError("Blender's add-on 'glTF 2.0 format' is off: turn it on in the preferences") from error
        except RuntimeError as error:
            raise UserError(f"Blender's glTF exporter failed: {error}") from error


def _check_size(obj: bpy.types.Object) -> None:
    """UserError where the armature rests in another size than it is shown in."""
    for name, size in sizes_of(obj).items():
        raise UserError(
            f"Bone '{name}' of armature '{obj.name}' is scaled and shows the body {size:.3g} times as large as it "
            "rests, which a file for a game does not: retarget its Actions onto a copy that rests as large, and Build"
        )


def _is_moved_by(mesh: bpy.types.Object, obj: bpy.types.Object) -> bool:
    return any(modifier.type == "ARMATURE" and modifier.object == obj for modifier in mesh.modifiers)


@contextmanager
def _selected(context: bpy.types.Context, wanted: list[bpy.types.Object]) -> Iterator[None]:
    """These alone are selected for a while."""
    before = list(context.selected_objects)
    _select(context, wanted)
    try:
        yield
    finally:
        _select(context, before)


def _select(context: bpy.types.Context, wanted: list[bpy.types.Object]) -> None:
    for thing in context.view_layer.objects:
        thing.select_set(thing in wanted)


@contextmanager
def _at_rest(obj: bpy.types.Object) -> Iterator[None]:
    before = obj.data.pose_position
    obj.data.pose_position = "REST"
    try:
        yield
    finally:
        obj.data.pose_position = before
