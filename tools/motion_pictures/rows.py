# SPDX-License-Identifier: MIT
"""The rows of a sheet: a take, what we play, and plain paper stitching, each with its figures."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import fragmotion_core as core

from tools.motion_pictures.motions import Motion, of_clip, of_performance
from tools.motion_pictures.movements import Movement, nearest_take, trace_of

RATE = 60.0  # frames a second
SEED = 1
OURS: dict[str, Any] = {}
PAPER: dict[str, Any] = {"stitching": "crossfade", "lock_feet": False, "root_adjustment": 0.0}


class Row(NamedTuple):
    """A motion, what it is, and what was measured of it."""

    title: str
    motion: Motion
    figures: str


class Cast:
    """A character and the takes that it was built from."""

    def __init__(self, skeleton: core.Skeleton, clips: Sequence[core.Clip]) -> None:
        self.skeleton, self.clips = skeleton, {clip.name: clip for clip in clips}
        options = core.BuildOptions()
        options.policies = options.policies[:1]
        self.character = core.build(skeleton, clips, [core.simulate_trace("explorer")], options)
        self._yardstick = core.MotionMetrics(self.character)

    def rows(self, movement: Movement) -> list[Row]:
        """The take that is nearest to the movement, where there is one, and what two players make of it."""
        trace = trace_of(movement.parts, self.character.space)
        source = self._source(movement, len(trace) / 10)
        ours = self._played("Ours", "as a new Player plays it", trace, OURS)
        paper = self._played("Plain paper stitching", "cross-fades alone, nothing done about feet", trace, PAPER)
        return [*source, ours, paper]

    def _source(self, movement: Movement, longest: float) -> list[Row]:
        found = nearest_take(self.character, movement.example or movement.parts)
        if not found:
            return []
        shown = cut(self.clips[found.clip], self.skeleton, found.start, min(found.end, found.start + longest))
        title = f"The take nearest to it: “{found.clip}”, from {found.start:.1f} s"
        return [Row(title, of_clip(shown, self.skeleton), self._describe(self._of_take(shown)))]

    def _played(self, name: str, how: str, trace: core.Doubles, options: dict[str, Any]) -> Row:
        performance = core.Player(self.character, SEED, **options).run(trace, RATE)
        motion = of_performance(name, performance)
        figures = self._describe(self._yardstick.of(performance))
        return Row(f"{name}, {how}", motion, f"{figures};   {len(motion.stitches)} stitches")

    def _of_take(self, clip: core.Clip) -> core.MotionMeasures:
        """The measures of one take alone, by the smallest build there is."""
        options = core.BuildOptions()
        options.classes, options.restarts, options.policies = 1, 1, ["greedy"]
        options.mirror = options.synthesize = False
        alone = core.build(self.skeleton, [clip], [core.simulate_trace("explorer", 1)], options)
        return core.MotionMetrics(alone).takes

    def _describe(self, measures: core.MotionMeasures) -> str:
        takes = self._yardstick.takes
        skate, step = measures.foot_skate / takes.foot_skate, measures.positions.worst / takes.positions.p999
        hips = measures.hips
        return (
            f"foot skate {100 * measures.foot_skate:.1f} cm/s, {skate:.2f} times that of all takes;   "
            f"worst joint step {step:.2f} times the takes' 99.9th percentile;   "
            f"hips' acceleration up to {hips.worst:.1f} m/s²"
        )


def cut(clip: core.Clip, skeleton: core.Skeleton, start: float, end: float) -> core.Clip:
    """A span of a clip, s."""
    span = slice(round(start * clip.rate), round(end * clip.rate) + 1)
    return core.Clip(skeleton, clip.name, clip.rate, clip.root_positions[span], clip.rotations[span])
