# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's own icon."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy.utils.previews

_FILE = Path(__file__).resolve().parents[1] / "icon.png"

_loaded: Any = None


def register() -> None:
    """Load it."""
    global _loaded
    _loaded = bpy.utils.previews.new()
    _loaded.load("icon", str(_FILE), "IMAGE")


def unregister() -> None:
    """Free it."""
    global _loaded
    bpy.utils.previews.remove(_loaded)
    _loaded = None


def own_icon() -> int:
    """What a layout takes as its `icon_value`."""
    return int(_loaded["icon"].icon_id)
