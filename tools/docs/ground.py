# SPDX-License-Identifier: MIT
"""The pictures of docs/ground: a walk of the sample character over each slope and stairs, seen from the side."""

from __future__ import annotations

import math

import fragmotion_core as core
import matplotlib as mpl
import numpy as np
from numpy.typing import NDArray

mpl.use("Agg")
from matplotlib import pyplot
from matplotlib.axes import Axes

from tools.measuring.blend import read_actions
from tools.measuring.directing.inputs import SAMPLE
from tools.measuring.directing.measures.ground import GROUNDS, Height, asked
from tools.paths import TOP

FOLDER = TOP / "docs" / "ground"
RATE, SECONDS, EVERY = 60, 3.5, 12  # frames a second; s; frames between two bodies
LEFT, RIGHT, BODY, GROUND = "#0b7d9c", "#d3691f", "#555555", "#b8b4a8"


def draw() -> None:
    """Draw a walk over each ground."""
    character = core.build(*read_actions(SAMPLE), [core.simulate_trace("explorer")])
    FOLDER.mkdir(exist_ok=True)
    for name, (height, heading) in GROUNDS.items():
        figure, axes = pyplot.subplots(figsize=(15, 6), dpi=100)
        _draw(axes, character, height, heading)
        axes.set_title(f"{name[0].upper()}{name[1:]}: five bodies a second", loc="left")
        figure.savefig(FOLDER / f"{name.replace(' ', '_')}.png", bbox_inches="tight")
        pyplot.close(figure)


def _draw(axes: Axes, character: core.Character, height: Height, heading: float) -> None:
    heads, tips = _play(character, height, heading)
    skeleton, forward = character.skeleton, np.array([-math.sin(heading), math.cos(heading)])
    hips = skeleton.names.index(skeleton.roles["hips"])
    along = heads[:, hips, :2] @ forward
    # Square to the way where the ground rises across it: then it is seen from behind, one body beside the other.
    across = abs(forward[1]) < 0.5
    for frame in range(0, len(heads), EVERY):
        aside = 0.9 * frame / EVERY if across else 0.0
        for bone in range(hips, len(skeleton.names)):
            x = [_seen(point, across, forward) + aside for point in (heads[frame, bone], tips[frame, bone])]
            axes.plot(x, [heads[frame, bone, 2], tips[frame, bone, 2]], color=_color(skeleton.names[bone]), lw=1.6)
        if across:
            ys = np.linspace(-0.45, 0.45, 50) + heads[frame, hips, 1]
            axes.plot(ys + aside, [height(0, y) for y in ys], color=GROUND, lw=2)
    if not across:
        places = np.linspace(along.min() - 0.3, along.max() + 0.7, 3000)
        axes.plot(places, [height(0, place * forward[1]) for place in places], color=GROUND, lw=2, zorder=0)
    axes.set_aspect("equal")
    axes.axis("off")


def _seen(point: NDArray[np.float64], across: bool, forward: NDArray[np.float64]) -> float:
    return float(point[1] if across else point[:2] @ forward)


def _color(name: str) -> str:
    side = name.replace("_", ".").lower()
    return LEFT if side.endswith(".l") or "left" in side else RIGHT if side.endswith(".r") or "right" in side else BODY


def _play(character: core.Character, height: Height, heading: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Heads and tips of the bones [F,B,3] of a walk straight ahead."""
    player, skeleton = core.Player(character, 1), character.skeleton
    player.stand_on(asked(height))
    player.reset(0.0, 0.1, heading)
    played = player.run(np.tile([0, character.space.walk, 0, 0], (round(10 * SECONDS), 1)), RATE)
    clip = core.Clip(skeleton, "played", RATE, played.root_positions, played.rotations)
    heads, rotations = clip.world_transforms(skeleton)
    w, u, tip = rotations[..., :1], rotations[..., 1:], np.asarray(skeleton.tips)
    return heads, heads + tip + 2 * np.cross(u, np.cross(u, tip) + w * tip)


if __name__ == "__main__":
    draw()
