# SPDX-License-Identifier: GPL-3.0-or-later
"""The keys and buttons of a drive, for the status bar."""

from __future__ import annotations

from ...character.moves import names_of
from ...drive.session import Session
from ...input.keyboard import NO_KEY
from ..base.status import Hint


def hints(driven: Session) -> list[Hint]:
    """What can be pressed now, the most needed first: of a pad, where one drives, else of the keyboard."""
    return [
        Hint(("ESC",), "End, Keep the Recording" if driven.recording is not None else "End"),
        *_record(driven),
        *(_pad() if driven.inputs.by_pad else _keyboard(driven)),
        *_moves(driven),
        *_styles(driven),
        *([Hint(("LEFTMOUSE",), "Walk There")] if driven.settings.click_to_walk else []),
    ]


def _record(driven: Session) -> list[Hint]:
    if driven.punch is not None:
        return []
    text = "Record" if driven.recording is None else "End Recording"
    return [Hint(("Start",) if driven.inputs.by_pad else (driven.keys["record"],), text)]


def _keyboard(driven: Session) -> list[Hint]:
    keys = driven.keys
    return [
        Hint((keys["forward"], keys["left"], keys["back"], keys["right"]), "Go"),
        Hint((keys["run"],), "Run"),
        Hint((keys["turn_left"], keys["turn_right"]), "Turn"),
        Hint((keys["jump"],), "Jump"),
    ]


def _pad() -> list[Hint]:
    return [Hint(("Left Stick",), "Go"), Hint(("Right Stick",), "Turn"), Hint(("A",), "Jump")]


def _moves(driven: Session) -> list[Hint]:
    """Those that the input that drives can start."""
    which = 1 if driven.inputs.by_pad else 0
    named = zip(names_of(driven.actor.character), driven.triggers)
    return [Hint((trigger[which],), name) for name, trigger in named if trigger[which] != NO_KEY]


def _styles(driven: Session) -> list[Hint]:
    if not driven.styling.names:
        return []
    keys = ("D-Pad",) if driven.inputs.by_pad else (driven.keys["previous_style"], driven.keys["next_style"])
    return [Hint(keys, "Style")]
