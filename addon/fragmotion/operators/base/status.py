# SPDX-License-Identifier: GPL-3.0-or-later
"""What the status bar says while something runs: its keys and buttons, as of Blender's own modal tools."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import bpy

from ...compat.event_keys import icon_of, name_of


class Hint(NamedTuple):
    """Blender's types of events, or words where it has none, and what they do."""

    keys: tuple[str, ...]
    text: str


def show(workspace: bpy.types.WorkSpace, hints: Sequence[Hint]) -> None:
    """Say this until other hints are shown, or the status bar is cleared (`waking.rest`)."""

    def draw(header: Any, _context: bpy.types.Context) -> None:
        row = header.layout.row(align=True)
        for hint in hints:
            _draw(row, hint)

    workspace.status_text_set(draw)


def _draw(row: bpy.types.UILayout, hint: Hint) -> None:
    for key in hint.keys:
        icon = icon_of(key)
        row.label(text="" if icon else name_of(key), icon=icon or "NONE", translate=False)
    row.label(text=hint.text, translate=False)
    row.separator(factor=2.0)
