# SPDX-License-Identifier: GPL-3.0-or-later
"""What belongs to a character."""

from __future__ import annotations

import bpy


def belongings(obj: bpy.types.Object) -> list[bpy.types.Object]:
    """What the armature carries, and what it deforms without carrying it."""
    carried = list(obj.children_recursive)
    deformed = [
        other
        for other in bpy.context.scene.objects
        if any(modifier.type == "ARMATURE" and modifier.object == obj for modifier in other.modifiers)
    ]
    return list(dict.fromkeys((*carried, *deformed)))
