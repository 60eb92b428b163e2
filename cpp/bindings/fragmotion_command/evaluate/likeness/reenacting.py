# SPDX-License-Identifier: MIT
"""Half of the takes, which a character is made of, and the other half's own velocity and turn, which it then re-enacts.
What it shows is compared with the takes that it never saw."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple, Optional

import numpy as np
from scipy.signal import savgol_filter

from ...core import core
from ..loading import Recordings
from ..measures.weight import ratio
from ..rotations import Array, turned
from . import motion, windows
from .poses import RATE, Body, Poses, body_of, heading, poses_of
from .telling import told_apart
from .windows import Span

Figures = dict[str, Optional[float]]
OF_THE_TAKES = ("head_jerk", "hands_jerk", "stances", "steps", "sway", "ripple")
"""Figures that are told over the takes' own."""
_FRAMES_A_ROW = 6  # of a trace
_SESSIONS = 8
_SETTLING, _LAST = 60, 6  # frames that do not count where a take begins and where it ends
_SHORTEST = 2.2  # s of a take that is re-enacted
_LEAST = 0.5  # s of one whose turns count
_AROUND = 31  # frames over which velocities are told
_SPLIT = 0  # seed by which the takes are halved
_JOINS = 0.06  # s between a fragment's end and the beginning of the one that goes on in its take


class _Part(NamedTuple):
    """Takes and their mirror images, and the spans of them that count."""

    poses: list[Poses]
    spans: list[list[Span]]


class Likeness:
    """Compares what is played with takes. ValueError where there are too few or a bone that is looked at is missing."""

    seen: Recordings
    """What the character is to be made of."""
    takes: Figures
    """The figures of unseen takes, by those that a character is made of."""

    def __init__(self, recordings: Recordings) -> None:
        self._body = body_of(recordings.skeleton)
        order = np.random.default_rng(_SPLIT).permutation(len(recordings.clips))
        clips = core.on_one_floor(recordings.skeleton, recordings.clips)
        halves = [[clips[i] for i in sorted(half)] for half in np.array_split(order, 2)]
        self.seen = Recordings(recordings.skeleton, halves[0])
        own, self._unseen = (_part(self._body, half) for half in halves)
        if not own.poses or not self._unseen.poses:
            raise ValueError(f"that takes two halves of takes that are longer than {_SHORTEST:g} s")
        self._floor = motion.floor_of(self._body, own.poses)
        self._fastest = motion.fastest_turns(_all_poses(self._body, clips))
        self._own, unseen = _windows(self._body, own), _windows(self._body, self._unseen)
        known = np.concatenate(self._own)
        self._mean = known.mean(0)
        self._axes = windows.principal_axes(np.concatenate([known, *unseen]), self._mean)
        self._own, self._theirs = self._reduced(self._own), self._reduced(unseen)
        self._seen_in_takes = motion.seen_in(self._body, *self._unseen, self._floor)
        self._nearest_takes = self._nearest(self._theirs)
        itself = {**dict.fromkeys(OF_THE_TAKES, 1.0), "nearest": 1.0, "whips": 0.0}
        self.takes = {**_known({**self._seen_in_takes, **self._compared(self._own)}), **itself}

    def traces(self, space: core.ControlSpace) -> list[Array]:
        """[T,4] each: sessions of unseen takes, one after the other."""
        controls = [_controls(self._body, poses.raw, space.turn_rate) for poses in self._unseen.poses]
        return [np.concatenate([controls[i] for i in session]) for session in self._sessions()]

    def of(self, played: Sequence[core.Clip]) -> Figures:
        """The figures of what was shown under each of the traces."""
        poses = [poses_of(self._body, clip) for clip in played]
        spans = [self._spans(session, len(each.heads)) for session, each in zip(self._sessions(), poses)]
        shown = _Part(poses, spans)
        reduced = self._reduced(_windows(self._body, shown))
        seen = motion.seen_in(self._body, *shown, self._floor)
        figures: Figures = {
            **self._compared(reduced),
            "nearest": ratio(self._nearest(reduced), self._nearest_takes),
            **seen,
            **{name: ratio(seen[name], self._seen_in_takes[name]) for name in OF_THE_TAKES},
            "whips": motion.whips(shown.poses, self._fastest),
        }
        return _known(figures)

    def _compared(self, reduced: list[Array]) -> Figures:
        far = windows.frechet(np.concatenate(reduced), np.concatenate(self._theirs))
        return {"frechet": far, "auc": told_apart(reduced, self._theirs)}

    def _nearest(self, reduced: list[Array]) -> float:
        return windows.nearest(np.concatenate(reduced)[::2], np.concatenate(self._own))

    def _reduced(self, values: Sequence[Array]) -> list[Array]:
        return [(each - self._mean) @ self._axes for each in values]

    def _sessions(self) -> list[list[int]]:
        """Numbers of unseen takes."""
        takes = range(len(self._unseen.poses))
        return [list(takes[i::_SESSIONS]) for i in range(min(_SESSIONS, len(takes)))]

    def _spans(self, session: Sequence[int], frames: int) -> list[Span]:
        rows = [len(_rows(len(self._unseen.poses[take].heads))) for take in session]
        ends = _FRAMES_A_ROW * np.cumsum(rows)
        return [
            (int(end) - _FRAMES_A_ROW * count + _SETTLING, min(int(end), frames) - _LAST)
            for end, count in zip(ends, rows)
        ]


def _known(figures: Figures) -> Figures:
    """None in place of what is not a number: of steps where there are none."""
    return {name: None if each is None or not math.isfinite(each) else each for name, each in figures.items()}


def _part(body: Body, clips: Sequence[core.Clip]) -> _Part:
    long = [clip for clip in clips if len(clip.root_positions) > _SHORTEST * clip.rate]
    poses = [poses_of(body, clip) for clip in [*long, *core.mirrored(body.skeleton, long)]]
    return _Part(poses, [[(_SETTLING, len(each.heads) - _LAST)] for each in poses])


def _all_poses(body: Body, clips: Sequence[core.Clip]) -> list[Poses]:
    """Of takes, however short, and of their mirror images."""
    some = [clip for clip in clips if len(clip.root_positions) > _LEAST * clip.rate]
    return [poses_of(body, clip) for clip in [*some, *core.mirrored(body.skeleton, some)]]


def _windows(body: Body, part: _Part) -> list[Array]:
    return [windows.windows(body, poses.heads, spans) for poses, spans in zip(*part)]


def _rows(frames: int) -> range:
    """The frames of a take whose velocities are a trace's rows."""
    return range(_FRAMES_A_ROW // 2, frames, _FRAMES_A_ROW)


def _controls(body: Body, places: Array, turn_rate: float) -> Array:
    """[T,4]: a take's own velocity and turn, as its smoothed heading sees them: without the hips' sway in a step."""
    rows = list(_rows(len(places)))
    facing = _line(heading(body, places), 0)
    velocity = turned(_line(places[:, body.hips, :2], 1), -facing)[rows]
    return np.column_stack([velocity, _line(facing, 1)[rows] / turn_rate, np.zeros(len(rows))])


def _line(values: Array, derivative: int) -> Array:
    """The line that fits half a second around each frame best: its value there, or its slope a second."""
    fitted: Array = savgol_filter(values, _AROUND, 1, deriv=derivative, delta=1 / RATE, axis=0)
    return fitted


def stays(character: core.Character, performances: Sequence[core.Performance]) -> float | None:
    """The share of stitches that go on in the same take; None where there is none."""
    begin, end = character.fragment_ranges.T
    source = np.array([character.fragment_clips, np.unique(character.fragment_origins, return_inverse=True)[1]])
    stitches = stay = 0
    for played in performances:
        new = np.flatnonzero(np.diff(played.entered)) + 1
        before, after = played.fragments[new - 1], played.fragments[new]
        same = (source[:, before] == source[:, after]).all(0) & (np.abs(begin[after] - end[before]) < _JOINS)
        stitches, stay = stitches + len(new), stay + int(same.sum())
    return ratio(stay, stitches)


def reenact(likeness: Likeness, character: core.Character, seed: int, **options: Any) -> Figures:
    """The figures of a character that was made of `likeness.seen`; `options` are the player's."""
    traces = likeness.traces(character.space)
    played = [core.Player(character, seed + i, **options).run(trace, RATE) for i, trace in enumerate(traces)]
    clips = [core.Clip(character.skeleton, "played", RATE, p.root_positions, p.rotations) for p in played]
    return {**likeness.of(clips), "successors": stays(character, played)}
