# SPDX-License-Identifier: MIT
"""A sheet of rows: equally spaced moments, the stitches between them, and the ways of the feet from above."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from numpy.typing import NDArray

matplotlib.use("Agg")
from matplotlib import pyplot
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from tools.motion_pictures.actor import PAPER, Actor, above_the_lower_edge, seen
from tools.motion_pictures.motions import STATURE, Feet, Motion
from tools.motion_pictures.movements import Movement
from tools.motion_pictures.rows import Row

WIDTH, MARGIN, DPI = 1500, 20, 100  # pixels
INNER = WIDTH - 2 * MARGIN
STRIP, AXIS, PLAN, LINE = 245, 26, 210, 20  # pixels, heights
INTERVAL = 0.5  # s between moments, about
FEWEST = 12  # moments: with fewer the bodies would be higher than their row
LARGEST = 150.0  # pixels a metre, from above
ROOM = 0.62  # statures that a moment is wide
ARMS_UP = 0.2  # statures over the head
LEFT, RIGHT, SLIDES, INK, FAINT = "#0b7d9c", "#d3691f", "#e0003c", "#222222", "#9a9a9a"
PUSHES, PUSHED = "#2c9440", SLIDES
HARD = 6.0  # m/s^2 of a 1.8 m character: a sprinter's start
_GRAVITY = 9.81  # m/s^2
_SHORTEST = 6  # pixels of an arrow
_LEGEND = (
    "Blue: ball of the left foot; orange: of the right. Dots: it stands. Red: it moves while less than 2.5 cm over the "
    "ground, the redder the lower. Grey: the hips.  ▼ ◆: a stitch.\nThe arrow at the hips: their acceleration, as long "
    "as the body is high for gravity's; red: over 6 m/s²."
)


def draw_sheet(movement: Movement, rows: Sequence[Row], actor: Actor, feet: Feet, path: Path) -> None:
    """Write the picture."""
    plans = [_seen_from_above(row.motion, feet) for row in rows]
    scale = min(_scale(plan) for plan in plans)
    heights = [_height(plan, scale) for plan in plans]
    duration = max(row.motion.seconds for row in rows)
    width = _moments(duration) * ROOM * actor.stature
    strip = STRIP + INNER / width * max(_flight(row.motion, actor.stature) for row in rows)
    tall = 2 * LINE + 8 + sum(LINE + strip + AXIS + height + LINE + 12 for height in heights) + 2 * LINE
    figure = pyplot.figure(figsize=(WIDTH / DPI, tall / DPI), dpi=DPI, facecolor=PAPER)
    _write(figure, tall, LINE, movement.title, size=15, weight="bold")
    top: float = 2 * LINE + 8
    for row, plan, height in zip(rows, plans, heights):
        _draw_row(figure, tall, top, row, actor, duration, round(strip))
        _draw_plan(_axes(figure, tall, top + LINE + strip + AXIS, height), plan, row.motion, feet, scale)
        top += LINE + strip + AXIS + height
        _write(figure, tall, top + LINE / 2, row.figures, size=11)
        top += LINE + 12
    _write(figure, tall, top + LINE, _LEGEND, size=9, color="#555555")
    figure.savefig(path, pil_kwargs={"quality": 88} if path.suffix == ".jpg" else None)
    pyplot.close(figure)


def _axes(figure: Figure, tall: float, top: float, height: float) -> Axes:
    """Axes of the full width, so many pixels from the top."""
    axes = figure.add_axes((MARGIN / WIDTH, 1 - (top + height) / tall, INNER / WIDTH, height / tall))
    axes.axis("off")
    return axes


def _write(figure: Figure, tall: float, top: float, text: str, **how: Any) -> None:
    figure.text(MARGIN / WIDTH, 1 - top / tall, text, va="center", **{"color": INK, **how})


def _moments(duration: float) -> int:
    return max(FEWEST, round(duration / INTERVAL) + 1)


def _flight(motion: Motion, stature: float) -> float:
    """How much higher than a body that stands one gets that jumps and holds its arms up, m."""
    rise = float(np.max(motion.roots[:, 2]) - np.median(motion.roots[:, 2]))
    return rise + ARMS_UP * stature if rise > ARMS_UP * stature / 2 else 0.0


def _draw_row(figure: Figure, tall: float, top: float, row: Row, actor: Actor, duration: float, high: int) -> None:
    """The moments over a line of time with the stitches, in a strip that is so high."""
    count = _moments(duration)
    interval = duration / (count - 1)
    motion = row.motion
    times = [k * interval for k in range(count) if k * interval <= motion.seconds + 1e-6]
    width = count * ROOM * actor.stature
    places = [(k + 0.5) * ROOM * actor.stature for k in range(len(times))]
    frames = [min(round(time * motion.rate), len(motion.roots) - 1) for time in times]
    _write(figure, tall, top + LINE / 2, row.title, size=11, weight="bold")
    picture = actor.strip(motion, frames, places, width, (INNER, high))
    strip = _axes(figure, tall, top + LINE, high)
    strip.imshow(picture, aspect="auto")
    for frame, place in zip(frames, places):
        _draw_acceleration(strip, motion, frame, place, INNER / width, actor.stature, high)
    line = _axes(figure, tall, top + LINE + high, AXIS)
    line.set(xlim=(-interval / 2, duration + interval / 2), ylim=(0, 1))
    line.plot([0, motion.seconds], [0.85, 0.85], color=FAINT, lw=0.8)
    line.plot(motion.stitches / motion.rate, np.full(len(motion.stitches), 0.85), "v", color=INK, ms=5)
    for time in times:
        line.text(time, 0.32, f"{time:.1f} s", ha="center", va="center", size=8, color="#555555")


def _draw_acceleration(
    axes: Axes, motion: Motion, frame: int, place: float, scale: float, stature: float, high: int
) -> None:  # fmt: skip
    """An arrow at the hips of a body that stands at `place` m in a strip of `scale` pixels a metre, so high."""
    acceleration = motion.acceleration(frame)
    right, up = seen(acceleration * (stature / _GRAVITY)) * scale
    x, y = place * scale, high - above_the_lower_edge(motion.roots[frame, 2], stature) * scale
    colour = PUSHED if np.linalg.norm(acceleration) * STATURE / stature > HARD else PUSHES
    arrow = {"arrowstyle": "-|>", "color": colour, "lw": 2, "shrinkA": 0, "shrinkB": 0}
    if np.hypot(right, up) > _SHORTEST:
        axes.annotate("", (x + right, y - up), (x, y), arrowprops=arrow, annotation_clip=False)


def _seen_from_above(motion: Motion, feet: Feet) -> NDArray[np.float64]:
    """[F,3,2]: left ball, right ball and hips, with the long direction of the way along x and the least of all at 0."""
    points = np.concatenate([feet.balls(motion)[:, :, :2], motion.roots[:, None, :2]], axis=1)
    way = points[:, 2] - points[0, 2]
    x, y = np.linalg.svd(way - way.mean(axis=0), full_matrices=False)[2][0]
    axes = np.array([[x, -y], [y, x]])
    furthest = way[np.linalg.norm(way, axis=1).argmax()]
    points = points @ (axes if (furthest @ axes)[0] >= 0 else -axes)
    seen: NDArray[np.float64] = points - points.min(axis=(0, 1))
    return seen


def _scale(plan: NDArray[np.float64]) -> float:
    """Pixels a metre."""
    wide, deep = plan.max(axis=(0, 1))
    return float(min(INNER / (wide + 0.4), PLAN / (deep + 0.3), LARGEST))


def _height(plan: NDArray[np.float64], scale: float) -> float:
    return float((plan[:, :, 1].max() + 0.3) * scale)


def _draw_plan(axes: Axes, plan: NDArray[np.float64], motion: Motion, feet: Feet, scale: float) -> None:
    """The ways of hips and balls, the stitches, and a metre."""
    axes.set(xlim=(-0.2, INNER / scale - 0.2), ylim=(-0.15, plan[:, :, 1].max() + 0.15))
    balls = feet.balls(motion)
    weights, planted = feet.weights(balls), feet.planted(balls, motion.rate)
    axes.plot(*plan[:, 2].T, color=FAINT, lw=0.8)
    axes.plot(*plan[motion.stitches, 2].T, "D", color=INK, ms=3)
    for side, colour in enumerate((LEFT, RIGHT)):
        way = plan[:, side]
        axes.plot(*way.T, color=colour, lw=0.8)
        _draw_skate(axes, way, weights[:, side])
        axes.plot(*way[planted[:, side]].T, "o", color=colour, ms=4.5, mew=0)
    _draw_metre(axes, INNER / scale - 0.25, -0.15 - LINE / 2 / scale)


def _draw_metre(axes: Axes, right: float, below: float) -> None:
    """The scale, beside the figures."""
    axes.plot([right - 1, right], [below, below], color=INK, lw=1.5, solid_capstyle="butt", clip_on=False)
    axes.text(right - 1.05, below, "1 m", ha="right", va="center", size=9, color=INK)


def _draw_skate(axes: Axes, way: NDArray[np.float64], weights: NDArray[np.float64]) -> None:
    """The way on the ground, the redder the lower the foot."""
    pieces = np.stack([way[:-1], way[1:]], axis=1)
    colours = [(*to_rgb(SLIDES), weight) for weight in weights[:-1]]
    axes.add_collection(LineCollection(list(pieces), colors=colours, linewidths=3.5, capstyle="butt"))
