# SPDX-License-Identifier: GPL-3.0-or-later
"""The shortcut of Drive, which the user can change in the preferences."""

from __future__ import annotations

import bpy
import rna_keymap_ui

_KEYMAP = "3D View"
_OPERATOR = "fragmotion.drive"
_items: list[tuple[bpy.types.KeyMap, bpy.types.KeyMapItem]] = []


def register() -> None:
    """Add the shortcut, where there is a window."""
    configuration = bpy.context.window_manager.keyconfigs.addon
    if configuration is None:
        return
    keymap = configuration.keymaps.new(name=_KEYMAP, space_type="VIEW_3D")
    _items.append((keymap, keymap.keymap_items.new(_OPERATOR, "D", "PRESS", ctrl=True, shift=True)))


def unregister() -> None:
    """Take it away again."""
    for keymap, item in _items:
        keymap.keymap_items.remove(item)
    _items.clear()


def draw_shortcut(layout: bpy.types.UILayout, context: bpy.types.Context) -> None:
    """The shortcut as the user has it now, to be changed."""
    configuration = context.window_manager.keyconfigs.user
    keymap = configuration.keymaps.get(_KEYMAP) if configuration else None
    item = keymap.keymap_items.find_from_operator(_OPERATOR) if keymap else None
    if item is not None:
        layout.label(text="Shortcut in the 3D viewport:")
        rna_keymap_ui.draw_kmi([], configuration, keymap, item, layout, 0)
