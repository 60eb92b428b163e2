# SPDX-License-Identifier: GPL-3.0-or-later
"""A recording played again from a change on: what was shown before it stays, to the bit."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import bpy
import numpy as np

from ..bake.performing import measure_quality, perform
from ..character.building import has_character, load, make_player
from ..compat.core import core
from ..errors import UserError, core_errors
from ..ground.meshes import find_ground
from ..recordings.asked import Asked
from ..recordings.recordings import (
    POSE_RATE,
    TRACE_RATE,
    Recording,
    asked_of,
    set_asked,
    set_shown,
    set_trace,
    shown_of,
    trace_of,
)
from ..rig.motion import Motion, resampled

if TYPE_CHECKING:
    from fragmotion_core import Character, Doubles
    from fragmotion_core import Motion as CoreMotion

STEPS = POSE_RATE // TRACE_RATE
"""Poses that are shown for a control."""

_OFF = 0.05  # of the time between two poses
_UNIT = 1e-3  # by which a unit quaternion's length is off at most


def replay(obj: bpy.types.Object, character: Character, recording: Recording, trace: Doubles, seed: int) -> Motion:
    """What a drive by a trace [T,4] shows, from where the recording begins, with its policy, on the ground that the
    armature is set to: 6 T + 1 poses."""
    policy = recording.policy if recording.policy in character.policies else ""
    with core_errors(f"Recording '{recording.name}'"):
        player = make_player(obj, character, seed, policy)
        player.stand_on(find_ground(bpy.context, obj))
        played = perform(player, character, recording, trace, POSE_RATE, recording.start)
    return Motion(played.root_positions, played.rotations, played.path, played.classes)


def shown_poses(obj: bpy.types.Object, recording: Recording) -> Motion | None:
    """What was shown while it was recorded, POSE_RATE poses a second, or what its replay shows; None where the armature
    has no character of these bones to play it."""
    shown = shown_of(recording)
    if not has_character(obj):
        if shown is not None:
            raise UserError(
                f"Armature '{obj.name}' has no character to play '{recording.name}' again: press Build first"
            )
        return None
    character = load(obj)
    if shown is None or recording.shown_bones != len(character.skeleton.names):
        return replay(obj, character, recording, trace_of(recording), recording.seed)
    times, motion = shown
    due = np.arange(len(times)) / POSE_RATE
    return motion if np.abs(times - due).max() < _OFF / POSE_RATE else resampled(times, motion, POSE_RATE)


def play_again(
    obj: bpy.types.Object, recording: Recording, trace: Doubles, first: int, asked: Asked | None = None
) -> None:
    """Give the recording another trace of the same length and, if told, ask for other things beside it. Both are its
    own before control `first`, from which it is played. Where that fails nothing has changed."""
    shown, own = shown_poses(obj, recording), asked_of(recording)
    set_asked(recording, own if asked is None else asked)
    try:
        if shown is not None:
            character = load(obj)
            shown = from_then_on(character, shown, replay(obj, character, recording, trace, recording.seed), first)
        keep(obj, recording, trace, shown)
    except BaseException:
        set_asked(recording, own)
        raise


def keep(obj: bpy.types.Object, recording: Any, trace: Doubles, shown: Motion | None) -> None:
    """Give the recording what it has become, and its quality."""
    set_trace(recording, trace)
    if shown is not None:
        set_shown(recording, np.arange(len(shown.classes)) / POSE_RATE, shown)
    recording.quality = measure_quality(obj, recording)


def from_then_on(character: Character, shown: Motion, again: Motion, first: int) -> Motion:
    """What was shown until control `first`, to the bit, and then another motion of the same time."""
    return joined(character, shown, first * STEPS, again, first * STEPS)


def joined(character: Character, first: Motion, end: int, second: Motion, beginning: int) -> Motion:
    """The first motion to the bit until its pose `end`, and then the second from its pose `beginning` on."""
    with core_errors("Joining"):
        both = core.join(character.skeleton, as_shown(first), end, as_shown(second), beginning)
    return as_motion(both, np.concatenate((first.classes[: end + 1], second.classes[beginning + 1 :])))


def as_shown(motion: Motion) -> CoreMotion:
    """A motion of POSE_RATE poses a second as the core takes it."""
    lengths = np.linalg.norm(motion.rotations, axis=-1, keepdims=True)
    rotations = np.where(np.abs(lengths - 1) < _UNIT, motion.rotations, motion.rotations / lengths)
    shown: CoreMotion = core.Motion(POSE_RATE, motion.root_positions, rotations, motion.path)
    return shown


def as_motion(shown: CoreMotion, classes: Any) -> Motion:
    """The same as the add-on keeps it."""
    return Motion(shown.root_positions, shown.rotations, shown.path, classes)
