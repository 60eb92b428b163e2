# SPDX-License-Identifier: GPL-3.0-or-later
"""What a pin can be told."""

from __future__ import annotations

from bpy.props import BoolProperty, FloatProperty


class PinFields:
    """How a recording is bent to a pin."""

    any_heading: BoolProperty(  # type: ignore[valid-type]
        name="Any Heading",
        description="Be at the place, whatever way the character faces; else it faces the cursor's or the object's -Y",
        default=True,
    )
    stretch: FloatProperty(  # type: ignore[valid-type]
        name="Change Over",
        description="How long before the pin the controls may change, in seconds",
        default=4.0,
        min=0.2,
        unit="TIME_ABSOLUTE",
    )
