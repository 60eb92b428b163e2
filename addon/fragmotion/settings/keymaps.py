# SPDX-License-Identifier: GPL-3.0-or-later
"""The shortcuts, which the user can change in the preferences."""

from __future__ import annotations

import bpy
import rna_keymap_ui

_KEYMAP = "3D View"
_SHORTCUTS: tuple[tuple[str, str, dict[str, str]], ...] = (
    ("fragmotion.drive", "D", {}),
    ("wm.call_menu_pie", "F", {"name": "FRAGMOTION_MT_pie"}),
)
"""Operators, their keys (with Shift and Ctrl) and what they are told."""
_items: list[tuple[bpy.types.KeyMap, bpy.types.KeyMapItem]] = []


def register() -> None:
    """Add the shortcuts, where there is a window."""
    configuration = bpy.context.window_manager.keyconfigs.addon
    if configuration is None:
        return
    keymap = configuration.keymaps.new(name=_KEYMAP, space_type="VIEW_3D")
    for operator, key, fields in _SHORTCUTS:
        item = keymap.keymap_items.new(operator, key, "PRESS", ctrl=True, shift=True)
        for name, value in fields.items():
            setattr(item.properties, name, value)
        _items.append((keymap, item))


def unregister() -> None:
    """Take them away again."""
    for keymap, item in _items:
        keymap.keymap_items.remove(item)
    _items.clear()


def draw_shortcuts(layout: bpy.types.UILayout, context: bpy.types.Context) -> None:
    """The shortcuts as the user has them now, to be changed."""
    configuration = context.window_manager.keyconfigs.user
    keymap = configuration.keymaps.get(_KEYMAP) if configuration else None
    if keymap is None:
        return
    layout.label(text="Shortcuts in the 3D viewport:")
    for item in keymap.keymap_items:
        if any(item.idname == operator and _tells(item, fields) for operator, _, fields in _SHORTCUTS):
            rna_keymap_ui.draw_kmi([], configuration, keymap, item, layout, 0)


def _tells(item: bpy.types.KeyMapItem, fields: dict[str, str]) -> bool:
    return all(getattr(item.properties, name) == value for name, value in fields.items())
