# SPDX-License-Identifier: GPL-3.0-or-later
"""The classes of an armature's character: their names, which are left out, and playing one on demand."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Protocol

import bpy
from bpy.props import BoolProperty, IntProperty, StringProperty

from ..errors import UserError

if TYPE_CHECKING:
    from fragmotion_core import Character, ControlSpace, Player


class Session(Protocol):
    """What a drive in progress tells of itself."""

    @property
    def armature(self) -> str:
        """The name of the armature object that it moves."""

    @property
    def player(self) -> Player:
        """What plays."""

    @property
    def control(self) -> Sequence[float]:
        """The command now, [4] as in a trace."""


session: Session | None = None
"""The drive in progress: set when it starts, None when it has ended."""


def _never_empty(row: Any, _context: bpy.types.Context) -> None:
    if not row.name:
        row.name = row.suggested


class ClassRow(bpy.types.PropertyGroup):
    """One class, by its number."""

    name: StringProperty(  # type: ignore[valid-type]
        name="Name", description="What the class does; empty it to get the suggested name back", update=_never_empty
    )
    suggested: StringProperty()  # type: ignore[valid-type]
    excluded: BoolProperty(  # type: ignore[valid-type]
        name="Leave Out",
        description="Drive, Bake and Save Policy never choose this class; Force still plays it",
        default=False,
    )
    fragments: IntProperty()  # type: ignore[valid-type]
    sketch: StringProperty()  # type: ignore[valid-type]
    described: StringProperty()  # type: ignore[valid-type]
    moment: StringProperty()  # type: ignore[valid-type]


def shown_style(figures: Any) -> int:
    """The number of the style whose classes and controls the panels show."""
    last = len(figures.styles) - 1
    return int(max(0, min(figures.active_style, last)))


def rows_of(obj: bpy.types.Object, style: int) -> Any:
    """The classes as they are listed of one of the armature's styles, of which the first is its own."""
    settings = obj.fragmotion
    return settings.figures.styles[style].rows if style else settings.classes


def shown_rows(obj: bpy.types.Object) -> Any:
    """The classes of the style that the panels show."""
    return rows_of(obj, shown_style(obj.fragmotion.figures))


def name_of(obj: bpy.types.Object, style: int, number: int) -> str:
    """A class as the user calls it; one that is not listed, as of a character of more classes, by its number."""
    rows = rows_of(obj, style)
    return str(rows[number].name) if number < len(rows) else f"Class {number}"


def words_of(obj: bpy.types.Object) -> dict[str, tuple[str, bool]]:
    """What the user said of the classes that are listed, of all styles: by the fragment which represents one, its name
    (empty: the suggested one) and whether it is left out."""
    words = {}
    for row in (row for style in _styles_of(obj) for row in rows_of(obj, style)):
        own = row.name if row.name != row.suggested else ""
        if own or row.excluded:
            words[row.moment] = own, row.excluded
    return words


def keep_rows(rows: Any, character: Character, words: dict[str, tuple[str, bool]]) -> None:
    """List the character's classes.

    What the user said of classes that were listed before goes over to the class that now holds the fragment which
    represented it, where the new takes still have that fragment.
    """
    moments = _moments(character)
    holders = dict(zip(moments, character.labels.tolist()))
    said: dict[int, tuple[str, bool]] = {}
    for moment, word in words.items():
        if moment in holders:
            said.setdefault(holders[moment], word)
    sizes = [0] * len(character.representatives)
    for label in character.labels.tolist():
        sizes[label] += 1
    rows.clear()
    for number, (name, fragment) in enumerate(zip(character.class_names, character.representatives.tolist())):
        row = rows.add()
        row.suggested, row.moment, row.fragments = name, moments[fragment], sizes[number]
        evident = character.evident[fragment].tolist()
        row.sketch, row.described = sketch(evident, character.space), describe(evident, character.space)
        own, row.excluded = said.get(number, ("", False))
        row.name = own or name


def check_rows(obj: bpy.types.Object, character: Character) -> None:
    """UserError where the classes that are listed cannot be the character's: the .blend is damaged. Older files list
    those of the first style alone."""
    pairs = [(len(obj.fragmotion.figures.styles), len(character.style_names), "styles")]
    if pairs[0][0] == pairs[0][1]:
        for style in _styles_of(obj):
            listed = len(rows_of(obj, style))
            if listed or not style:
                pairs.append((listed, len(character.in_style(style).representatives), "classes"))
    for listed, known, what in pairs:
        if listed != known:
            raise UserError(
                f"Armature '{obj.name}' lists {listed} {what}, but its policy has {known}: press Build again, or Load "
                "the policy's file under Policy File"
            )


def excluded(obj: bpy.types.Object, style: int = 0) -> tuple[int, ...]:
    """The numbers of a style's classes that are left out."""
    return tuple(number for number, row in enumerate(rows_of(obj, style)) if row.excluded)


def all_excluded(obj: bpy.types.Object) -> tuple[tuple[int, tuple[int, ...]], ...]:
    """The styles of which classes are left out, and which those are."""
    left_out = ((style, excluded(obj, style)) for style in _styles_of(obj))
    return tuple((style, numbers) for style, numbers in left_out if numbers)


def describe(control: Sequence[float], space: ControlSpace) -> str:
    """A control in words with units, as "1.2 m/s forward, 0.1 m/s left, 30 degrees/s left, jumping"."""
    x, y, turn, jump = control
    rate = turn * math.degrees(space.turn_rate)
    parts = [
        _amount(y, 0.05, "{:.1f} m/s", ("forward", "back")),
        _amount(x, 0.05, "{:.1f} m/s", ("right", "left")),
        _amount(rate, 3, "turning {:.0f}\N{DEGREE SIGN}/s", ("left", "right")),
        "jumping" if jump > 0.5 else "",
    ]
    return ", ".join(part for part in parts if part) or "at rest"


_ARROWS = "\u2191\u2196\u2190\u2199\u2193\u2198\u2192\u2197"  # counter-clockwise from forward


def sketch(control: Sequence[float], space: ControlSpace) -> str:
    """A control in a few signs: an arrow with the speed in m/s, L or R where it turns, J where it jumps."""
    x, y, turn, jump = control
    speed = math.hypot(x, y)
    arrow = _ARROWS[round(math.atan2(-x, y) / (math.pi / 4)) % 8]
    moves = f"{arrow}{speed:.1f}" if speed > space.speeds[0] / 2 else "\u00b7"
    return moves + (" L" if turn > 0.5 else " R" if turn < -0.5 else "") + (" J" if jump > 0.5 else "")


def driven(obj: bpy.types.Object) -> Session | None:
    """The drive that moves this armature now; else None."""
    return session if session is not None and session.armature == obj.name else None


def force(obj: bpy.types.Object, number: int) -> None:
    """Let the drive in progress play the class of its style now; UserError where none moves the armature."""
    drive = driven(obj)
    if drive is None:
        raise UserError(f"Armature '{obj.name}' is not being driven: start Drive first")
    drive.player.force(number)


def _styles_of(obj: bpy.types.Object) -> range:
    return range(max(len(obj.fragmotion.figures.styles), 1))


def _moments(character: Character) -> list[str]:
    """What tells each fragment from all others, also in a later build."""
    clips = character.clip_names
    places = zip(character.fragment_clips.tolist(), character.fragment_ranges.tolist())
    return [f"{clips[clip]} {begin:.3f}-{end:.3f}" for clip, (begin, end) in places]


def _amount(value: float, least: float, text: str, signs: tuple[str, str]) -> str:
    return f"{text.format(abs(value))} {signs[value < 0]}" if abs(value) >= least else ""
