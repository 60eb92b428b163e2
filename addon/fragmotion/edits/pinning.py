# SPDX-License-Identifier: GPL-3.0-or-later
"""A recording bent so that its character is at places, facing some way, at moments."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import bpy
import numpy as np

from ..bake.performing import origin_frame
from ..character.building import load, player_options
from ..compat.core import core
from ..errors import UserError
from ..jobs import Report
from ..recordings.curves import renew_curves
from ..recordings.recordings import POSE_RATE, TRACE_RATE, Recording, asked_between, trace_of
from .replaying import STEPS, as_motion, as_shown, from_then_on, keep, replay, shown_poses

if TYPE_CHECKING:
    from fragmotion_core import Character, Doubles, Pin

    from ..rig.motion import Motion


class Goal(NamedTuple):
    """The character frame to be in, `seconds` after the recording's beginning, with its heading or with any; controls
    before `begin` (s) stay."""

    seconds: float
    begin: float
    frame: tuple[float, float, float]
    any_heading: bool = False


class Pinned(NamedTuple):
    """What was found for each goal, in their order, and where controls change."""

    pins: list[Pin]
    first: int

    @property
    def fits(self) -> bool:
        """Whether all are reached."""
        return all(pin.fits for pin in self.pins)


def frame_of(place: bpy.types.Object | bpy.types.View3DCursor) -> tuple[float, float, float]:
    """Where a character stands that is at an object or the 3D cursor: x, y and heading, which is its -Y."""
    if isinstance(place, bpy.types.Object):
        return origin_frame(place)
    return place.location.x, place.location.y, place.matrix.to_euler().z + math.pi


def prepare(obj: bpy.types.Object, recording: Recording, goals: Sequence[Goal]) -> Callable[[Report], Pinned]:
    """Read what the search needs, for goals one after another, of which each changes what comes after the one before;
    the task that it returns calls nothing of Blender. UserError where there is nothing to search."""
    shown = shown_poses(obj, recording)
    if shown is None:
        raise UserError(f"Armature '{obj.name}' has no character yet: press Build first")
    trace, last = trace_of(recording), (len(shown.classes) - 1) / POSE_RATE
    for goal in goals:
        if not 1 / TRACE_RATE < goal.seconds <= last:
            raise UserError(
                f"The pin is {goal.seconds:.1f} s after the beginning of recording '{recording.name}', which lasts "
                f"{last:.1f} s: move it, or the playhead, onto the recording"
            )
    character = load(obj)
    _check_plain(recording, character, goals[-1])
    first = _begins(goals[0])
    played = replay(obj, character, recording, trace, recording.seed)
    targets = [_seen_by_player(shown, played, first * STEPS, goal.frame) for goal in goals]
    policy = recording.policy if recording.policy in character.policies else ""
    options, start, seed = {**player_options(obj), "policy": policy}, np.array(recording.start), recording.seed

    def search(report: Report) -> Pinned:
        bent, drawn, pins = trace, seed, []
        for number, (goal, target) in enumerate(zip(goals, targets)):
            pin = core.find_pin(
                character,
                start,
                bent,
                goal.seconds,
                target,
                seed=drawn,
                begin=_begins(goal) / TRACE_RATE,
                progress=_share(report, number, len(goals)),
                **options,
                **({"angle": math.pi} if goal.any_heading else {}),
            )
            pins.append(pin)
            if not pin.fits:
                break
            bent, drawn = pin.trace, pin.seed
        return Pinned(pins, first)

    return search


def keep_pins(obj: bpy.types.Object, recording: Any, goals: Sequence[Goal], pinned: Pinned) -> None:
    """Give the recording what was found, what is left spread over the stretches; UserError where one is not reached."""
    pins, first = pinned
    pin, goal = pins[-1], goals[len(pins) - 1]
    if not pin.fits:
        easier = "" if goal.any_heading else ", let it face anywhere (Any Heading)"
        raise UserError(
            f"The pin is {say_off(goal, pin.asked, pin.asked_angle)} from where recording '{recording.name}' leads; "
            f"the nearest that {pin.tries} tries found is {say_off(goal, pin.distance, pin.angle)} from it. Move it "
            f"nearer{easier}, or let the change begin earlier"
        )
    character = load(obj)
    shown = shown_poses(obj, recording)
    assert shown is not None
    again = replay(obj, character, recording, pin.trace, pin.seed)
    shown = from_then_on(character, shown, again, first)
    for each in goals:
        end = round(each.seconds * POSE_RATE)
        heading = shown.path[end][2] if each.any_heading else each.frame[2]
        target = np.array((*each.frame[:2], heading))
        there = core.spread(character.skeleton, as_shown(shown), _begins(each) * STEPS, end, target)
        shown = as_motion(there, shown.classes)
    recording.seed = pin.seed
    keep(obj, recording, pin.trace, shown)
    renew_curves(obj, recording)


def _begins(goal: Goal) -> int:
    """The first control that may change for a goal."""
    return min(max(math.ceil(goal.begin * TRACE_RATE - 1e-6), 0), math.ceil(goal.seconds * TRACE_RATE) - 1)


def _share(report: Report, number: int, count: int) -> Report:
    return lambda fraction, stage: report((number + fraction) / count, stage)


def say_off(goal: Goal, distance: float, angle: float) -> str:
    """How far from the goal that is, in words."""
    return f"{distance:.2f} m" + ("" if goal.any_heading else f" and {math.degrees(angle):.0f} degrees")


def _check_plain(recording: Recording, character: Character, goal: Goal) -> None:
    """UserError where the recording does what the search does not play: it tries controls alone."""
    asked = asked_between(recording, 0, math.ceil(goal.seconds * TRACE_RATE))
    legs = {move.name for move in character.moves if not move.upper_body}
    moves = [move for move in asked.moves if move.name in legs]
    bars = [
        *(f"starts the move '{move.name}' {move.control / TRACE_RATE:.1f} s" for move in moves),
        *(f"changes to style '{change.name}' {change.control / TRACE_RATE:.1f} s" for change in asked.styles),
        *([f"begins in style '{asked.style}' 0 s"] if asked.style not in ("", *character.style_names[:1]) else []),
    ]
    if bars:
        raise UserError(
            f"Recording '{recording.name}' {bars[0]} after its beginning, and a pin bends what comes before nothing of "
            "that kind alone: move the playhead before it, or trim it off"
        )


def _seen_by_player(shown: Motion, played: Motion, frame: int, goal: tuple[float, float, float]) -> Doubles:
    """The goal as the player sees it, whom a recording that was cut or glued shows elsewhere."""
    (x, y, heading), (at_x, at_y, facing) = shown.path[frame], played.path[frame]
    turn = facing - heading
    cos, sin = math.cos(turn), math.sin(turn)
    across, along = goal[0] - x, goal[1] - y
    return np.array((at_x + cos * across - sin * along, at_y + sin * across + cos * along, goal[2] + turn))
