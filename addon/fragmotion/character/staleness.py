# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether the Actions that an armature's character was built from have changed since, or others are ticked."""

from __future__ import annotations

import hashlib
import time

import bpy
import numpy as np
from bpy.app.handlers import persistent

from ..compat import versions
from ..compat.core import core
from ..mocap.actions import RATE, SCENE_RATE, ticked
from ..mocap.curve_points import points_of
from ..mocap.markers import marks_of
from ..mocap.styles import style_of
from ..rig.rigs import held_of, roles_in_bones, sizes_of
from ..rig.writing import LINEAR

_PATIENCE = 0.03  # s that one look may take; what is not read by then waits for the next look
_digests: dict[tuple[object, ...], str] = {}


def sources_of(obj: bpy.types.Object) -> str:
    """A digest of all that Build reads of the ticked Actions, whose names do not count, of *Bones*, and of what is held
    as it was posed when that was read last: to draw is no time to look which bones are keyed."""
    return _joined([*(_told_by(action) for action in ticked(obj)), *_told_by_bones(obj)])


def is_stale(obj: bpy.types.Object) -> bool:
    """Whether Build would read something else now than for the armature's character; quick enough for drawing.

    After loading a file with many Actions it takes a few looks to find out; until then they count as unchanged.
    """
    built = obj.fragmotion.figures.sources
    if not built:
        return False
    actions, until = ticked(obj), time.perf_counter() + _PATIENCE
    digests = []
    for action in actions:
        digests.append(_told_by(action))
        if time.perf_counter() > until and any(_key(other) not in _digests for other in actions):
            return False
    return bool(_joined([*digests, *_told_by_bones(obj)]) != built)


def _told_by_bones(obj: bpy.types.Object) -> list[str]:
    roles = [f"{role} {bone}" for role, bone in sorted(roles_in_bones(obj).items()) if role in core.ROLES]
    return roles + [f"{bone} {row}" for bone, row in (*held_of(obj).items(), *sizes_of(obj).items())]


def register() -> None:
    """Begin to notice which Actions change."""
    bpy.app.handlers.depsgraph_update_post.append(_notice)
    for handlers in _forgetful():
        handlers.append(_forget)


def unregister() -> None:
    """Stop noticing."""
    bpy.app.handlers.depsgraph_update_post.remove(_notice)
    for handlers in _forgetful():
        handlers.remove(_forget)
    _digests.clear()


def _forgetful() -> tuple[list[object], ...]:
    """What happens to a file after which any Action may be another."""
    return bpy.app.handlers.load_post, bpy.app.handlers.undo_post, bpy.app.handlers.redo_post


@persistent  # type: ignore[untyped-decorator]
def _notice(_scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    changed = {update.id.name for update in depsgraph.updates if isinstance(update.id, bpy.types.Action)}
    if changed:
        for key in [key for key in _digests if key[0] in changed]:
            del _digests[key]


@persistent  # type: ignore[untyped-decorator]
def _forget(*_: object) -> None:
    _digests.clear()


def _key(action: bpy.types.Action) -> tuple[object, ...]:
    """What tells, without reading the keys, that an Action may be another, also where no change of it was noticed."""
    shape = versions.count_curves(action), tuple(action.frame_range)
    return action.name, action.library, *shape, *marks_of(action)


def digest_of(action: bpy.types.Action) -> str:
    """A digest of all that is read of an Action; its name does not count."""
    key = _key(action)
    if key not in _digests:
        _digests[key] = _read(action)
    return _digests[key]


def _told_by(action: bpy.types.Action) -> str:
    """A digest of all that Build reads of an Action."""
    return f"{digest_of(action)}{style_of(action)}{action.fragmotion.speed or ''}"


def _read(action: bpy.types.Action) -> str:
    digest = hashlib.sha256()
    kept = (action.get(RATE), action.get(SCENE_RATE), action.use_frame_range, *action.frame_range)
    digest.update(repr((*kept, *marks_of(action))).encode())
    for curve in versions.all_curves(action):
        named = (curve.data_path, curve.array_index, versions.is_muted(curve), curve.extrapolation)
        digest.update(repr((*named, [modifier.type for modifier in curve.modifiers])).encode())
        digest.update(_keys(curve))
    return digest.hexdigest()


def _keys(curve: bpy.types.FCurve) -> bytes:
    """The curve's keys, with their handles where these shape it."""
    keys = curve.keyframe_points
    kinds = np.empty(len(keys), np.int32)
    keys.foreach_get("interpolation", kinds)
    told = points_of(curve).tobytes()
    if not (kinds == LINEAR).all():
        handles = np.empty((2, 2 * len(keys)), np.float32)
        keys.foreach_get("handle_left", handles[0])
        keys.foreach_get("handle_right", handles[1])
        told += handles.tobytes()
    return told + kinds.tobytes()


def _joined(digests: list[str]) -> str:
    return hashlib.sha256(" ".join(sorted(digests)).encode()).hexdigest()
