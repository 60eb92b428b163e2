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

_NAMES: dict[str, str] = {identifier: name for identifier, name, _, _ in KEYS}
_ICONS = set(bpy.types.UILayout.bl_rna.functions["prop"].parameters["icon"].enum_items.keys())
_OTHER_ICONS = {
    "SPACE": "EVENT_SPACEKEY",
    "RET": "EVENT_RETURN",
    "LEFTMOUSE": "MOUSE_LMB",
    "RIGHTMOUSE": "MOUSE_RMB",
    **{f"{side}_{key}": f"EVENT_{key}" for side in ("LEFT", "RIGHT") for key in ("SHIFT", "CTRL", "ALT")},
}


_WIDE = {  # since 4.3: by how much of a button's height an icon of more than a letter reaches over its place
    **dict.fromkeys(("ESC", "DEL", "HOME", "END", "BACKSPACE", "PAUSE", "INSERT", "APP", "CTRL", "ALT", "OS"), 1.5),
    **{f"F{number}": 1.5 for number in range(10, 25)},
    **{f"PAD{end}": 1.5 for end in (*"0123456789", "ASTERIX", "SLASH", "MINUS", "ENTER", "PLUS", "PERIOD")},
    "SPACEKEY": 3.0,
}


def icon_of(key: str) -> str:
    """Blender's icon of a key or a mouse button; empty where it has none."""
    icon = _OTHER_ICONS.get(key, f"EVENT_{key}")
    return icon if icon in _ICONS else ""


def room_beside(icon: str) -> float:
    """How much room such an icon takes beside its place: a separator's factor."""
    return _WIDE.get(icon.removeprefix("EVENT_"), 0.0) if bpy.app.version >= (4, 3, 0) else 0.0


def name_of(key: str) -> str:
    """A key in words; what is none as it is."""
    return _NAMES.get(key, key)
