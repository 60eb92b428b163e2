# SPDX-License-Identifier: MIT
"""Rigs in the files that Blender reads, and a minute of a character on one. Needs Blender's module bpy."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

import fragmotion_core as core
import numpy as np

from tools.measuring.evaluate.blend import addon, open_blend
from tools.measuring.evaluate.loading import SECONDS, TEACHER
from tools.shell import Failure

ACTION = "Driven by a trace"
_TRACE_SEEDS = 2000  # how far the seed of the minute is from those of training and test


class OpenRig(NamedTuple):
    """An armature in the file that is open, and as the core has it."""

    obj: Any
    rig: core.Rig

    @property
    def skeleton(self) -> core.Skeleton:
        """In metres of the world."""
        return self.rig.skeleton


def open_rig(path: Path, armature: str | None) -> OpenRig:
    """The armature of that name, or the file's only one; Failure says which there are."""
    bpy = open_blend(path) if path.suffix.lower() == ".blend" else _import(path)
    found = {thing.name: thing for thing in bpy.context.scene.objects if thing.type == "ARMATURE"}
    if not found:
        raise Failure(f"{path}: no armature in this file")
    if armature is None and len(found) > 1:
        raise Failure(f"{path}: several armatures: choose one with --armature: {', '.join(sorted(found))}")
    obj = found.get(armature or next(iter(found)))
    if obj is None:
        raise Failure(f"{path}: no armature '{armature}'; there is {', '.join(sorted(found))}")
    try:
        return OpenRig(obj, addon("rig.rigs").make_rig(obj))
    except addon("errors").UserError as error:
        raise Failure(f"{path}: {error}") from error


def _import(path: Path) -> Any:
    """A file of a format that the add-on's importer reads, too."""
    bpy: Any = import_module("bpy")
    bpy.ops.wm.read_factory_settings(use_empty=True)
    try:
        addon("mocap.by_blender").import_all(path)
    except addon("errors").UserError as error:
        raise Failure(str(error)) from error
    return bpy


def save_minute(opened: OpenRig, character: core.Character, seed: int, path: Path) -> None:
    """Bake a minute of a simulated player onto the armature, and save the file."""
    bpy: Any = import_module("bpy")
    rate = bpy.context.scene.render.fps / bpy.context.scene.render.fps_base
    trace = core.simulate_trace(TEACHER, SECONDS, seed + _TRACE_SEEDS, character.space)
    performance = core.Player(character, seed).run(trace, rate)
    locations, rotations = opened.rig.channels(performance.root_positions, performance.rotations)
    action = bpy.data.actions.new(ACTION)
    times = np.arange(1.0, len(locations) + 1)
    try:
        carriers = addon("rig.rigs").carriers(opened.obj, opened.rig)
    except addon("errors").UserError as error:
        raise Failure(str(error)) from error
    addon("rig.writing").write_poses(action, opened.obj, times, locations, rotations, carriers)
    addon("compat.versions").assign(opened.obj, action)
    bpy.context.scene.frame_start, bpy.context.scene.frame_end = 1, len(locations)
    path.parent.mkdir(parents=True, exist_ok=True)
    bpy.ops.wm.save_as_mainfile(filepath=str(path.resolve()), compress=True)
