# SPDX-License-Identifier: MIT
"""A filmstrip of a character that makes its moves, one after the other."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import fragmotion_core as core
import numpy as np

from tools.motion_pictures.actor import Actor
from tools.motion_pictures.filmstrips import draw_filmstrip
from tools.motion_pictures.rows import RATE, SEED

_CONTROLS = 10  # a second
_MOMENTS = 5  # of each move
_PAUSE = 0.8  # s before each move
_HELD = 3  # s


def draw_moves(character: core.Character, moves: Sequence[core.Move], actor: Actor, path: Path) -> None:
    """Write the picture of these moves: those of the upper body while it walks, the others while it stands."""
    character = character.with_moves(list(moves))
    trace: list[list[float]] = []
    presses: list[list[int]] = []
    for number, move in enumerate(moves):
        control = [0.0, character.space.walk if move.upper_body else 0.0, 0.0, 0.0]
        seconds = _PAUSE + move.wait + len(move.clip.root_positions) / move.clip.rate
        presses.append([len(trace) + round(_PAUSE * _CONTROLS), number, _HELD * _CONTROLS])
        trace += [control] * round(seconds * _CONTROLS)
    played = core.Player(character, SEED).run(np.array(trace), RATE, moves=presses)
    playing = np.asarray(played.moves).max(1)
    frames = np.concatenate([_moments(playing == number) for number in range(len(moves))])
    draw_filmstrip(actor, played, frames.tolist(), [moves[i].name for i in playing[frames]], path)


def _moments(plays: core.Doubles) -> core.Ints:
    """Frames from the first to the last at which a move plays."""
    span = np.flatnonzero(plays)
    moments: core.Ints = np.linspace(span[0], span[-1], _MOMENTS).round().astype(np.int32)
    return moments
