# SPDX-License-Identifier: GPL-3.0-or-later
"""An entry of a storyboard."""

from __future__ import annotations

import bpy
from bpy.props import IntProperty, PointerProperty, StringProperty

from .look_fields import LookSettings


def _suggest_styles(beat: BeatSettings, _context: bpy.types.Context, _text: str) -> list[str]:
    return [row.name for row in beat.id_data.fragmotion.figures.styles]


def _suggest_moves(beat: BeatSettings, _context: bpy.types.Context, _text: str) -> list[str]:
    return [row.name for row in beat.id_data.fragmotion.moves]


class BeatSettings(bpy.types.PropertyGroup):
    """An entry, by its `name`: where the character is to be by when, and what it does there."""

    frame: IntProperty(  # type: ignore[valid-type]
        name="By Frame", description="The frame at which it is there, in a bake from Bake's start frame on", default=1
    )
    place: PointerProperty(  # type: ignore[valid-type]
        name="At", description="The object that it goes to; empty: it stays where it is", type=bpy.types.Object
    )
    style: StringProperty(  # type: ignore[valid-type]
        name="Style", description="The style in which it goes there; empty: the first", search=_suggest_styles
    )
    move: StringProperty(  # type: ignore[valid-type]
        name="Move",
        description="The move that it does there; one with a loop until it leaves. Empty: none",
        search=_suggest_moves,
    )
    look: PointerProperty(type=LookSettings)  # type: ignore[valid-type]
