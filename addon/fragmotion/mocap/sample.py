# SPDX-License-Identifier: GPL-3.0-or-later
"""The sample character, which comes with the add-on."""

from __future__ import annotations

from pathlib import Path

import bpy

from ..errors import UserError

SAMPLE = Path(__file__).parents[1] / "sample_character.blend"
"""The file of `sample_rigs`, as `dev.py package` puts it into the zips."""

_NAME = "Fragmotion Sample"  # the objects of the character; the others are its stage
_GROUNDS = "Sample Grounds"  # the collection of what it may go on


def add_sample(context: bpy.types.Context) -> bpy.types.Object:
    """Append the sample's armature, mesh and Actions, ticked but for those of styles and moves, and a slope and stairs
    in a collection that is excluded from the view layers; the armature is active and alone selected."""
    if not SAMPLE.exists():
        raise UserError(f"'{SAMPLE}' is missing: install the add-on again")
    if context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    with bpy.data.libraries.load(str(SAMPLE)) as (inside, wanted):
        wanted.objects = [name for name in inside.objects if name.startswith(_NAME)]
        wanted.actions = inside.actions
        wanted.collections = [] if _grounds_of(context) else [_GROUNDS]
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
    armature.fragmotion.ground.collection = _grounds_of(context)
    return armature


def _grounds_of(context: bpy.types.Context) -> bpy.types.Collection | None:
    """What was brought for the character before."""
    return next((each for each in context.scene.collection.children if each.name.startswith(_GROUNDS)), None)
