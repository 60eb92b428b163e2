# SPDX-License-Identifier: GPL-3.0-or-later
"""What style takes are of: happy, tired, armed."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from fnmatch import fnmatchcase
from typing import TypeVar

import bpy

NEUTRAL = "neutral"
"""What the style of takes that tell none is called, where others do."""

Thing = TypeVar("Thing")


def style_of(action: bpy.types.Action) -> str:
    """The take's style; empty where it tells none."""
    return str(action.fragmotion.style).strip()


def grouped(styled: Iterable[tuple[str, Thing]]) -> list[tuple[str, list[Thing]]]:
    """Things by their styles: first those without any, then by name. Where all are without, that is "", else
    NEUTRAL."""
    groups: dict[str, list[Thing]] = {}
    for style, thing in styled:
        groups.setdefault("" if style == NEUTRAL else style, []).append(thing)
    alone = list(groups) == [""]
    return [(style or ("" if alone else NEUTRAL), groups[style]) for style in sorted(groups)]


def set_style(actions: Sequence[bpy.types.Action], style: str, pattern: str) -> int:
    """Let those whose name fits the pattern, whatever the case, be of a style; how many they are."""
    fitting = [action for action in actions if fits_pattern(action.name, pattern)]
    for action in fitting:
        action.fragmotion.style = style.strip()
    return len(fitting)


def fits_pattern(name: str, pattern: str) -> bool:
    """Whether a name fits a pattern, in which * is any text and ? any letter, whatever the case; all fit an empty
    one."""
    return not pattern or fnmatchcase(name.lower(), pattern.lower())
