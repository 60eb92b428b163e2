# SPDX-License-Identifier: GPL-3.0-or-later
"""The keys of Blender's events, to choose one of."""

from __future__ import annotations

import bpy

KEYS = tuple(
    (item.identifier, item.name, "", item.value)
    for item in bpy.types.Event.bl_rna.properties["type"].enum_items
    if item.identifier
)
"""Items of an EnumProperty."""
