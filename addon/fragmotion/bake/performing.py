# SPDX-License-Identifier: GPL-3.0-or-later
"""A trace played by the armature's character: what a bake writes and a recording is judged by."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import bpy
import numpy as np
from mathutils import Vector

from ..character.building import has_character, load, make_player
from ..errors import UserError, core_errors
from ..ground.meshes import Ground, remarks_of
from ..jobs import Report
from ..mocap.sampling import scene_rate
from ..recordings.holding import reaches_now
from ..recordings.looks import AS_CAPTURED, LookChange, aim_of
from ..recordings.reaches import ReachChange
from ..recordings.recordings import (
    Recording,
    active_recording,
    looks_of,
    moves_of,
    numbered_moves,
    numbered_styles,
    reaches_of,
    shown_of,
    trace_of,
)
from ..recordings.styles import AS_EVER, Styled
from ..recordings.traces import asked_beside, make_trace
from ..rig.motion import Motion, resampled
from ..settings.bake_fields import DRIVING

if TYPE_CHECKING:
    from fragmotion_core import Character, Doubles, Performance, Player, Rig

_JUDGING_RATE = 30.0  # frames a second at which a recording's quality is measured
_HARDLY = 0.1  # of the way that it is asked to go
_CLIP_FRAMES = 2  # a clip has at least so many


class Beside(NamedTuple):
    """What is asked for beside a trace, as Player.run has it; what comes after its end counts for nothing."""

    looks: Sequence[LookChange] = ()
    reaches: Sequence[ReachChange] = ()
    moves: Sequence[Sequence[int]] = ()
    styled: Styled = AS_EVER


class Played(NamedTuple):
    """A motion, how well it follows its trace in words, and what to warn of."""

    motion: Motion
    remark: str
    warning: str = ""


def chosen_recording(obj: bpy.types.Object, settings: Any) -> Recording | None:
    """The recording that BakeFields ask for, None where the trace is another; UserError where it is not there."""
    if settings.trace_source != "RECORDING":
        return None
    recordings, index = obj.fragmotion.recordings, settings.recording
    recording = active_recording(obj) if index < 0 else recordings[index] if index < len(recordings) else None
    if recording is None:
        raise UserError(
            f"Armature '{obj.name}' has no such recording: record or import one, and select it under Recordings"
        )
    return recording


def prepare(
    context: bpy.types.Context,
    obj: bpy.types.Object,
    character: Character,
    rig: Rig,
    settings: Any,
    ground: Ground | None,
) -> Callable[[Report], Played]:
    """Read what a performance needs, as BakeFields say or as a walk of settings that have one says, a
    paths.following.Walk or a bake.crowd.Member; the task that it returns plays it and calls nothing of Blender."""
    recording, rate = chosen_recording(obj, settings), scene_rate(context.scene)
    recorded = recording if settings.as_recorded else None
    if recorded is not None:
        shown = shown_of(recorded)
        if shown is not None and recorded.shown_bones == len(character.skeleton.names):
            return lambda _report: Played(resampled(*shown, rate), "as it was recorded")
    player = _player_for(obj, character, recorded, settings)
    player.stand_on(ground)
    walk = getattr(settings, "walk", None)
    if walk is not None:
        player.reset(style=_chosen_style(obj, character, settings))
        walk.enter(player, character.space.scale)
        beside = Beside(_looks(obj, settings), reaches_now(context, obj, settings))
        return lambda report: _played(player, walk.trace(player, rate, report), rate, report, ground, beside)
    beside = _beside(context, obj, character, recording, settings)
    space = character.in_style(beside.styled.begin).space
    trace = make_trace(settings, space) if recording is None else trace_of(recording)
    place = _place(context, obj, rig, settings) if recorded is None else recorded.start
    player.reset(*place, style=beside.styled.begin)
    return lambda report: _played(player, trace, rate, report, ground, beside)


def _looks(obj: bpy.types.Object, settings: Any) -> list[LookChange]:
    """Where the panel says to look, as one sees it who is to be moved elsewhere as the settings of a crowd say."""
    aim, moved = aim_of(obj.fragmotion.look), getattr(settings, "moved", None)
    if aim.look == AS_CAPTURED:
        return []
    return [LookChange(0, aim.look, *(aim[1:] if moved is None else moved.inverted() @ Vector(aim[1:])))]


def _beside(
    context: bpy.types.Context, obj: bpy.types.Object, character: Character, recording: Recording | None, settings: Any
) -> Beside:
    """What the recording or the trace file asks for beside. Where a file tells no style to begin in, it is the one that
    BakeFields ask for, and where it tells no looks or reaches, they are those of the panel. UserError where a move is
    not there."""
    names = character.style_names
    if recording is not None:
        moves, styled = numbered_moves(recording, character.move_names), numbered_styles(recording, names)
        return Beside(looks_of(recording), reaches_of(recording), moves, styled)
    chosen = _chosen_style(obj, character, settings)
    moves, styled, asked = asked_beside(settings, character.move_names, names, chosen)
    looks = asked.looks or _looks(obj, settings)
    return Beside(looks, asked.reaches or reaches_now(context, obj, settings), moves, styled)


def _chosen_style(obj: bpy.types.Object, character: Character, settings: Any) -> int:
    """The style that BakeFields ask for; UserError where that is not there."""
    names = character.style_names
    if settings.style and settings.style not in names:
        raise UserError(
            f"Armature '{obj.name}' has no style '{settings.style}': its styles are {', '.join(names) or 'none'}. "
            "Choose one of them under Bake, or Build with takes of that style"
        )
    return names.index(settings.style) if settings.style else 0


def _played(
    player: Player,
    trace: Doubles,
    rate: float,
    report: Report,
    ground: Ground | None,
    beside: Beside,
) -> Played:
    """What a player does from where it stands, on the ground that it stands on."""
    styled = beside.styled
    reaches = [reach for reach in beside.reaches if reach.control < len(trace)]
    performance = player.run(
        trace,
        rate,
        report,
        beside.moves or None,
        styled.changes or None,
        looks=beside.looks or None,
        reaches=reaches or None,
    )
    motion = Motion(performance.root_positions, performance.rotations, performance.path, performance.classes)
    remarks = filter(None, (styled.remark, *remarks_of(player, ground)))
    return Played(motion, "; ".join((_judge(performance), *remarks)), _hardly_moves(performance))


def measure_quality(obj: bpy.types.Object, recording: Recording) -> float:
    """Eq. 2's mean over time when the armature's character replays the recording; 0 where there is no character, or
    none with the moves that are started."""
    if not has_character(obj):
        return 0.0
    character = load(obj)
    policy = recording.policy if recording.policy in character.policies else ""
    if any(move.name not in character.move_names for move in moves_of(recording)):
        return 0.0
    with core_errors(f"Recording '{recording.name}'"):
        player = make_player(obj, character, recording.seed, policy)
        return float(perform(player, character, recording, trace_of(recording), _JUDGING_RATE).quality)


def perform(
    player: Player,
    character: Character,
    recording: Recording,
    trace: Doubles,
    rate: float,
    start: tuple[float, float, float] = (0, 0, 0),
) -> Performance:
    """What the character's player shows of a trace [T,4] with what the recording asks for beside in that time, from
    the character frame `start` on."""
    styled = numbered_styles(recording, character.style_names)
    changes = [change for change in styled.changes if change[0] < len(trace)]
    moves = [move for move in numbered_moves(recording, character.move_names) if move[0] < len(trace)]
    looks = [look for look in looks_of(recording) if look.control < len(trace)]
    reaches = [reach for reach in reaches_of(recording) if reach.control < len(trace)]
    player.reset(*start, style=styled.begin)
    return player.run(
        trace, rate, moves=moves or None, styles=changes or None, looks=looks or None, reaches=reaches or None
    )


def _player_for(obj: bpy.types.Object, character: Character, recorded: Recording | None, settings: Any) -> Any:
    if recorded is not None:
        policy, seed = recorded.policy, recorded.seed
    else:
        policy, seed = settings.policy if settings.policy != DRIVING else "", settings.seed
    with core_errors("Bake"):
        return make_player(obj, character, seed, policy)


def _place(context: bpy.types.Context, obj: bpy.types.Object, rig: Rig, settings: Any) -> tuple[float, float, float]:
    """Where the character starts: x, y and heading."""
    if settings.place == "CHARACTER":
        return character_frame(context, obj, rig)
    return origin_frame(obj)


def origin_frame(obj: bpy.types.Object) -> tuple[float, float, float]:
    """The character frame, x, y (m) and heading (rad), under the armature's origin facing its -Y (Blender's front)."""
    place = obj.matrix_world
    return place.translation.x, place.translation.y, place.to_euler().z + math.pi


def character_frame(context: bpy.types.Context, obj: bpy.types.Object, rig: Rig) -> tuple[float, float, float]:
    """Where the character stands as Blender shows it now: x, y (m) and heading (rad)."""
    posed = obj.evaluated_get(context.evaluated_depsgraph_get())
    matrices = np.array([[posed.pose.bones[bone.name].matrix for bone in obj.data.bones]] * _CLIP_FRAMES)
    with core_errors(f"Armature '{obj.name}'"):
        clip = rig.clip_from_matrices(obj.name, 1.0, matrices, np.array([posed.matrix_world] * _CLIP_FRAMES))
        x, y, heading = clip.character_frames(rig.skeleton)[0]
    return float(x), float(y), float(heading)


def _judge(performance: Performance) -> str:
    error, speed = performance.velocity_error, performance.commanded_speed
    return f"velocity error {error:.2f} m/s of {speed:.2f} m/s"


def _hardly_moves(performance: Performance) -> str:
    """What to warn of where a motion goes nowhere though it is asked to; empty where it goes."""
    path, asked = performance.path[:, :2], performance.commanded_speed
    seconds = (len(path) - 1) / performance.rate
    gone = float(np.linalg.norm(np.diff(path, axis=0), axis=1).sum())
    if gone >= _HARDLY * asked * seconds:
        return ""
    return f"It hardly moves: {gone:.2f} m in {seconds:.0f} s, though {asked:.2f} m/s was asked for"
