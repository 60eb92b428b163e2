# SPDX-License-Identifier: GPL-3.0-or-later
"""Which objects are selected."""

from __future__ import annotations

from collections.abc import Iterable

import bpy


def select(context: bpy.types.Context, objects: Iterable[bpy.types.Object], active: bpy.types.Object | None) -> None:
    """Select these alone, and make one active, or none."""
    for other in context.selected_objects:
        other.select_set(False)
    for obj in objects:
        obj.select_set(True)
    context.view_layer.objects.active = active
