# SPDX-License-Identifier: GPL-3.0-or-later
"""What a drive hands to what draws it."""

from __future__ import annotations

from typing import Any, NamedTuple

from ...input.screen_stick import ScreenStick
from ...input.steering import Intent
from .readings import Readings

LONGEST_UPDATE = 0.1
"""Seconds that an update goes on at the most, so that a pause makes no leap; where all take longer, motion is slow."""


class Shown(NamedTuple):
    """A drive at the moment when it is drawn."""

    title: str
    recording: bool
    input: str
    """What drives, in words; empty where nothing was touched yet."""
    intent: Intent
    stick: ScreenStick
    readings: Readings
    settings: Any
    """The armature's DriveSettings: what the user wants to see."""
    cost: float
    interval: float
    """Our own time for an update and the time between updates, s."""
    move: str = ""
    """The moves that play or wait, in words."""
    style: str = ""
    """The style that plays, and the one that waits, in words."""
    seconds: float = 0.0
    """Since the drive began."""
    go_keys: str = ""
    """The keys that let it go, in words."""
    span: tuple[float, float] | None = None
    """The scene's frames from and to which a recording is recorded over, if one is."""
    target: tuple[float, float, float] | None = None
    """Where it was sent by a click, if it is on its way there."""
