# SPDX-License-Identifier: GPL-3.0-or-later
"""The pose of what no Action keys: Blender leaves it as it is posed, and so it is learned and shown."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

import bpy
import numpy as np

from ..compat import versions
from .rigs import HELD, PUT_ASIDE, bone_path, held_of, is_tied
from .scaled import keep_sizes

if TYPE_CHECKING:
    from fragmotion_core import Doubles

_POSED = 1e-3  # of a bone's own channels: what is less is at rest
_REST = (0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0)
_CHANNELS = {"location": slice(0, 3), "rotation": slice(3, 7)}  # of a row, as rigs.held_of tells it


def keep_held(obj: bpy.types.Object, actions: Iterable[bpy.types.Action]) -> None:
    """Keep with the armature how its bones are posed that none of these Actions keys, and no driver moves. What is
    keyed is as it was kept when it was not; its location and its rotation each. And how large they show the body."""
    if PUT_ASIDE in obj or obj.library is not None:
        return
    actions = list(actions)
    keep_sizes(obj, actions)
    kept, found = held_of(obj), {}
    posed = {bone.name: row for bone in obj.pose.bones if not np.allclose(row := _row(bone), _REST, atol=_POSED)}
    keyed = set(_keyed(obj, actions)) if posed or kept else set()
    for name in {**posed, **kept}:
        row = np.array(_REST)
        for channel, part in _CHANNELS.items():
            source = kept if (name, channel) in keyed else posed
            row[part] = np.array(source.get(name, _REST))[part]
        if not np.allclose(row, _REST, atol=_POSED):
            found[name] = row.tolist()
    if found:
        obj[HELD] = found
    elif kept:
        del obj[HELD]


def _row(bone: bpy.types.PoseBone) -> Doubles:
    location, rotation, _ = bone.matrix_basis.decompose()
    return np.array([*((0, 0, 0) if is_tied(bone.bone) else location), *rotation])


def _keyed(obj: bpy.types.Object, actions: Iterable[bpy.types.Action]) -> Iterator[tuple[str, str]]:
    """The bones and their channels."""
    paths = {curve.data_path for action in actions for curve in versions.curves_of(action, obj)}
    paths |= {driver.data_path for driver in (obj.animation_data.drivers if obj.animation_data else ())}
    beginnings = {path.rpartition(".")[0] + "." + path.rpartition(".")[2].partition("_")[0] for path in paths}
    for bone in obj.data.bones:
        yield from ((bone.name, each) for each in _CHANNELS if bone_path(bone.name, each) in beginnings)
