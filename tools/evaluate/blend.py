# SPDX-License-Identifier: MIT
"""Takes from a .blend: the Actions of its armature, sampled by the add-on itself. Needs Blender's module bpy."""

from __future__ import annotations

import sys
from importlib import import_module
from pathlib import Path
from typing import Any

import fragmotion_core as core

from tools.paths import ADDON
from tools.shell import Failure, say


def read_actions(path: Path) -> tuple[core.Skeleton, list[core.Clip]]:
    """The skeleton of the armature that most Actions fit, and these as clips; those of a single pose are left out."""
    bpy = open_blend(path)
    actions, rigs, sampling, errors = (
        addon(name) for name in ("mocap.actions", "rig.rigs", "mocap.sampling", "errors")
    )
    armatures: list[Any] = [thing for thing in bpy.context.scene.objects if thing.type == "ARMATURE"]
    fits = [(len(actions.fitting(armature)), armature) for armature in armatures]
    count, obj = max(fits, key=lambda fit: fit[0], default=(0, None))
    if obj is None or count == 0:
        raise Failure(f"{path}: no armature with Actions in this file")
    clips: list[core.Clip] = []
    try:
        rig = rigs.make_rig(obj)
        for action in actions.fitting(obj):
            try:
                clips.append(sampling.sample(bpy.context, obj, action, rig))
            except errors.SinglePose:
                say(f"left out, as it holds a single pose: Action '{action.name}'")
    except errors.UserError as error:
        raise Failure(f"{path}: {error}") from error
    if not clips:
        raise Failure(f"{path}: every Action of armature '{obj.name}' holds a single pose")
    return rig.skeleton, clips


def open_blend(path: Path) -> Any:
    """Blender's module with the file open; scripts in it do not run."""
    try:
        bpy: Any = import_module("bpy")
    except ImportError as error:
        raise Failure(f"{path}: reading a .blend needs Blender's Python module: pip install 'bpy==4.5.*'") from error
    try:
        bpy.ops.wm.open_mainfile(filepath=str(path.resolve()), use_scripts=False)
    except RuntimeError as error:
        raise Failure(f"{path}: Blender cannot open it: {' '.join(str(error).split())}") from error
    return bpy


def addon(name: str) -> Any:
    """A module of the add-on, which need not be installed."""
    if str(ADDON.parent) not in sys.path:
        sys.path.insert(0, str(ADDON.parent))
    return import_module(f"{ADDON.name}.{name}")
