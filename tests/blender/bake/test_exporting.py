# SPDX-License-Identifier: MIT
"""A baked Action leaves by Blender's own exporters, with the settings that the guide tells, and comes back the same."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import making
import numpy as np
import pytest
from baked import RATE, seen_at

FRAMES = np.arange(1, 122, 8)
TOLERANCE = 1e-4  # m
FBX = {
    "object_types": {"ARMATURE"},
    "add_leaf_bones": False,
    "bake_anim_use_nla_strips": False,
    "bake_anim_use_all_actions": False,
    "bake_anim_simplify_factor": 0,
}
"""What the guide says to choose."""

Operator = Callable[..., set[str]]


@pytest.fixture(params=["BONE", "OBJECT"])
def baked(request: pytest.FixtureRequest, obj: bpy.types.Object, recording: Any) -> bpy.types.Object:
    """The armature with a bake of four seconds in which its root bone or the object carries it."""
    assert bpy.ops.fragmotion.bake(frame_start=1, trace_source="RECORDING", root=request.param) == {"FINISHED"}
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = 1, int(FRAMES[-1])
    return obj


def come_back(importer: Operator, path: Path, **settings: Any) -> bpy.types.Object:
    """The armature that an importer makes of a file in an empty scene."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.context.scene.render.fps = RATE
    assert importer(filepath=str(path), **settings) == {"FINISHED"}
    return next(each for each in bpy.data.objects if each.type == "ARMATURE")


def fbx_importers() -> list[tuple[str, str]]:
    """Blender's own: one in Python, and from 4.5 on one in C++."""
    return [("import_scene", "fbx"), ("wm", "fbx_import")][: 2 if bpy.app.version >= (4, 5, 0) else 1]


def test_by_gltf(baked: bpy.types.Object, tmp_path: Path) -> None:
    names = baked.pose.bones.keys()
    heads, _ = seen_at(baked, FRAMES, names)
    making.activate(baked)  # alone: 3.4.1's importer fails at meshes with the NumPy of today
    making.export_gltf(tmp_path / "walk.glb", use_selection=True)
    back = come_back(bpy.ops.import_scene.gltf, tmp_path / "walk.glb")
    np.testing.assert_allclose(seen_at(back, FRAMES, names)[0], heads, atol=TOLERANCE)


@pytest.mark.parametrize("importer", fbx_importers(), ids=lambda names: ".".join(names))
@pytest.mark.parametrize("scale", ["FBX_SCALE_NONE", "FBX_SCALE_UNITS"])
def test_by_fbx(baked: bpy.types.Object, tmp_path: Path, importer: tuple[str, str], scale: str) -> None:
    names = baked.pose.bones.keys()
    heads, _ = seen_at(baked, FRAMES, names)
    path = tmp_path / "walk.fbx"
    assert bpy.ops.export_scene.fbx(filepath=str(path), apply_scale_options=scale, **FBX) == {"FINISHED"}
    folder, name = importer
    back = come_back(getattr(getattr(bpy.ops, folder), name), path, anim_offset=0)
    np.testing.assert_allclose(seen_at(back, FRAMES, names)[0], heads, atol=TOLERANCE)
    np.testing.assert_allclose(back.scale, 1, atol=1e-6)


@pytest.mark.skipif(bpy.app.version < (3, 5, 0), reason="this Blender's BVH importer fails on Python 3.11")
def test_by_bvh(obj: bpy.types.Object, recording: Any, tmp_path: Path) -> None:
    """Of the armature's own space: a BVH file has no object, and Blender's has z up."""
    assert bpy.ops.fragmotion.bake(frame_start=1, trace_source="RECORDING", root="BONE") == {"FINISHED"}
    names = obj.pose.bones.keys()
    heads, back_home = seen_at(obj, FRAMES, names)[0], np.linalg.inv(np.array(obj.matrix_world))
    heads = heads @ back_home[:3, :3].T + back_home[:3, 3]
    path = tmp_path / "walk.bvh"
    assert bpy.ops.export_anim.bvh(filepath=str(path), frame_start=1, frame_end=int(FRAMES[-1])) == {"FINISHED"}
    back = come_back(bpy.ops.import_anim.bvh, path, axis_forward="Y", axis_up="Z")
    np.testing.assert_allclose(seen_at(back, FRAMES, names)[0], heads, atol=TOLERANCE)
