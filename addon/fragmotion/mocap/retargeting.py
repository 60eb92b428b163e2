# SPDX-License-Identifier: GPL-3.0-or-later
"""Motion of other bodies onto an armature, by what their bones are."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from math import isclose
from typing import TYPE_CHECKING, NamedTuple

import bpy
import numpy as np

from ..compat.core import core
from ..errors import UserError, core_errors
from ..rig.bodies import make_body
from ..rig.rigs import FORE_FOOT, carriers
from ..rig.writing import write_poses
from ..words import counted
from .actions import RATE, SCENE_RATE
from .comparing import keep_source
from .doctor import keep_remarks
from .left_out import leave_out_likewise
from .markers import mark_likewise
from .sampling import rig_as_posed, rig_with_feet, sample, sample_times, scene_rate

if TYPE_CHECKING:
    from fragmotion_core import Body, Clip, Doubles, RetargetedClip, Rig, Skeleton, Take

Channels = tuple["Doubles", "Doubles"]
Remarks = list[tuple[str, str, str]]


class Brought(NamedTuple):
    """A take as channels of an armature, what a viewer may find fault with in it, and of what it was made."""

    channels: Channels
    remarks: Remarks
    clip: Clip | None = None
    skeleton: Skeleton | None = None


FIRST_FRAME = 1
_SAME_SIZE = 1e-3  # of the stature
_SAMPLING = 0.5  # share of the progress that reading Actions takes


def has_names_of(rig: Rig, skeleton: Skeleton) -> bool:
    """Whether the rig has all of the skeleton's bones, by name."""
    return set(skeleton.names) <= set(rig.skeleton.names)


def is_its_own(rig: Rig, skeleton: Skeleton) -> bool:
    """Whether takes of the skeleton are of the animal on four legs that the rig is: nothing has to be brought onto it,
    nor can be."""
    legs = FORE_FOOT in rig.skeleton.roles and FORE_FOOT in skeleton.roles
    return legs and has_names_of(rig, skeleton) and is_as_tall(rig.skeleton, skeleton)


def is_as_tall(one: Skeleton, other: Skeleton) -> bool:
    """Whether bodies are of one size."""
    return isclose(one.stature, other.stature, rel_tol=_SAME_SIZE)


def retargeted_takes(
    obj: bpy.types.Object, rig: Rig, takes: Sequence[Take], placed: Rig | None = None
) -> tuple[dict[int, Brought], list[str]]:
    """By its number, each take, of whatever skeleton, that can be brought onto the armature's body, those of an animal
    on itself as they are; and why the others cannot be, one cause for those of a skeleton. `placed`: the armature where
    it shows the takes as they are in the world, in place of where it is."""
    shown = placed or rig
    brought = {i: Brought(shown.take_channels(t), []) for i, t in enumerate(takes) if is_its_own(rig, t.skeleton)}
    others, refused = [index for index in range(len(takes)) if index not in brought], list[str]()
    for group in core.group_skeletons([takes[index].skeleton for index in others]):
        members = [others[index] for index in group]
        try:
            done = _of_one_skeleton(obj, rig, [takes[index] for index in members], shown)
            brought.update(zip(members, done))
        except UserError as error:
            more = len(members) - 1
            refused.append(f"{error}" + (f"; so it is with {counted(more, 'more take')}" if more else ""))
    return brought, refused


def _of_one_skeleton(obj: bpy.types.Object, rig: Rig, takes: Sequence[Take], placed: Rig) -> list[Brought]:
    skeleton = takes[0].skeleton
    with core_errors(f"Take '{takes[0].name}'"):
        clips = [core.Clip.from_take(take, skeleton) for take in takes]
        source = core.Body(skeleton, clips)
    done = _retargeted(source, obj, rig, clips)
    return [_brought(placed, each)._replace(clip=clip, skeleton=skeleton) for clip, each in zip(clips, done)]


def _brought(rig: Rig, done: RetargetedClip) -> Brought:
    return Brought(rig.channels(done.clip.root_positions, done.clip.rotations), done.remarks)


def _retargeted(source: Body, obj: bpy.types.Object, rig: Rig, clips: Sequence[Clip]) -> list[RetargetedClip]:
    with core_errors(f"Armature '{obj.name}'"):
        done: list[RetargetedClip] = core.Retarget(source, make_body(obj, rig)).apply_all(clips)
        return done


def retarget_actions(
    context: bpy.types.Context,
    source: bpy.types.Object,
    obj: bpy.types.Object,
    actions: Sequence[bpy.types.Action],
) -> Generator[float, None, list[bpy.types.Action]]:
    """New Actions, ticked, in which the armature does what the source does in its Actions. Gives the share that is
    done; on an error, and where it is closed before its end, there are none."""
    source_rig, rig = rig_as_posed(source), rig_with_feet(context, obj)
    moving = carriers(obj, rig)
    clips = []
    for index, action in enumerate(actions):
        clips.append(sample(context, source, action, source_rig))
        yield _SAMPLING * index / len(actions)
    made: list[bpy.types.Action] = []
    try:
        for index, done in enumerate(_retargeted(make_body(source, source_rig, clips), obj, rig, clips)):
            channels, remarks, *_ = _brought(rig, done)
            made.append(make_action(context.scene, f"{done.clip.name} on {obj.name}", done.clip.rate))
            keep_remarks(made[-1], remarks)
            keep_source(made[-1], clips[index], source_rig.skeleton)
            times = key_times(made[-1], len(channels[1]))
            write_poses(made[-1], obj, times, *channels, moving)
            take_after(actions[index], sample_times(context.scene, source, actions[index]), made[-1], times)
            yield _SAMPLING + (1 - _SAMPLING) * index / len(clips)
    except BaseException:
        for action in made:
            bpy.data.actions.remove(action)
        raise
    return made


def make_action(scene: bpy.types.Scene, name: str, rate: float) -> bpy.types.Action:
    """An Action to learn from, without keys yet, of so many frames a second."""
    action = bpy.data.actions.new(name)
    action.use_fake_user = True
    action[RATE], action[SCENE_RATE] = rate, scene_rate(scene)
    action.fragmotion.use = True
    return action


def take_after(source: bpy.types.Action, frames: Doubles, made: bpy.types.Action, times: Doubles) -> None:
    """Give an Action, whose keys at `times` show the source's at `frames`, all that Build is told of the source."""
    made.fragmotion.style = source.fragmotion.style
    leave_out_likewise(source, frames, made, times)
    mark_likewise(source, frames, made, times)


def key_times(action: bpy.types.Action, frames: int) -> Doubles:
    """Scene frames on which the take plays in its own time at the scene's rate now."""
    return FIRST_FRAME + float(action[SCENE_RATE]) / float(action[RATE]) * np.arange(frames, dtype=float)
