# SPDX-License-Identifier: MIT
"""What is measured of either method: by the core, wherever it has the measure, and by what this file adds."""

from __future__ import annotations

import math
import statistics
from collections import Counter
from collections.abc import Mapping, Sequence

import fragmotion_core as core
import numpy as np
from fragmotion_command.evaluate.measures import run_time
from fragmotion_command.evaluate.rotations import Array, turned
from scipy.signal import savgol_filter

from tools.measuring.beside.motion import footfalls
from tools.measuring.beside.motion.likeness import REACH, Likeness
from tools.measuring.beside.setting import Setting, frame_controls
from tools.measuring.beside.systems import Shown, System
from tools.measuring.peers.kinematics.bodies import RATE, Body, Motion
from tools.measuring.peers.motion_matching.gaps import PERFORMED

Figures = dict[str, float]
SEEDS = range(3)
_HELD, _CHANGE = 1.0, 0.25  # s, and m/s or a quarter of the turn rate: a control that is held
_AROUND = round(0.5 * RATE) + 1  # frames over which speeds are measured
_SPAN = round(2 * RATE)  # frames in which the heading drifts
_PARABOLA = 13  # frames
_BIN = 0.1  # s of a take by which its use is counted


def measure(
    setting: Setting, system: System, traces: Mapping[str, Array], likeness: Likeness, seeds: Sequence[int]
) -> Figures:
    """All figures of a system but the time that it takes to answer: of each trace played with each seed."""
    asked = list(traces.values()) * len(seeds)
    every = system.play(asked, np.repeat(seeds, len(traces)).tolist())
    played = list(zip(every, asked))
    measured = [setting.metrics.of(shown.judged) for shown in every]
    errors = run_time.errors([[shown.judged for shown in every]])
    figures = {
        **{name: float(errors[name] or 0) for name in ("velocity_error_percent", "turn_error", "drift_percent")},
        "velocity_error_held_percent": held_error(played),
        "drift_heading": statistics.fmean(_drift_heading(*each, setting.space) for each in played),
        **_looks(setting, measured),
        **bodies(setting.body, [shown.motion for shown in every]),
        **footfalls.figures(setting.body, setting.takes.captured, [s.motion for s in every], measured),
        "unlikeness": unlikeness(setting, likeness, played),
        "variety_seconds": statistics.fmean(variety(some) for some in _split(every, len(seeds))),
        "microseconds_a_frame": 1e6 * system.seconds / system.frames,
    }
    return {**figures, **_limited([shown.judged for shown in every])}


def _split(shown: Sequence[Shown], parts: int) -> list[Sequence[Shown]]:
    size = len(shown) // parts
    return [shown[i * size : (i + 1) * size] for i in range(parts)]


def takes_figures(setting: Setting) -> Figures:
    """The takes' own, as far as they have any."""
    takes = setting.takes.captured
    return {
        **_looks(setting, [setting.metrics.takes]),
        **bodies(setting.body, takes),
        **footfalls.figures(setting.body, takes, takes, [setting.metrics.takes]),
        "unlikeness": 1.0,
        "takes_seconds": sum(len(motion.root) for motion in takes) / RATE,
    }


def _looks(setting: Setting, measured: Sequence[core.MotionMeasures]) -> Figures:
    skate = statistics.fmean(each.foot_skate for each in measured)
    return {
        "foot_skate_ratio": skate / max(setting.metrics.takes.foot_skate, 1e-9),
        "hips_acceleration_p99": statistics.fmean(each.hips.p99 for each in measured),
        "hips_acceleration_max": max(each.hips.worst for each in measured),
        "velocity_step_p99": statistics.fmean(each.velocities.p99 for each in measured),
    }


def bodies(body: Body, motions: Sequence[Motion]) -> Figures:
    """The 99th percentile of the hips' acceleration along the ground, m/s^2 of a character of 1.8 m: of the parabola
    that fits the fifth of a second around best."""
    long = [motion.root[:, :2] for motion in motions if len(motion.root) >= _PARABOLA]
    pushed = [savgol_filter(path, _PARABOLA, 2, deriv=2, delta=1 / RATE, axis=0) for path in long]
    sizes = np.concatenate([np.linalg.norm(push, axis=1) for push in pushed]) * body.scale
    return {"hips_curve_p99": float(np.quantile(sizes, 0.99))}


def held_error(played: Sequence[tuple[Shown, Array]]) -> float:
    """The velocity error, percent of the commanded speed, over the frames in which the control has been held for a
    second."""
    error = commanded = 0.0
    for shown, trace in played:
        controls, held = frame_controls(trace), _held(frame_controls(trace))
        error += float(np.linalg.norm(_velocities(shown.judged) - controls[:, :2], axis=1)[held].sum())
        commanded += float(np.linalg.norm(controls[:, :2], axis=1)[held].sum())
    return 100 * error / commanded if commanded > 0 else 0.0


def _held(controls: Array) -> Array:
    second = round(_HELD * RATE)
    changed = np.zeros(len(controls))
    for back in range(1, second + 1):
        step = controls[back:] - controls[:-back]
        size = np.maximum(np.linalg.norm(step[:, :2], axis=1), np.abs(step[:, 2]))
        changed[back:] = np.maximum(changed[back:], size)
    held: Array = (changed < _CHANGE) & (np.arange(len(controls)) > second)
    return held


def _velocities(judged: core.Performance) -> Array:
    """[F,2] m/s, over the half second around, as the character frame sees them: as the core's velocity error has it."""
    slopes = savgol_filter(judged.path[:, :2], _AROUND, 1, deriv=1, delta=1 / RATE, axis=0)
    return turned(slopes, -judged.path[:, 2])


def _drift_heading(shown: Shown, trace: Array, space: core.ControlSpace) -> float:
    """How far the heading gets in two seconds from that which was commanded, degrees: mean over all such spans."""
    told: float | None = getattr(shown.judged, "drift_heading", None)
    if told is not None:
        return math.degrees(told)
    turns = frame_controls(trace)[1:, 2] * space.turn_rate / RATE
    off = shown.judged.path[:, 2] - np.concatenate(([0.0], np.cumsum(turns)))
    return float(np.degrees(np.abs(off[_SPAN:] - off[:-_SPAN]).mean()))


def _limited(judged: Sequence[core.Performance]) -> Figures:
    """Errors against the command as a body can follow it, where the core measures them."""
    if not hasattr(judged[0], "velocity_error_limited"):
        return {}
    speed = statistics.fmean(each.commanded_speed for each in judged)
    mean = {
        name: statistics.fmean(getattr(each, name) for each in judged)
        for name in ("velocity_error_limited", "drift_limited", "drift_heading_limited")
    }
    return {
        "velocity_error_limited_percent": 100 * mean["velocity_error_limited"] / speed,
        "drift_limited_percent": 100 * mean["drift_limited"] / speed,
        "drift_heading_limited": math.degrees(mean["drift_heading_limited"]),
    }


def unlikeness(setting: Setting, likeness: Likeness, played: Sequence[tuple[Shown, Array]]) -> float:
    """The mean distance from the takes, over the takes' own from each other, of the windows in which the takes perform
    all that is asked."""
    far = []
    for shown, trace in played:
        distances, first = likeness.of(shown.motion)
        known = setting.plain.coverage_distances[setting.space.nearest(trace)] <= PERFORMED
        asked = frame_controls(known[:, None].astype(float))[:, 0]
        all_known = np.convolve(asked, np.ones(REACH + 1), "valid")[first] > REACH + 0.5
        far.append(distances[all_known])
    distances = np.concatenate(far)
    return float(distances.mean() / likeness.takes) if len(distances) else math.nan


def variety(shown: Sequence[Shown]) -> float:
    """How many seconds of takes are shown, each as much as any other, to be as varied as this: the exponential of the
    entropy of the tenths of seconds that play."""
    counts: Counter[tuple[int, int]] = Counter()
    for each in shown:
        counts.update(zip(each.take.tolist(), (each.at / _BIN + 1e-9).astype(int).tolist()))
    share = np.array(list(counts.values()), float) / sum(counts.values())
    return float(np.exp(-(share * np.log(share)).sum()) * _BIN)
