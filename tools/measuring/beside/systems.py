# SPDX-License-Identifier: MIT
"""The two methods as players of traces, who show poses and tell where in the takes these are from."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import NamedTuple, Protocol

import fragmotion_core as core
import numpy as np
from fragmotion_command.evaluate.rotations import Array

from tools.measuring.beside.setting import Setting, frame_controls
from tools.measuring.peers.kinematics.bodies import RATE, Motion
from tools.measuring.peers.motion_matching.constants import Constants
from tools.measuring.peers.motion_matching.matcher import Matcher

_BEGINNINGS = (0.0, 0.01, 0.03)  # shares of the database's frames, the slowest first, to begin with


class Shown(NamedTuple):
    """What a system showed under a trace."""

    motion: Motion
    judged: core.Performance
    take: Array  # [F] number of the take that plays
    at: Array  # [F] s of it


class System(Protocol):
    """What plays."""

    seconds: float
    """Of the processor, in all that was played."""
    frames: int
    """That were played."""

    def play(self, traces: Sequence[Array], seeds: Sequence[int]) -> list[Shown]:
        """Play traces [T,4], each from the beginning and with a seed."""


def _judged(setting: Setting, motion: Motion, trace: Array, entered: Array) -> core.Performance:
    return core.judge_clip(setting.character, trace, setting.body.clip(motion), entered.tolist())


class Fragments:
    """Fragmotion."""

    def __init__(self, setting: Setting, responsiveness: float = 0.5) -> None:
        self.seconds, self.frames = 0.0, 0
        self._setting, self._responsiveness = setting, responsiveness
        character = setting.character
        self._begin, self._clip = character.fragment_ranges[:, 0], character.fragment_clips

    def play(self, traces: Sequence[Array], seeds: Sequence[int]) -> list[Shown]:
        """As System."""
        return [self._played(trace, seed) for trace, seed in zip(traces, seeds)]

    def _played(self, trace: Array, seed: int) -> Shown:
        player = core.Player(self._setting.character, seed + 1, responsiveness=self._responsiveness)
        began = time.process_time()
        played = player.run(trace, RATE)
        self.seconds += time.process_time() - began
        self.frames += len(played.entered)
        motion = Motion("ours", played.root_positions, played.rotations[:, self._setting.body.bones])
        frames = np.arange(len(played.entered))
        begun = np.maximum.accumulate(np.where(np.diff(played.entered, prepend=-1) != 0, frames, 0))
        at = self._begin[played.fragments] + (frames - begun) / RATE
        return Shown(motion, _judged(self._setting, motion, trace, played.entered), self._clip[played.fragments], at)


class Matching:
    """Motion matching."""

    def __init__(self, setting: Setting, matcher: Matcher) -> None:
        self.seconds, self.frames, self.search_seconds = 0.0, 0, 0.0
        self.matcher = matcher
        self._setting = setting

    def play(self, traces: Sequence[Array], seeds: Sequence[int]) -> list[Shown]:
        """As System; seeds choose where to begin, and shorter traces are held at their ends while the others play."""
        longest = max(len(trace) for trace in traces)
        held = [np.concatenate((trace, np.repeat(trace[-1:], longest - len(trace), 0))) for trace in traces]
        controls = np.stack([frame_controls(trace)[:, :3] for trace in held])
        controls[:, :, 2] *= self._setting.space.turn_rate
        begin = [self.matcher.still(rank) for rank in _BEGINNINGS]
        shown = self.matcher.play(controls, [begin[seed % len(begin)] for seed in seeds])
        self.seconds, self.search_seconds = self.seconds + shown.seconds, self.search_seconds + shown.search_seconds
        self.frames += shown.entered.size
        return [self._of(trace, *parts) for trace, *parts in zip(traces, *shown[:4])]

    def _of(self, trace: Array, root: Array, rotations: Array, entered: Array, playing: Array) -> Shown:
        count = len(frame_controls(trace))
        motion, library = Motion("matching", root[:count], rotations[:count]), self.matcher.material.library
        at = (playing - library.first[playing])[:count] / RATE
        judged = _judged(self._setting, motion, trace, entered[:count])
        return Shown(motion, judged, library.take[playing[:count]], at)


def matching(setting: Setting, constants: Constants, filled: bool) -> Matching:
    """Motion matching with these constants, its gaps filled or not."""
    return Matching(setting, Matcher(setting.material(filled), constants))
