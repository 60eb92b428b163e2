# SPDX-License-Identifier: GPL-3.0-or-later
"""What the settings of an armature's hands say, now and from frame to frame of the scene."""

from __future__ import annotations

import math
from typing import Any

import bpy
from mathutils import Matrix, Vector

from ..mocap.sampling import scene_rate
from ..rig.posing import visit
from .reaches import EMPTY, Hold, Holds, ReachChange, reaches_from
from .recordings import TRACE_RATE

_HANDS = ("left_hand", "right_hand")  # the settings of each, as the core numbers them


def holds_of(obj: bpy.types.Object) -> Holds:
    """What the settings of the armature's hands say now."""
    left, right = (_hold_of(obj, getattr(obj.fragmotion, hand)) for hand in _HANDS)
    return left, right


def reaches_now(context: bpy.types.Context, obj: bpy.types.Object, settings: Any) -> list[ReachChange]:
    """What the panel says that hands hold in a bake as BakeFields say, as one sees it who is to be moved elsewhere as
    the settings of a crowd say; from frame to frame of the scene, to its end, where that may change."""
    scene, first = context.scene, settings.frame_start
    controls = math.ceil((scene.frame_end - first) * TRACE_RATE / scene_rate(scene))
    return reaches_from((), 0, holds_over_time(context, obj, first, controls, getattr(settings, "moved", None)))


def holds_over_time(
    context: bpy.types.Context, obj: bpy.types.Object, first: float, controls: int, moved: Matrix | None = None
) -> list[Holds]:
    """What hands hold before each of so many controls of what begins at scene frame `first`, a control ahead, so that
    they are there in time; before the first one alone where it does not change, and nothing where that is nothing."""
    scene, apart = context.scene, scene_rate(context.scene) / TRACE_RATE
    if controls > 1 and _may_change(obj):
        found = [holds_of(obj) for _ in visit(scene, (first + (number + 1) * apart for number in range(controls)))]
    else:
        found = [holds_of(obj)]
    if moved is not None:
        found = [_seen_from(holds, moved) for holds in found]
    return [] if all(holds == EMPTY for holds in found) else found


def _may_change(obj: bpy.types.Object) -> bool:
    """Whether what the hands hold may be another at another frame."""
    held = [getattr(obj.fragmotion, hand).object for hand in _HANDS]
    return any(
        each is not None and (each.animation_data or each.parent or len(each.constraints) or each.rigid_body)
        for each in held
    )


def _seen_from(holds: Holds, moved: Matrix) -> Holds:
    """The same as one sees it who is to be moved elsewhere."""
    back = moved.inverted()
    left, right = (hold if hold.carried else Hold(hold.weight, 0, *(back @ Vector(hold[2:]))) for hold in holds)
    return left, right


def _hold_of(obj: bpy.types.Object, settings: Any) -> Hold:
    held = settings.object
    if held is None:
        return Hold()
    place = held.matrix_world.translation
    if settings.carried:
        origin, turned = obj.matrix_world.translation, obj.matrix_world.to_euler().z
        seen = Matrix.Rotation(-turned - math.pi, 4, "Z") @ (place - origin)
        return Hold(held.fragmotion.held, 1, *seen)
    return Hold(held.fragmotion.held, 0, *place)
