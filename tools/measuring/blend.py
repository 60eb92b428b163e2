# SPDX-License-Identifier: MIT
"""Takes from a .blend: the Actions of its armature, sampled by the add-on itself. Needs Blender's module bpy."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import fragmotion_core as core
from fragmotion_command.evaluate import loading
from fragmotion_command.evaluate.loading import Recordings

from tools.paths import ADDON
from tools.shell import Failure, say

Styles = list[tuple[str, list[core.Clip]]]


def read_recordings(paths: Sequence[Path], unit: float) -> Recordings:
    """All takes on the first one's skeleton, or those of a .blend; Failure where one has other bones."""
    blends = [path for path in paths if path.suffix.lower() == ".blend"]
    if not blends:
        return loading.read_recordings(paths, unit)
    if len(paths) > 1:
        raise Failure(f"{blends[0]}: a .blend has its own rig, and cannot be mixed with other motion capture")
    return Recordings(*read_actions(blends[0]))


def read_actions(path: Path) -> tuple[core.Skeleton, list[core.Clip]]:
    """The skeleton of the armature that most Actions fit, and those of its first style as clips; those of a single pose
    are left out."""
    skeleton, styles = _read(path)
    return skeleton, styles[0][1]


def read_styles(path: Path) -> Styles:
    """The clips of all styles; none where there is one alone."""
    _, styles = _read(path)
    return styles if len(styles) > 1 else []


def read_moves(path: Path) -> list[core.Move]:
    """The moves that the add-on's list holds, of which none need be in a character."""
    bpy = open_blend(path)
    rigs, moves, errors = (addon(name) for name in ("rig.rigs", "character.moves", "errors"))
    obj = _armature(bpy, path)
    try:
        rig = rigs.make_rig(obj)
        hands = rig.skeleton.relaxed_pose()
        return [moves.make_move(bpy.context, obj, rig, row, hands) for row in _listed(obj)]
    except errors.UserError as error:
        raise Failure(f"{path}: {error}") from error


def _read(path: Path) -> tuple[core.Skeleton, Styles]:
    bpy = open_blend(path)
    actions, rigs, sampling, styles, errors = (
        addon(name) for name in ("mocap.actions", "rig.rigs", "mocap.sampling", "mocap.styles", "errors")
    )
    obj = _armature(bpy, path)
    of_moves = {row.action for row in _listed(obj)}
    clips: list[tuple[str, core.Clip]] = []
    try:
        rig = rigs.make_rig(obj)
        for action in [action for action in actions.fitting(obj) if action not in of_moves]:
            try:
                clips.append((_style_of(action), sampling.sample(bpy.context, obj, action, rig)))
            except errors.SinglePose:
                say(f"left out, as it holds a single pose: Action '{action.name}'")
    except errors.UserError as error:
        raise Failure(f"{path}: {error}") from error
    if not clips:
        raise Failure(f"{path}: every Action of armature '{obj.name}' holds a single pose")
    return rig.skeleton, styles.grouped(clips)


def _armature(bpy: Any, path: Path) -> Any:
    """The one that most Actions fit."""
    fitting = addon("mocap.actions").fitting
    armatures: list[Any] = [thing for thing in bpy.context.scene.objects if thing.type == "ARMATURE"]
    fits = [(len(fitting(armature)), armature) for armature in armatures]
    count, obj = max(fits, key=lambda fit: fit[0], default=(0, None))
    if obj is None or count == 0:
        raise Failure(f"{path}: no armature with Actions in this file")
    return obj


def _listed(obj: Any) -> list[SimpleNamespace]:
    """The rows of the list of moves, as the add-on keeps them, which need not be switched on."""
    usual = {"whole": True, "upper_body": False, "wait": 0.5, "loop": False, "loop_first": 1, "loop_last": 1}
    rows = obj.get("fragmotion", {}).get("moves", ())
    return [SimpleNamespace(**{**usual, "first": 1, "last": 1, **row.to_dict()}) for row in rows]


def _style_of(action: Any) -> str:
    """As the add-on keeps it, which need not be switched on."""
    return str(action.get("fragmotion", {}).get("style", "")).strip()


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
