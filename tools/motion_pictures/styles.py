# SPDX-License-Identifier: MIT
"""A filmstrip of a character that changes its style as it walks."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import fragmotion_core as core
import numpy as np

from tools.motion_pictures.actor import Actor
from tools.motion_pictures.filmstrips import draw_filmstrip
from tools.motion_pictures.rows import RATE, SEED

_EACH = 24  # controls that each style is walked
_MOMENTS = 5  # of each style


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
