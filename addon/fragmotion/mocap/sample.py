# SPDX-License-Identifier: GPL-3.0-or-later
"""The sample character, which comes with the add-on."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import NamedTuple

import bpy
import numpy as np
from mathutils import Vector

from ..errors import UserError

SAMPLE = Path(__file__).parents[1] / "sample_character.blend"
"""The file of `sample_rigs`, as `dev.py package` puts it into the zips."""

_WITHOUT_BODY = {"CAMERA", "EMPTY", "LIGHT", "LIGHT_PROBE", "SPEAKER", "FORCE_FIELD"}
_APART = 1.5  # m between the character and what is there: room to set off in any direction
_FLAT = 0.05  # m: what is no higher is stood upon
_NAME = "Fragmotion Sample"  # the objects of the character; the others are its stage
_GROUNDS = "Sample Grounds"  # the collection of what it may go on


class Extent(NamedTuple):
    """The least and the greatest corner of a box, m."""

    low: Vector
    high: Vector


def add_sample(context: bpy.types.Context) -> bpy.types.Object:
    """Append the sample's armature, mesh and Actions, ticked but for those of styles and moves, and a slope and stairs
    in a collection that is excluded from the view layers; the armature is active and alone selected. It stands beside
    what is there."""
    if not SAMPLE.exists():
        raise UserError(f"'{SAMPLE}' is missing: install the add-on again")
    if context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    with bpy.data.libraries.load(str(SAMPLE)) as (inside, wanted):
        wanted.objects = [name for name in inside.objects if name.startswith(_NAME)]
        wanted.actions = inside.actions
        wanted.collections = [] if _grounds_of(context) else [_GROUNDS]
    others = [obj for obj in context.visible_objects if obj.type not in _WITHOUT_BODY]
    for obj in wanted.objects:
        context.collection.objects.link(obj)
    armature: bpy.types.Object = next(obj for obj in wanted.objects if obj.type == "ARMATURE")
    for other in context.selected_objects:
        other.select_set(False)
    armature.select_set(True)
    context.view_layer.objects.active = armature
    for grounds in wanted.collections:
        context.scene.collection.children.link(grounds)
        for layer in context.scene.view_layers:
            layer.layer_collection.children[grounds.name].exclude = True
    context.view_layer.update()
    armature.location.x = free_beside(_extent(wanted.objects), [_extent([other]) for other in others])
    armature.fragmotion.ground.collection = _grounds_of(context)
    return armature


def free_beside(body: Extent, others: Sequence[Extent]) -> float:
    """How far a body at the origin is to go to the right, so that no other is in its way: what lies flat under it is
    not."""
    x = 0.0
    for other in sorted(others, key=lambda each: each.low.x):
        meets = (
            all(body.low[i] < other.high[i] and other.low[i] < body.high[i] for i in (1, 2))
            and other.high.z > _FLAT
            and body.low.x + x < other.high.x + _APART
            and other.low.x < body.high.x + x + _APART
        )
        if meets:
            x = other.high.x + _APART - body.low.x
    return x


def _extent(objects: Iterable[bpy.types.Object]) -> Extent:
    """The box around objects, in the world."""
    corners = np.array([obj.matrix_world @ Vector(corner) for obj in objects for corner in obj.bound_box])
    return Extent(Vector(corners.min(axis=0)), Vector(corners.max(axis=0)))


def _grounds_of(context: bpy.types.Context) -> bpy.types.Collection | None:
    """What was brought for the character before."""
    return next((each for each in context.scene.collection.children if each.name.startswith(_GROUNDS)), None)
