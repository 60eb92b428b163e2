# SPDX-License-Identifier: MIT
"""Takes, what each of the two methods makes of them, and the sessions that both play."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import fragmotion_core as core
import numpy as np
from fragmotion_command.evaluate.loading import TEACHER, Recordings, Session, core_failures, make_session
from fragmotion_command.evaluate.measures import curves
from fragmotion_command.evaluate.measures.controllers import DEFAULT
from fragmotion_command.evaluate.rotations import Array

from tools.measuring.peers.kinematics.bodies import RATE, Body, Motion, body_of, motion_of
from tools.measuring.peers.kinematics.legs import knee_hinges
from tools.measuring.peers.motion_matching import gaps
from tools.measuring.peers.motion_matching.matcher import Material, material_of

SECONDS = 60.0
CLASSES = 97
_SHORTEST = 0.5  # s of a take that motion matching is given
_STEPS_A_SECOND = 10


class Takes(NamedTuple):
    """The takes and their mirror images as motions, in the same order."""

    captured: list[Motion]
    mirrored: list[Motion]


@dataclass(frozen=True)
class Setting:
    """What the comparison is made with."""

    body: Body
    takes: Takes
    character: core.Character
    plain: core.Character  # of the captured fragments and their mirror images alone
    metrics: core.MotionMetrics
    made: list[Motion]  # for the controls that the takes lack

    @property
    def space(self) -> core.ControlSpace:
        """The controls."""
        return self.character.space

    def material(self, filled: bool) -> Material:
        """What motion matching plays."""
        return material_of(self.body, [*self.takes.captured, *self.takes.mirrored], self.made if filled else ())


def make_setting(recordings: Recordings, seed: int, seconds: float = SECONDS, classes: int = CLASSES) -> Setting:
    """Build all that is compared; the explorer's session of so many seconds teaches. Failure where the takes lack what
    either method needs."""
    body = body_of(recordings.skeleton)
    with core_failures("The takes"):
        images = core.mirrored(recordings.skeleton, recordings.clips)
    long = [i for i, clip in enumerate(recordings.clips) if len(clip.root_positions) > _SHORTEST * clip.rate]
    takes = Takes(*([motion_of(body, clips[i]) for i in long] for clips in (recordings.clips, images)))
    teacher = make_session(TEACHER, core.simulate_trace(TEACHER, seconds, seed), core.ControlSpace())
    character = curves.build(recordings, teacher, classes, seed, [DEFAULT])
    plain = _built_plainly(recordings, teacher, seed)
    hinges = knee_hinges(body, takes.captured)
    made = gaps.fill(body, takes.captured, character.space, plain.coverage_distances, hinges)
    return Setting(body, takes, character, plain, core.MotionMetrics(character), made)


def _built_plainly(recordings: Recordings, teacher: Session, seed: int) -> core.Character:
    """Only its coverage counts, so a class will do."""
    options = core.BuildOptions()
    options.synthesize, options.classes, options.restarts, options.seed = False, 1, 1, seed
    options.policies = ["greedy"]
    with core_failures("The takes"):
        return core.build(*recordings, [teacher.controls], options)


def sessions(space: core.ControlSpace, seed: int, names: Sequence[str], seconds: float = SECONDS) -> dict[str, Array]:
    """Traces [T,4] of simulated players who do not jump."""
    traces = {name: np.array(core.simulate_trace(name, seconds, seed, space)) for name in names}
    for trace in traces.values():
        trace[:, 3] = 0
    return traces


def frame_controls(trace: Array) -> Array:
    """[F,4]: the control that leads to each frame at RATE of a performance of a trace, as the core's player has it."""
    frames = round(len(trace) / _STEPS_A_SECOND * RATE) + 1
    seconds = np.maximum(0, (np.arange(frames) - 1) / RATE)
    controls: Array = trace[np.minimum((seconds * _STEPS_A_SECOND + 1e-9).astype(int), len(trace) - 1)]
    return controls
