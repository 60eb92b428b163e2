# SPDX-License-Identifier: MIT
"""Takes and traces from files to what the core works on."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

from ..building import tell_controls
from ..core import core
from ..files import BY_BLENDER, find_takes
from ..takes import on_one_body, read_mended

SECONDS = 60.0
STEPS_A_SECOND = 10
TEACHER = "explorer"
_TEST_SEEDS = 1000  # how far the seeds of the simulated tests are from those of the training


class Recordings(NamedTuple):
    """Takes on one skeleton."""

    skeleton: core.Skeleton
    clips: list[core.Clip]


class Session(NamedTuple):
    """What one player did with the joystick: controls [T,4], and the indices [T] of the nearest of the 102 points."""

    name: str
    controls: core.Doubles
    indices: core.Ints


class Sessions(NamedTuple):
    """The sessions to learn from, of which the first is the teacher's, and those to test with."""

    train: list[Session]
    test: list[Session]


@contextmanager
def core_failures(place: str = "") -> Iterator[None]:
    """Let the core's ValueError begin with the place."""
    try:
        yield
    except ValueError as error:
        raise ValueError(f"{place}: {error}" if place else str(error)) from error


def read_recordings(paths: Sequence[Path], unit: float | None) -> Recordings:
    """All takes on the first one's body, mended as for a build; ValueError where one has other bones."""
    takes = read_mended(find_takes(paths, BY_BLENDER), unit)
    first = takes[0]
    for each in takes:
        _check_bones(each.path, each.take.skeleton, first.path, first.take.skeleton)
    with core_failures(str(first.path.parent)):
        return Recordings(*on_one_body(takes))


def _check_bones(file: Path, skeleton: core.Skeleton, first_file: Path, first: core.Skeleton) -> None:
    different = set(skeleton.names) ^ set(first.names)
    if different:
        raise ValueError(
            f"{file}: its skeleton is not that of {first_file.name}: bone '{min(different)}' is in one only; "
            "evaluate the takes of one skeleton at a time"
        )


def make_sessions(options: argparse.Namespace, recordings: Recordings) -> Sessions:
    """The traces that the options name, or else the simulated players' with this character's speeds."""
    space = measure_space(recordings, options)
    train = _read_traces(options.train, space) or simulate_players(options.seed, space)
    test = _read_traces(options.test, space) or simulate_players(options.seed + _TEST_SEEDS, space)
    return Sessions(train, test)


def measure_space(recordings: Recordings, told: argparse.Namespace) -> core.ControlSpace:
    """The controls with the takes' own speeds, by the smallest build there is."""
    options = core.BuildOptions()
    options.classes, options.restarts, options.policies = 1, 1, ["greedy"]
    tell_controls(options, told)
    with core_failures("The takes"):
        return core.build(*recordings, [core.simulate_trace(TEACHER, 1)], options).space


def simulate_players(seed: int, space: core.ControlSpace) -> list[Session]:
    """A minute of each simulated player, the teacher's first."""
    names = sorted(core.PLAYERS, key=lambda name: name != TEACHER)
    return [make_session(name, core.simulate_trace(name, SECONDS, seed, space), space) for name in names]


def make_session(name: str, controls: core.Doubles, space: core.ControlSpace) -> Session:
    """A trace with its nearest points."""
    return Session(name, controls, space.nearest(controls))


def _read_traces(paths: Sequence[Path] | None, space: core.ControlSpace) -> list[Session]:
    return [make_session(path.stem, core.read_trace(path), space) for path in paths or []]


def save_sessions(sessions: Sessions, folder: Path) -> None:
    """Write FOLDER/train/NAME.csv and FOLDER/test/NAME.csv, with which the run can be repeated."""
    for kind, some in zip(("train", "test"), sessions):
        (folder / kind).mkdir(parents=True, exist_ok=True)
        for session in some:
            core.write_trace(folder / kind / f"{session.name}.csv", session.controls)
