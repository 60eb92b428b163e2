# SPDX-License-Identifier: MIT
"""A filmstrip: moments of a performance side by side, each with its time and a title."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import fragmotion_core as core
import matplotlib as mpl

mpl.use("Agg")
from matplotlib import pyplot

from tools.motion_pictures.actor import PAPER, Actor
from tools.motion_pictures.motions import of_performance
from tools.motion_pictures.rows import RATE

_ROOM = 0.55  # statures that a moment is wide
_SIZE = 1460, 205  # pixels of the strip
_LINE = 30  # pixels above it
_DPI = 100


def draw_filmstrip(
    actor: Actor, played: core.Performance, frames: Sequence[int], titles: Sequence[str], path: Path
) -> None:
    """Write the picture of these frames of a performance at RATE."""
    room = _ROOM * actor.stature
    places = [(moment + 0.5) * room for moment in range(len(frames))]
    picture = actor.strip(of_performance(path.stem, played), frames, places, len(frames) * room, _SIZE)
    wide, tall = _SIZE[0], _SIZE[1] + _LINE
    figure = pyplot.figure(figsize=(wide / _DPI, tall / _DPI), dpi=_DPI, facecolor=PAPER)
    axes = figure.add_axes((0, 0, 1, _SIZE[1] / tall))
    axes.axis("off")
    axes.imshow(picture, aspect="auto")
    for moment, (frame, title) in enumerate(zip(frames, titles)):
        text = f"{frame / RATE:.1f} s\n{title}"
        figure.text((moment + 0.5) / len(titles), 1 - _LINE / 2 / tall, text, ha="center", va="center", size=8)
    figure.savefig(path, pil_kwargs={"quality": 88})
    pyplot.close(figure)
