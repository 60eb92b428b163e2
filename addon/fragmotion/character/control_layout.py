# SPDX-License-Identifier: GPL-3.0-or-later
"""Which controls a character has, as a .blend keeps it, so that panels need not read the policy."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from ..compat.core import core

if TYPE_CHECKING:
    from fragmotion_core import Character, ControlSpace

GAITS: list[str] = core.GAITS
"""What speeds are called, from the slowest."""

DIRECTIONS: list[str] = core.DIRECTIONS
"""Sixteen, counter-clockwise from forward; of fewer every second or fourth."""

_COUNTS = (4, 8, 16)  # of directions
_MOST_SPEEDS = 4


class ControlLayout(NamedTuple):
    """The points of a control space; by default the paper's 102."""

    gaits: tuple[str, ...] = ("walk", "run")
    directions: int = 8
    turn: bool = True
    jump: bool = True

    @property
    def shape(self) -> tuple[int, int, int]:
        """As ControlSpace.shape."""
        return 1 + len(self.gaits) * self.directions, 3 if self.turn else 1, 2 if self.jump else 1

    @property
    def direction_names(self) -> list[str]:
        """From forward, counter-clockwise."""
        return DIRECTIONS[:: len(DIRECTIONS) // self.directions]


def layout_of(space: ControlSpace) -> ControlLayout:
    """That of a control space."""
    return ControlLayout(tuple(space.gaits), space.directions, space.turns, space.jumps)


def keep_layout(figures: Any, space: ControlSpace) -> None:
    """Keep a character's with the figures of its build."""
    layout = layout_of(space)
    figures.gaits, figures.directions, figures.turn, figures.jump = ", ".join(layout.gaits), *layout[1:]


def kept_layout(figures: Any) -> ControlLayout | None:
    """What was kept; None where the .blend is damaged."""
    gaits = tuple(figures.gaits.split(", "))
    known = 1 <= len(gaits) <= _MOST_SPEEDS and all(gait in GAITS for gait in gaits) and figures.directions in _COUNTS
    return ControlLayout(gaits, figures.directions, figures.turn, figures.jump) if known else None


def say_lacking(character: Character) -> str:
    """What the takes lack of the controls that they were asked for; empty of the paper's, whose Coverage tells it, and
    where they lack nothing or a policy file does not tell."""
    layout, report = layout_of(character.space), character.report
    if layout == ControlLayout() or "speeds_held" not in report:
        return ""
    asked = {"speeds": len(layout.gaits), "directions": layout.directions}
    lacking = [
        f"{report[f'{name}_held']:.0f} of the {count} {name}"
        for name, count in asked.items()
        if report[f"{name}_held"] < count
    ]
    lacking += [f"no {name}s" for name in ("turn", "jump") if getattr(layout, name) and not report[f"{name}_held"]]
    if not lacking:
        return ""
    return f"The takes hold {', '.join(lacking)}: the rest is made of what there is. Coverage shows how well"
