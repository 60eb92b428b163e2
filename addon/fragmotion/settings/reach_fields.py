# SPDX-License-Identifier: GPL-3.0-or-later
"""What a hand holds or reaches for."""

from __future__ import annotations

import bpy
from bpy.props import BoolProperty, PointerProperty


class ReachSettings(bpy.types.PropertyGroup):
    """What a hand reaches for when the character is driven, and baked without a recording, which has that of its own.
    How much it does is the object's own, where it can be keyed."""

    object: PointerProperty(  # type: ignore[valid-type]
        name="Object",
        description="What the hand holds or reaches for: its palm goes to the object's origin, as far as the arm is "
        "long and the object is not behind; from far away it reaches for nothing",
        type=bpy.types.Object,
    )
    carried: BoolProperty(  # type: ignore[valid-type]
        name="Carry",
        description="The hand stays where the object is seen from the armature's origin, and goes along with the "
        "character, as if it held a tray. Else it reaches for where the object is",
    )
