# SPDX-License-Identifier: GPL-3.0-or-later
"""What Blender does not say of a data-block that Python holds."""

from __future__ import annotations

import bpy


def is_alive(data: bpy.types.ID) -> bool:
    """Whether a data-block is still in the file."""
    try:
        return bool(data.name)
    except ReferenceError:
        return False
