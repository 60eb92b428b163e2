# SPDX-License-Identifier: GPL-3.0-or-later
"""The user's preferences: what the hands have got used to."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, StringProperty

from ..compat.core import ADDON
from ..compat.event_keys import KEYS
from ..input.keyboard import DEFAULT_KEYS
from . import keymaps

_LABELS = {name: name.replace("_", " ").title() for name in DEFAULT_KEYS} | {"previous_style": "Prev. Style"}
_TIPS = {
    "forward": "Away from you, or forward",
    "back": "Towards you, or back",
    "left": "To the left",
    "right": "To the right",
    "run": "Run while this key is held; without it the character walks",
    "turn_left": "Turn left while this key is held",
    "turn_right": "Turn right while this key is held",
    "jump": "Jump",
    "record": "Start or stop recording",
    "previous_style": "Go on in the style before",
    "next_style": "Go on in the next style",
}


def _key(name: str) -> Any:
    return EnumProperty(name=_LABELS[name], description=_TIPS[name], items=KEYS, default=DEFAULT_KEYS[name])


class FragmotionPreferences(bpy.types.AddonPreferences):
    """Sticks and keys of Drive; where the live page is."""

    bl_idname = ADDON

    dead_zone: FloatProperty(  # type: ignore[valid-type]
        name="Dead Zone",
        description="How far a pad's stick may stand off its middle, of its whole way, without moving the character",
        default=0.15,
        min=0.0,
        max=0.9,
        subtype="FACTOR",
    )
    curve: FloatProperty(  # type: ignore[valid-type]
        name="Response Curve",
        description=(
            "Power to which a stick's push beyond the dead zone is raised: 1 is a straight line, 2 is finer near the "
            "middle. Half of the result is a walk, the whole a run; the speed between is in proportion"
        ),
        default=1.0,
        min=0.3,
        max=4.0,
    )
    first_steps: BoolProperty(  # type: ignore[valid-type]
        name="First Steps",
        description="Show at the top of the sidebar how to begin. It goes with the first drive",
        default=True,
    )
    live_page: StringProperty(  # type: ignore[valid-type]
        name="Live Page",
        description="The folder of the live page that Open in Browser shows, as `dev.py web` makes it",
        subtype="DIR_PATH",
    )
    key_forward: _key("forward")  # type: ignore[valid-type]
    key_back: _key("back")  # type: ignore[valid-type]
    key_left: _key("left")  # type: ignore[valid-type]
    key_right: _key("right")  # type: ignore[valid-type]
    key_run: _key("run")  # type: ignore[valid-type]
    key_turn_left: _key("turn_left")  # type: ignore[valid-type]
    key_turn_right: _key("turn_right")  # type: ignore[valid-type]
    key_jump: _key("jump")  # type: ignore[valid-type]
    key_record: _key("record")  # type: ignore[valid-type]
    key_previous_style: _key("previous_style")  # type: ignore[valid-type]
    key_next_style: _key("next_style")  # type: ignore[valid-type]

    def keys(self) -> dict[str, str]:
        """What a key does, and the key."""
        return {name: getattr(self, f"key_{name}") for name in DEFAULT_KEYS}

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        column = layout.column()
        column.use_property_split = True
        column.prop(self, "dead_zone")
        column.prop(self, "curve")
        column.prop(self, "live_page")
        column.prop(self, "first_steps")
        layout.label(text="Keys of Drive (click a key, then press another; the arrow keys work too):")
        grid = layout.grid_flow(row_major=True, columns=3, even_columns=True)
        for name, label in _LABELS.items():
            row = grid.split(factor=0.5)
            row.label(text=label)
            row.prop(self, f"key_{name}", text="", event=True)
        keymaps.draw_shortcuts(layout, context)


def get(context: bpy.types.Context) -> Any:
    """The add-on's preferences."""
    return context.preferences.addons[ADDON].preferences


def end_first_steps(context: bpy.types.Context) -> None:
    """Someone has driven, and need not be told how."""
    settings = get(context)
    if settings.first_steps:
        settings.first_steps = False
        context.preferences.is_dirty = True
