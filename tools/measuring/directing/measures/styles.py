# SPDX-License-Identifier: MIT
"""How good a character is in each of its styles, and how soon and how smoothly it changes to it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from fnmatch import fnmatchcase
from pathlib import Path
from statistics import fmean
from typing import Any, NamedTuple

import fragmotion_core as core
import numpy as np
from fragmotion_command.evaluate.loading import SECONDS, Recordings

from tools.measuring import blend
from tools.measuring.directing.measures.seams import RATE, TRACE_RATE, marked
from tools.shell import Failure

_PRESSES = range(20, 40, 3)  # controls before which a change is asked for, so that it meets every phase of a gait
_AFTER = 30  # controls that are played after it
_JUMP = _PRESSES[0] - 1  # the control that jumps, where one does
_STITCH = 0.2  # s after its beginning, at which a stitch is done most of its way
_EXAMINED = 1000  # how far the seeds of the players that examine are from those that teach

Style = tuple[str, Sequence[core.Clip]]


class Change(NamedTuple):
    """A change of style: s until it is done, and how far a joint goes in a frame meanwhile, m."""

    seconds: float
    step: float


def styled_takes(mocap: Sequence[Path], patterns: Sequence[str], recordings: Recordings) -> list[Style]:
    """The takes of each style, by patterns as --style has them, else as a .blend has them; none where there are no
    styles."""
    if not patterns:
        return [*blend.read_styles(mocap[0])] if mocap[0].suffix.lower() == ".blend" else []
    styles: list[Style] = []
    for text in patterns:
        name, pattern = text.split("=", 1)
        clips = [clip for clip in recordings.clips if fnmatchcase(clip.name, pattern)]
        if not clips:
            raise Failure(f"--style {text}: no take's name fits; the first is called '{recordings.clips[0].name}'")
        styles.append((name, clips))
    return styles


def styles(
    takes: Sequence[Style], build: Callable[[Sequence[Style]], core.Character], seed: int
) -> list[dict[str, Any]]:
    """A row for each style of a character that has all of them: percent of Optimal in it, of a character that was built
    of its takes alone, the longest time in which it is changed to, s, and the furthest that a joint goes in a frame
    meanwhile, over the furthest at stitches while simulated players drive in any style. None without two styles."""
    if len(takes) < 2:
        return []
    character = build(takes)
    metrics = core.MotionMetrics(character)
    usual = max(_usual_step(character, metrics, number, seed) for number in range(len(takes)))
    rows = []
    for number, style in enumerate(takes):
        changes = list(_changes(character, metrics, number))
        rows.append(
            {
                "name": style[0],
                "percent_of_optimal": _percent(character.in_style(number), seed),
                "alone": _percent(build([style]), seed),
                "change_s": max(change.seconds for change in changes),
                "joint_step_ratio": max(change.step for change in changes) / usual,
            }
        )
    return rows


def _percent(character: core.Character, seed: int) -> float:
    """The mean over all simulated players."""
    traces = [core.simulate_trace(name, SECONDS, seed + _EXAMINED, character.space) for name in core.PLAYERS]
    return fmean(character.percent_of_optimal(trace) for trace in traces)


def _changes(character: core.Character, metrics: core.MotionMetrics, to: int) -> Iterator[Change]:
    """Changes to a style from each other one, standing, walking, running, turning, and in jumps."""
    for begin in set(range(len(character.style_names))) - {to}:
        space = character.in_style(begin).space
        gaits = ((0, 0, 0, 0), (0, space.walk, 0, 0), (0, space.run, 0, 0), (0, space.walk, 1, 0))
        for control, jumps in ((gait, jumps) for gait in gaits for jumps in (False, space.jumps)):
            for press in _PRESSES:
                trace = np.tile(np.array(control, float), (press + _AFTER, 1))
                trace[_JUMP, 3] = jumps
                player = core.Player(character, seed=press)
                player.reset(style=begin)
                yield _measured(character, metrics, player.run(trace, RATE, styles=[[press, to]]), press)


def _measured(
    character: core.Character, metrics: core.MotionMetrics, performance: core.Performance, press: int
) -> Change:
    changed = np.diff(performance.styles) != 0
    if not changed.any():
        return Change(float("inf"), 0.0)
    seconds = (np.flatnonzero(changed)[0] + 1) / RATE - press / TRACE_RATE + _STITCH
    return Change(float(seconds), metrics.of(marked(character, performance, changed)).positions.worst)


def _usual_step(character: core.Character, metrics: core.MotionMetrics, style: int, seed: int) -> float:
    """The furthest that a joint goes in a frame at the stitches of a style while each simulated player drives, m."""
    player, worst = core.Player(character, seed=seed), []
    for name in core.PLAYERS:
        player.reset(style=style)
        trace = core.simulate_trace(name, SECONDS, seed + _EXAMINED, character.in_style(style).space)
        worst.append(metrics.of(player.run(trace, RATE)).positions.worst)
    return max(worst)
