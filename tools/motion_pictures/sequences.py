# SPDX-License-Identifier: MIT
"""Filmstrips of a character: it makes moves one after the other, changes its style as it walks, or holds things."""

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
_STATURE = 1.8  # m
_TRAY, _RAIL_FROM, _RAIL, _RAISED, _HANDS_LAST = 12, 30, 42, 56, 76  # controls from which, at which and to which


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


def draw_hands(character: core.Character, actor: Actor, path: Path) -> None:
    """Write the picture of a walk as captured, with both hands at a tray, with one at a rail that it comes by, and with
    one raised."""
    trace = np.tile(np.array([0.0, character.space.walk, 0.0, 0.0]), (_HANDS_LAST, 1))
    size = actor.stature / _STATURE
    forward = core.Player(character, SEED).run(trace, RATE).path[round(_RAIL * RATE / _CONTROLS)]
    rail = (forward[0] + 0.5 * size, forward[1] + 0.5 * size, 1.0 * size)
    played = core.Player(character, SEED).run(
        trace,
        RATE,
        reaches=[
            *([at, hand, float(at == _TRAY), 1, x * size, 0.42 * size, 1.12 * size]
              for at in (_TRAY, _RAIL_FROM) for hand, x in ((0, -0.17), (1, 0.17))),
            [_RAIL_FROM + 1, 1, 1.0, 0, *rail],
            [_RAISED, 1, 1.0, 1, 0.25 * size, 0.3 * size, 1.75 * size],
        ],
    )  # fmt: skip
    spans = ((0, _TRAY, "as captured"), (_TRAY + 6, _RAIL_FROM, "carries"), (_RAIL_FROM + 8, _RAISED, "reaches"),
             (_RAISED + 6, _HANDS_LAST, "holds up"))  # fmt: skip
    controls = [np.linspace(begin, end, _MOMENTS - 1, endpoint=False) for begin, end, _ in spans]
    frames = (np.concatenate(controls) * RATE / _CONTROLS).round().astype(int)
    titles = [title for *_, title in spans for _ in range(_MOMENTS - 1)]
    draw_filmstrip(actor, played, frames.tolist(), titles, path)


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
