# SPDX-License-Identifier: MIT
"""How fast a system answers, as the core's response_times has it, for systems that only play traces."""

from __future__ import annotations

from typing import NamedTuple

import fragmotion_core as core
import numpy as np
from fragmotion_command.evaluate.rotations import Array, turned

from tools.measuring.beside.setting import Setting
from tools.measuring.beside.systems import System
from tools.measuring.peers.kinematics.bodies import RATE

_DONE = 0.9  # of a step of the command
_WINDOW = 6  # frames over which a velocity is measured
_FRAMES_A_ROW = 6  # of a trace
_LEAST, _MOST, _AFTER = 15, 20, 30  # rows of a trace for which a control is held before a step, and after it


class Steps(NamedTuple):
    """A trace [T,4] that goes from one velocity to each other one and back, and the rows where it does."""

    before: Array
    trace: Array
    rows: list[int]
    after: list[Array]


def step_traces(character: core.Character, seed: int) -> list[Steps]:
    """One for each of the 17 velocities; what is waited for is as much of each as the character is able to do."""
    random = np.random.default_rng(seed)
    space = character.space
    controls = space.points.reshape(*space.shape, -1)[:, 0, 0]
    able = character.able(controls)[:, :2]
    return [_steps(controls[:, :2], able, i, random) for i in range(len(controls))]


def _steps(velocities: Array, able: Array, own: int, random: np.random.Generator) -> Steps:
    shown: list[int] = []
    rows, after = [], []
    for other in range(len(velocities)):
        if other == own:
            continue
        shown += [own] * int(random.integers(_LEAST, _MOST + 1))
        rows.append(len(shown))
        after.append(able[other])
        shown += [other] * _AFTER
    trace = np.zeros((len(shown), 4))
    trace[:, :2] = velocities[shown]
    return Steps(able[own], trace, rows, after)


def response_times(setting: Setting, system: System, seed: int) -> Array:
    """[272] s; NO_RESPONSE where it takes longer."""
    steps = step_traces(setting.character, seed)
    played = system.play([each.trace for each in steps], [seed] * len(steps))
    times = [
        _time(shown.judged.path, each.before, after, _FRAMES_A_ROW * row)
        for each, shown in zip(steps, played)
        for row, after in zip(each.rows, each.after)
    ]
    return np.array(times)


def _time(frames: Array, before: Array, after: Array, at: int) -> float:
    """From frame `at`, the last under the old command, whose velocity was `before`."""
    step = after - before
    for frame in range(at + 1, min(at + round(core.NO_RESPONSE * RATE) + 1, len(frames))):
        way = frames[frame, :2] - frames[frame - _WINDOW + 1, :2]
        velocity = turned(way, -frames[frame - _WINDOW // 2 + 1, 2]) * RATE / (_WINDOW - 1)
        if (velocity - before) @ step >= _DONE * (step @ step):
            return (frame - at) / RATE
    return core.NO_RESPONSE
