# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panels of the Fragmotion tab have in common."""

from __future__ import annotations

from typing import ClassVar

import bpy

from ..operators.context import active_armature


class Sidebar:
    """A panel of the tab in the 3D viewport's sidebar."""

    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Fragmotion"


class SubPanel(Sidebar):
    """A panel below another, closed at first, for an armature."""

    bl_options: ClassVar[set[str]] = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return active_armature(context) is not None
