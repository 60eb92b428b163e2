# SPDX-License-Identifier: MIT
"""All measurements of one run, as the JSON file holds them."""

from __future__ import annotations

import argparse
import math
from typing import Any

import numpy as np

from ..core import core
from ..running import say
from .loading import STEPS_A_SECOND, Recordings, Session, Sessions
from .measures import run_time
from .measures.controllers import (
    CONTROLLERS,
    DEFAULT,
    TABLES,
    factors_of,
    measure_bound,
    measure_quality,
)
from .measures.curves import build, classes_curve, minutes_curve
from .measures.synthesis import measure_synthesis

Result = dict[str, Any]


def measure(recordings: Recordings, sessions: Sessions, options: argparse.Namespace) -> Result:
    """Build a character that learned from the teacher's session, and measure it; says what it is doing."""
    teacher = sessions.train[0]
    say(f"building a character from {len(recordings.clips)} takes, taught by {teacher.name}")
    character = build(recordings, teacher, options.classes, options.seed, [DEFAULT, *TABLES[:-1]], options)
    result = _describe(character, recordings, sessions, options)
    result.update(_measure_controllers(character, sessions, options))
    result.update(measure_likeness(recordings, teacher, options))
    if not options.no_curves:
        result.update(_measure_curves(recordings, sessions, character, options))
    return result


def measure_quickly(recordings: Recordings, sessions: Sessions, options: argparse.Namespace) -> Result:
    """The default policy's run time and the takes' figures alone, where `measure` has them."""
    character = build(recordings, sessions.train[0], options.classes, options.seed, [DEFAULT], options)
    played = run_time.measure_run_time(
        character, [DEFAULT], sessions.test, options.seed, responsiveness=options.responsiveness
    )
    return {
        "default": DEFAULT,
        "seed": options.seed,
        "responsiveness": options.responsiveness,
        "takes": {"count": len(recordings.clips), **run_time.of_takes(character)},
        "controllers": {DEFAULT: {"run_time": _without(played[DEFAULT], "by_trace")}},
        **measure_likeness(recordings, sessions.train[0], options),
    }


def measure_likeness(recordings: Recordings, teacher: Session, options: argparse.Namespace) -> Result:
    """`likeness`: how like the takes a character of half of them looks; nothing, and why, where that cannot be told."""
    try:
        from .likeness.reenacting import Likeness, reenact  # what it computes with need not be there
    except ModuleNotFoundError as error:
        say(f"likeness to the takes: not measured: {error.name} is not installed: python -m pip install scipy")
        return {}
    try:
        likeness = Likeness(recordings)
        character = build(likeness.seen, teacher, options.classes, options.seed, [DEFAULT], options)
    except ValueError as failure:
        say(f"likeness to the takes: not measured: {failure}")
        return {}
    played = reenact(likeness, character, options.seed, responsiveness=options.responsiveness)
    return {"likeness": {"takes": likeness.takes, "played": played}}


def _describe(
    character: core.Character, recordings: Recordings, sessions: Sessions, options: argparse.Namespace
) -> Result:
    return {
        "default": DEFAULT,
        "seed": options.seed,
        "responsiveness": options.responsiveness,
        "takes": {"count": len(recordings.clips), **run_time.of_takes(character)},
        "fragments": len(character.labels),
        "captured": int(character.report["captured"]),
        "classes": len(character.representatives),
        "build_seconds": character.report["seconds"],
        "train": [session.name for session in sessions.train],
        "test": [session.name for session in sessions.test],
        "sessions": {
            kind: {session.name: _describe_session(session) for session in some}
            for kind, some in zip(("train", "test"), sessions)
        },
        "control_space": _describe_space(character.space),
        "coverage": [float(distance) for distance in character.coverage_distances],
        "coverage_counts": [int(count) for count in character.coverage_counts],
    }


def _describe_session(session: Session) -> Result:
    """Controls given, changes of the control a second, and how many different ones were given."""
    changes = np.count_nonzero(np.diff(session.indices))
    return {
        "steps": len(session.indices),
        "changes_a_second": STEPS_A_SECOND * int(changes) / len(session.indices),
        "visited": len(set(session.indices.tolist())),
    }


def _describe_space(space: core.ControlSpace) -> Result:
    """Speeds in m/s, turn rate in degrees/s, and the points."""
    return {
        "walk": space.walk,
        "run": space.run,
        "speeds": space.speeds,
        "gaits": space.gaits,
        "turn_rate": math.degrees(space.turn_rate),
        "scale": space.scale,
        "weights": list(space.weights),
        "points": space.points.tolist(),
    }


def _measure_controllers(character: core.Character, sessions: Sessions, options: argparse.Namespace) -> Result:
    factors = factors_of(character)
    say("synthesis: time and memory of each controller")
    synthesis = measure_synthesis(factors, sessions.train[0], sessions.test[0])
    say("quality: every session learned from against every test")
    quality = measure_quality(factors, sessions)
    say("run time: playing every test")
    played = run_time.measure_run_time(
        character, TABLES, sessions.test, options.seed, responsiveness=options.responsiveness
    )
    return {
        "controllers": {name: _controller(name, quality, synthesis, played) for name in CONTROLLERS},
        "adaptability": {name: _without(quality[name], "by_trace") for name in TABLES},
        "bound": measure_bound(factors, sessions.test),
        "stitchings": run_time.measure_stitchings(character, sessions.test, options.seed),
        "run_time_by_trace": {name: played[name]["by_trace"] for name in TABLES},
    }


def _controller(name: str, quality: Result, synthesis: Result, played: Result) -> Result:
    online = name in played
    return {
        "percent_of_optimal": {key: quality[name][key] for key in ("mean", "sd", "min", "by_trace")},
        **synthesis[name],
        "online": online,
        "run_time": _without(played[name], "by_trace") if online else run_time.no_figures(),
    }


def _without(values: Result, key: str) -> Result:
    return {name: value for name, value in values.items() if name != key}


def _measure_curves(
    recordings: Recordings, sessions: Sessions, character: core.Character, options: argparse.Namespace
) -> Result:
    teacher = sessions.train[0]
    tests: list[Session] = [test for test in sessions.test if test.name != teacher.name] or sessions.test
    say("curves: against classes")
    classes = classes_curve(recordings, teacher, tests, len(character.labels), options)
    say("curves: against minutes of training")
    minutes = minutes_curve(recordings, sessions.test, character.space, options)
    return {"classes_curve": classes, "minutes_curve": minutes}
