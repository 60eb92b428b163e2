# SPDX-License-Identifier: GPL-3.0-or-later
"""What the status bar says while something runs: how far it is, and its keys and buttons, as of Blender's own modal
tools."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import bpy

from ...compat import versions
from ...compat.event_keys import icon_of, name_of, room_beside

_BAR = 14  # times a button's height: the width of a progress bar


class Hint(NamedTuple):
    """Blender's types of events, or words where it has none, and what they do."""

    keys: tuple[str, ...]
    text: str


class Progress(NamedTuple):
    """What runs, in words, and what share of it is done."""

    text: str
    fraction: float


def show(workspace: bpy.types.WorkSpace, hints: Sequence[Hint], progress: Progress | None = None) -> None:
    """Say this until something else is shown, or the status bar is cleared (`waking.rest`)."""

    def draw(header: Any, _context: bpy.types.Context) -> None:
        row = header.layout.row(align=True)
        if progress is not None:
            _draw_progress(row, progress)
        for hint in hints:
            _draw(row, hint)

    workspace.status_text_set(draw)


def _draw_progress(row: bpy.types.UILayout, progress: Progress) -> None:
    bar = row.row()
    bar.ui_units_x = _BAR
    versions.draw_progress(bar, progress.fraction, progress.text)
    row.separator(factor=2.0)


def _draw(row: bpy.types.UILayout, hint: Hint) -> None:
    for key in hint.keys:
        icon = icon_of(key)
        row.label(text="" if icon else name_of(key), icon=icon or "NONE", translate=False)
        if room_beside(icon):
            row.separator(factor=room_beside(icon))
    row.label(text=hint.text, translate=False)
    row.separator(factor=2.0)
