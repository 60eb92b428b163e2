# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a character looks."""

from __future__ import annotations

import bpy
from bpy.props import EnumProperty, PointerProperty

_LOOKS = (
    ("CAPTURED", "As Captured", "Head and chest do what the takes have"),
    ("AHEAD", "Where It Goes", "Head and chest turn to where it goes, and into a turn before the body"),
    ("OBJECT", "Object", "Head and chest turn to an object, also while that moves"),
)


class LookSettings(bpy.types.PropertyGroup):
    """Where the character looks when it is driven, and baked without a recording, which has looks of its own."""

    kind: EnumProperty(  # type: ignore[valid-type]
        name="Look At",
        description="Where head and chest look: as far as they turn in the takes or easily, and about as fast",
        items=_LOOKS,
    )
    object: PointerProperty(  # type: ignore[valid-type]
        name="Object", description="What it looks at: the object's origin", type=bpy.types.Object
    )
