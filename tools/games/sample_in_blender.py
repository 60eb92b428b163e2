# SPDX-License-Identifier: MIT
"""Run inside Blender by tools/games/sample.py: the sample character with its moves and styles, as a game gets it.

Arguments after `--`: the add-on's zip, and the folder that gets sample.policy and sample.glb.
"""

from __future__ import annotations

import sys
from importlib import import_module
from pathlib import Path
from typing import Any

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "blender"))
making: Any = import_module("making")


def expect(result: set[str], step: str) -> None:
    """Stop when an operator did not finish; it has said why."""
    if result != {"FINISHED"}:
        raise SystemExit(f"{step} ended as {result}")


def export_mesh(armature: Any, path: Path) -> None:
    """The armature and its meshes at rest, as Blender's own exporter writes them."""
    armature.data.pose_position = "REST"
    for thing in bpy.context.scene.objects:
        thing.select_set(thing is armature or thing.parent is armature)
    options = {"use_selection": True, "export_animations": False}
    expect(bpy.ops.export_scene.gltf(filepath=str(path), export_format="GLB", **options), "Export glTF")


def main(package: str, folder: str) -> None:
    """Add the sample, build it, save both files."""
    module = making.install(package)
    bpy.ops.wm.read_homefile(use_empty=True)
    bpy.context.scene.render.fps = 30
    expect(bpy.ops.fragmotion.add_sample(), "Add Sample Character")
    armature = bpy.context.active_object
    expect(bpy.ops.fragmotion.tick_actions(use=True), "Tick Actions")
    expect(bpy.ops.fragmotion.build("EXEC_DEFAULT"), "Build")
    import_module(f"{module}.character.moves").bring_up_to_date(bpy.context, armature)
    expect(bpy.ops.fragmotion.save_policy(filepath=str(Path(folder) / "sample.policy")), "Save Policy")
    export_mesh(armature, Path(folder) / "sample.glb")


main(*sys.argv[sys.argv.index("--") + 1 :])
