# SPDX-License-Identifier: GPL-3.0-or-later
"""An armature's storyboard as a recording."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import bpy
import numpy as np

from ..bake.performing import origin_frame
from ..character.building import check_skeleton, has_character, load, make_player
from ..character.moves import bring_up_to_date
from ..compat.core import core
from ..errors import UserError, core_errors
from ..ground.meshes import find_ground, remarks_of
from ..paths.storyboard import Beat, Played, play
from ..recordings.asked import Asked, StartedMove
from ..recordings.curves import renew_curves
from ..recordings.looks import aim_of
from ..recordings.recordings import POSE_RATE, Recording, add_recording, set_asked, set_shown, set_trace
from ..recordings.styles import StyleChange
from ..rig.motion import Motion
from ..rig.rigs import make_rig

if TYPE_CHECKING:
    from fragmotion_core import Character, Doubles, Performance

NAME = "Storyboard"
"""The recording's, at first."""

_NEAR, _LATE = 0.3, 0.5  # m, s: what is farther off is told


def record(context: bpy.types.Context, obj: bpy.types.Object) -> tuple[Recording, list[str]]:
    """Play the armature's storyboard from its origin on, and keep that as a recording, in the place of the one that
    was made of it before. Returns it, and what could not be done. On a UserError nothing has changed."""
    bring_up_to_date(context, obj)
    character = load(obj)
    check_skeleton(obj, character, make_rig(obj))
    beats = beats_of(context, obj, character)
    start, seed, ground = origin_frame(obj), obj.fragmotion.bake.seed, find_ground(context, obj)
    with core_errors(NAME):
        player = make_player(obj, character, seed)
        player.stand_on(ground)
        player.reset(*start, style=beats[0].style)
        played = play(character, player, beats)
        player.reset(*start, style=beats[0].style)
        shown = player.run(
            played.trace,
            POSE_RATE,
            moves=played.moves or None,
            styles=played.styles or None,
            looks=played.looks or None,
        )
    trace = np.array(played.trace)
    recording = _recording_of(obj, trace)
    recording.seed, recording.policy, recording.start = seed, character.policy, start
    recording.quality = shown.quality
    set_trace(recording, trace)
    set_asked(recording, _asked(played, beats[0].style, character))
    motion = Motion(shown.root_positions, shown.rotations, shown.path, shown.classes)
    set_shown(recording, np.arange(len(motion.path)) / POSE_RATE, motion)
    renew_curves(obj, recording)
    return recording, [*_missed(beats, played, shown), *remarks_of(player, ground)]


def seconds_to(obj: bpy.types.Object, place: Sequence[float]) -> float:
    """How long the armature's character walks to a place from the last one of its storyboard, or from its origin; 0
    where there is no character."""
    if not has_character(obj):
        return 0.0
    former = [beat.place.matrix_world.translation for beat in obj.fragmotion.story if beat.place]
    begin = tuple((former[-1] if former else origin_frame(obj))[:2])
    if math.dist(begin, place[:2]) < _NEAR:
        return 0.0
    return float(core.PathFollower(load(obj).space, core.Path([begin, tuple(place[:2])])).seconds_left)


def _recording_of(obj: bpy.types.Object, trace: Doubles) -> Recording:
    """The recording that was made of the storyboard before, else a new one of this trace; selected."""
    settings = obj.fragmotion
    for index, recording in enumerate(settings.recordings):
        if recording.of_story:
            settings.active_recording = index
            made: Recording = recording
            return made
    recording = add_recording(obj, trace, name=NAME)
    recording.of_story = True
    return recording


def beats_of(context: bpy.types.Context, obj: bpy.types.Object, character: Character) -> list[Beat]:
    """The storyboard's entries; UserError where there are none, on one that is not after the one before, and on styles
    and moves that the character does not have."""
    rows, first = obj.fragmotion.story, obj.fragmotion.bake.frame_start
    if not len(rows):
        raise UserError("The storyboard is empty: press + there, and click where the character is to go")
    beats: list[Beat] = []
    for row in rows:
        former = beats[-1].seconds if beats else 0.0
        seconds = (row.frame - first) * context.scene.render.fps_base / context.scene.render.fps
        if seconds < former or not math.isfinite(seconds):
            raise UserError(
                f"Storyboard entry '{row.name}' is by frame {row.frame}, before the entry above it, or before frame "
                f"{first}, where Bake begins: give it a later frame"
            )
        place = None if row.place is None else tuple(row.place.matrix_world.translation[:2])
        style = _numbered(row, "style", character.style_names, 0)
        beats.append(
            Beat(row.name, seconds, place, style, _numbered(row, "move", character.move_names, -1), aim_of(row.look))
        )
    return beats


def _numbered(row: Any, kind: str, names: Sequence[str], none: int) -> int:
    name = getattr(row, kind)
    if not name:
        return none
    if name not in names:
        there = ", ".join(names) or "none"
        raise UserError(f"Storyboard entry '{row.name}' asks for the {kind} '{name}': the character has {there}")
    return list(names).index(name)


def _asked(played: Played, style: int, character: Character) -> Asked:
    """The same by names."""
    moves = [StartedMove(control, character.move_names[move], held) for control, move, held in played.moves]
    names = list(character.style_names) or [""]
    return Asked(
        moves, names[style], [StyleChange(control, names[changed]) for control, changed in played.styles], played.looks
    )


def _missed(beats: Sequence[Beat], played: Played, shown: Performance) -> list[str]:
    """Where it was late, or not there."""
    told = []
    for beat, reached in zip(beats, played.reached):
        x, y, _ = shown.path[round(reached * POSE_RATE)]
        off = 0.0 if beat.place is None else math.dist((x, y), beat.place)
        if off > _NEAR or reached > beat.seconds + _LATE:
            told.append(
                f"It is {off:.2f} m from '{beat.name}' {reached:.1f} s after the beginning, and was to be there "
                f"after {beat.seconds:.1f} s: give it more time"
            )
    return told
