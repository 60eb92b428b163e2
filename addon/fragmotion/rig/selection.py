# SPDX-License-Identifier: GPL-3.0-or-later
"""Which objects and bones are selected."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import bpy

from ..compat import versions


def select(context: bpy.types.Context, objects: Iterable[bpy.types.Object], active: bpy.types.Object | None) -> None:
    """Select these alone, and make one active, or none."""
    for other in context.selected_objects:
        other.select_set(False)
    for obj in objects:
        obj.select_set(True)
    context.view_layer.objects.active = active


def highlight(obj: bpy.types.Object, bones: Sequence[str]) -> None:
    """Select these bones of an armature alone, the first of them active: as Pose Mode shows them."""
    names = obj.data.bones.keys()
    versions.set_bone_selection(obj, {name: (name in bones,) * 3 for name in names})
    obj.data.bones.active = obj.data.bones[bones[0]]
