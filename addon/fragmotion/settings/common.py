# SPDX-License-Identifier: GPL-3.0-or-later
"""What the fields of several stages have in common."""

from __future__ import annotations

from typing import Any

from bpy.props import EnumProperty, FloatProperty, IntProperty, StringProperty

from ..compat.core import core

_SOURCES = (
    ("PLAYER", "Simulated", "A made-up joystick session: a stick with inertia that chases targets"),
    ("FILE", "CSV File", "A CSV file with the header velocity_x,velocity_y,turn,jump and 10 rows a second"),
)

_HABITS = tuple((name, name.title(), f"A simulated player with the habits of a {name}") for name in core.PLAYERS)

_POLICY_LABELS = {
    "anticipate": (
        "Looking Ahead",
        "Looks ahead, as value iteration does, and knows how long any player keeps a control",
    ),
    "iterate": ("Value Iteration", "Looks ahead, with a model of how the controls change learned from the trace alone"),
    "svm": ("SVM", "A support vector machine that learned from the best path through the trace"),
    "greedy": ("Greedy", "The best next class, without a look at what comes after it"),
}

_POLICIES = tuple((name, *_POLICY_LABELS.get(name, (name.title(), ""))) for name in core.POLICIES)

POLICY_NAMES = {name: label for name, label, _ in _POLICIES}
"""What the core's policies are called in the panel."""

CHOOSING = "How the next class is chosen from the class that plays and the control"
"""What a policy is for, in words."""


def player_field(description: str, default: str, *others: tuple[str, str, str]) -> Any:
    """Whose habits a simulated player has."""
    return EnumProperty(name="Player", description=description, items=(*others, *_HABITS), default=default)


def length_field(default: float, least: float = 0.5, who: str = "the simulated player plays") -> Any:
    return FloatProperty(
        name="Length",
        description=f"How long {who}, in seconds",
        default=default,
        min=least,
        max=3600.0,
        unit="TIME_ABSOLUTE",
    )


def seed_field(description: str) -> Any:
    return IntProperty(name="Seed", description=description, default=1, min=0)


def factor_field(name: str, description: str, default: float) -> Any:
    return FloatProperty(name=name, description=description, default=default, min=0.0, max=1.0, subtype="FACTOR")


def policy_field(description: str, default: str, *others: tuple[str, str, str], name: str = "Policy") -> Any:
    return EnumProperty(name=name, description=description, items=(*others, *_POLICIES), default=default)


def source_field(*others: tuple[str, str, str], default: str = "PLAYER") -> Any:
    return EnumProperty(
        name="Trace",
        description="Where the joystick session comes from",
        items=(*_SOURCES, *others),
        default=default,
    )


class TraceFields:
    """Where a trace comes from."""

    trace_source: source_field()  # type: ignore[valid-type]
    trace_file: StringProperty(  # type: ignore[valid-type]
        name="Trace File",
        description="CSV file: velocity_x,velocity_y (m/s), turn (-1 to 1, 1 is left), jump (0 or 1); 10 rows a second",
        subtype="FILE_PATH",
    )
