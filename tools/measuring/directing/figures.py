# SPDX-License-Identifier: MIT
"""Paths and the ways that were walked over them, as a picture."""

from __future__ import annotations

from pathlib import Path

import fragmotion_core as core
import matplotlib as mpl

from tools.measuring.directing.measures.courses import Array, Course
from tools.measuring.directing.measures.paths import speeds

mpl.use("Agg")

from matplotlib import pyplot as plt

NAME = "paths.png"
_SHOWN = ("circle, 2 m", "figure of eight, 3 m", "right angles", "random curve 2")
_COLOURS = {"walk": "#1f6fb4", "run": "#e8710a"}
_RATE = 60  # frames a second


def walked(character: core.Character, course: Course, gait: str) -> Array:
    """Where a character goes along a course [F,2], m."""
    path, player = core.Path(course.points, course.closed), core.Player(character)
    walk = core.follow_path(player, path, speed=speeds(character.space)[gait], rate=_RATE)
    player.reset(*path.start)
    places: Array = player.run(walk.trace, _RATE).path[:, :2]
    return places


def draw_paths(character: core.Character, courses: list[Course], folder: Path) -> Path:
    """Write the picture into the folder, which is made where it is missing."""
    shown = [course for course in courses if course.name in _SHOWN]
    figure, axes = plt.subplots(1, len(shown), figsize=(13, 4.2), squeeze=False, constrained_layout=True)
    for axis, course in zip(axes[0], shown):
        path = core.Path(course.points, course.closed)
        line = path.places([path.length * step / 2000 for step in range(2001)])
        axis.plot(*line.T, color="0.82", linewidth=9, solid_capstyle="round", label="the path")
        for gait, colour in _COLOURS.items():
            axis.plot(*walked(character, course, gait).T, color=colour, linewidth=1.1, label=gait)
        axis.set_title(course.name, fontsize=11)
        axis.set_aspect("equal", adjustable="datalim")
        axis.tick_params(labelsize=8)
        axis.set_xlabel("m", fontsize=9)
    axes[0, 0].legend(fontsize=9, loc="center")
    folder.mkdir(parents=True, exist_ok=True)
    figure.savefig(folder / NAME, dpi=110)
    plt.close(figure)
    return folder / NAME
