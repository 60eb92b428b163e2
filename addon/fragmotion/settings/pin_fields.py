# SPDX-License-Identifier: GPL-3.0-or-later
"""What a pin can be told."""

from __future__ import annotations

from bpy.props import FloatProperty


class PinFields:
    """How a recording is bent to a pin."""

    stretch: FloatProperty(  # type: ignore[valid-type]
        name="Change",
        description="How long before the pin the controls may change, in seconds",
        default=4.0,
        min=0.2,
        unit="TIME_ABSOLUTE",
    )
