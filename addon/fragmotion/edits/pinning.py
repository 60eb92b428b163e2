# SPDX-License-Identifier: GPL-3.0-or-later
"""A recording bent so that its character is at a place, facing some way, at a moment."""

from __future__ import annotations

import math
from collections.abc import Callable
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
    """What was found, and where controls change."""

    pin: Pin
    first: int


def frame_of(place: bpy.types.Object | bpy.types.View3DCursor) -> tuple[float, float, float]:
    """Where a character stands that is at an object or the 3D cursor: x, y and heading, which is its -Y."""
    if isinstance(place, bpy.types.Object):
        return origin_frame(place)
    return place.location.x, place.location.y, place.matrix.to_euler().z + math.pi


def prepare(obj: bpy.types.Object, recording: Recording, goal: Goal) -> Callable[[Report], Pinned]:
    """Read what the search needs; the task that it returns calls nothing of Blender. UserError where there is nothing
    to search."""
    shown = shown_poses(obj, recording)
    if shown is None:
        raise UserError(f"Armature '{obj.name}' has no character yet: press Build first")
    trace, last = trace_of(recording), (len(shown.classes) - 1) / POSE_RATE
    if not 1 / TRACE_RATE < goal.seconds <= last:
        raise UserError(
            f"The playhead is {goal.seconds:.1f} s after the beginning of recording '{recording.name}', which lasts "
            f"{last:.1f} s: move it onto the recording"
        )
    character = load(obj)
    _check_plain(recording, character, goal)
    first = min(max(math.ceil(goal.begin * TRACE_RATE - 1e-6), 0), math.ceil(goal.seconds * TRACE_RATE) - 1)
    played = replay(obj, character, recording, trace, recording.seed)
    target = _seen_by_player(shown, played, first * STEPS, goal.frame)
    policy = recording.policy if recording.policy in character.policies else ""
    options = {**player_options(obj), "seed": recording.seed, "policy": policy}
    options.update({"angle": math.pi} if goal.any_heading else {})
    start = np.array(recording.start)

    def search(report: Report) -> Pinned:
        pin = core.find_pin(
            character, start, trace, goal.seconds, target, begin=first / TRACE_RATE, progress=report, **options
        )
        return Pinned(pin, first)

    return search


def keep_pin(obj: bpy.types.Object, recording: Any, goal: Goal, pinned: Pinned) -> None:
    """Give the recording what was found, what is left spread over the stretch; UserError where it is not reached."""
    pin, first = pinned
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
    end = round(goal.seconds * POSE_RATE)
    heading = shown.path[end][2] if goal.any_heading else goal.frame[2]
    there = core.spread(character.skeleton, as_shown(shown), first * STEPS, end, np.array((*goal.frame[:2], heading)))
    recording.seed = pin.seed
    keep(obj, recording, pin.trace, as_motion(there, shown.classes))
    renew_curves(obj, recording)


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
