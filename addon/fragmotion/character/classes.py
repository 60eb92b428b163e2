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


def keep_rows(rows: Any, character: Character) -> None:
    """List the character's classes.

    What the user said of a class that was listed before, its name and whether it is left out, goes over to the class
    that now holds the fragment which represented it, where the new takes still have that fragment.
    """
    moments = _moments(character)
    said = _said_of(rows, dict(zip(moments, character.labels.tolist())))
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
    """UserError where the classes that are listed cannot be the character's: the .blend is damaged."""
    listed, known = len(obj.fragmotion.classes), len(character.representatives)
    if listed != known:
        raise UserError(
            f"Armature '{obj.name}' lists {listed} classes, but its policy has {known}: press Build again, or Load the "
            "policy's file under Policy File"
        )


def excluded(obj: bpy.types.Object) -> tuple[int, ...]:
    """The numbers of the armature's classes that are left out."""
    return tuple(number for number, row in enumerate(obj.fragmotion.classes) if row.excluded)


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
    """The drive that moves this armature now, in the first style, whose classes the list has; else None."""
    drives = session is not None and session.armature == obj.name and session.player.playing_style == 0
    return session if drives else None


def force(obj: bpy.types.Object, number: int) -> None:
    """Let the drive in progress play the class now; UserError where none moves the armature."""
    drive = driven(obj)
    if drive is None:
        raise UserError(f"Armature '{obj.name}' is not being driven: start Drive first")
    drive.player.force(number)


def _said_of(rows: Any, holders: dict[str, int]) -> dict[int, tuple[str, bool]]:
    """By new class number: a name that the user gave (or empty), and whether the class was left out."""
    said: dict[int, tuple[str, bool]] = {}
    for row in rows:
        own = row.name if row.name != row.suggested else ""
        if row.moment in holders and (own or row.excluded):
            said.setdefault(holders[row.moment], (own, row.excluded))
    return said


def _moments(character: Character) -> list[str]:
    """What tells each fragment from all others, also in a later build."""
    clips = character.clip_names
    places = zip(character.fragment_clips.tolist(), character.fragment_ranges.tolist())
    return [f"{clips[clip]} {begin:.3f}-{end:.3f}" for clip, (begin, end) in places]


def _amount(value: float, least: float, text: str, signs: tuple[str, str]) -> str:
    return f"{text.format(abs(value))} {signs[value < 0]}" if abs(value) >= least else ""
