# SPDX-License-Identifier: MIT
"""Filmstrips of a character that makes its moves one after the other, or changes its style as it walks."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import fragmotion_core as core
import numpy as np

from tools.motion_pictures.actor import Actor
from tools.motion_pictures.filmstrips import draw_filmstrip
from tools.motion_pictures.rows import RATE, SEED

_CONTROLS = 10  # a second
_MOMENTS = 5  # of each move or style
_EACH = 24  # controls that each style is walked
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


def draw_styles(styles: Sequence[tuple[str, Sequence[core.Clip]]], actor: Actor, path: Path) -> None:
    """Write the picture of a walk in each of the styles, one after the other."""
    options = core.BuildOptions()
    options.policies = options.policies[:1]
    character = core.build_styles(actor.rig.skeleton, styles, [core.simulate_trace("explorer")], options)
    trace = np.concatenate([_walk(character, style) for style in range(len(styles))])
    changes = [[_EACH * style, style] for style in range(1, len(styles))]
    played = core.Player(character, SEED).run(trace, RATE, styles=changes)
    count = _MOMENTS * len(styles)
    frames = np.linspace(RATE / 2, len(played.styles) - 1, count).round().astype(int)
    titles = [character.style_names[played.styles[frame]] for frame in frames]
    draw_filmstrip(actor, played, frames.tolist(), titles, path)


def _walk(character: core.Character, style: int) -> core.Doubles:
    """A style's own walk, straight ahead."""
    return np.tile(np.array([0.0, character.in_style(style).space.walk, 0.0, 0.0]), (_EACH, 1))
