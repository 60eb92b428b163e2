# SPDX-License-Identifier: GPL-3.0-or-later
"""Rigs in files, onto which takes are brought, and a minute of a character on one."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ..compat.core import core
from ..compat.versions import assign
from ..errors import UserError
from ..rig.rigs import carriers, make_rig
from ..rig.writing import write_poses
from . import by_blender

if TYPE_CHECKING:
    from fragmotion_core import Character

ACTION = "Driven by a trace"
_PLAYER, _SECONDS = "explorer", 60.0
_TRACE_SEEDS = 2000  # how far the seed of the minute is from those of training and test


def open_rig(path: Path, armature: str | None) -> bpy.types.Object:
    """The armature of that name, or the file's only one; UserError says which there are."""
    if path.suffix.lower() == ".blend":
        bpy.ops.wm.open_mainfile(filepath=str(path.resolve()), use_scripts=False)
    else:
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
        by_blender.import_all(path)
    found = {obj.name: obj for obj in bpy.context.scene.objects if obj.type == "ARMATURE"}
    if not found:
        raise UserError(f"{path}: no armature in this file")
    if armature is None and len(found) > 1:
        raise UserError(f"{path}: several armatures: choose one with --armature: {', '.join(sorted(found))}")
    obj = found.get(armature or next(iter(found)))
    if obj is None:
        raise UserError(f"{path}: no armature '{armature}'; there is {', '.join(sorted(found))}")
    return obj


def save_minute(obj: bpy.types.Object, character: Character, seed: int, path: Path) -> None:
    """Bake a minute of a simulated player onto the armature, and save the file."""
    scene, rig = bpy.context.scene, make_rig(obj)
    trace = core.simulate_trace(_PLAYER, _SECONDS, seed + _TRACE_SEEDS, character.space)
    performance = core.Player(character, seed).run(trace, scene.render.fps / scene.render.fps_base)
    locations, rotations = rig.channels(performance.root_positions, performance.rotations)
    action = bpy.data.actions.new(ACTION)
    write_poses(action, obj, np.arange(1.0, len(locations) + 1), locations, rotations, carriers(obj, rig))
    assign(obj, action)
    scene.frame_start, scene.frame_end = 1, len(locations)
    path.parent.mkdir(parents=True, exist_ok=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(path.resolve()), compress=True)
