# SPDX-License-Identifier: GPL-3.0-or-later
"""A trace played by the armature's character, written to an Action or an NLA strip.

All is computed before the file is changed, in a task that calls nothing of Blender.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import bpy
import numpy as np
from mathutils import Matrix, Quaternion

from ..character.building import check_skeleton, load
from ..character.moves import bring_up_to_date
from ..compat import versions
from ..errors import UserError, core_errors
from ..ground.meshes import Ground, find_ground
from ..jobs import Report
from ..mocap.sampling import scene_rate
from ..rig.external_motion import external_motion
from ..rig.keys import Bone, Deviation, Place, Poses, Track, count_keys, make_layout, make_tracks, reduce_tracks
from ..rig.motion import Motion, carried, looped
from ..rig.posing import check_free
from ..rig.rigs import carriers, make_rig
from . import performing
from .targets import Target, find_target, places_object

if TYPE_CHECKING:
    from fragmotion_core import Doubles, Ints, Rig


class Baked(NamedTuple):
    """What a bake will write: tracks, the class that plays on each frame, and what to say and to warn of."""

    tracks: list[Track]
    classes: Ints
    remark: str
    warning: str


class Stage(NamedTuple):
    """The armature as a bake finds it: among others its object's own rotation and the character frame at its origin."""

    label: str
    rig: Rig
    layout: list[Bone]
    place: Place
    world: Doubles
    turn: Quaternion
    origin: Doubles

    @property
    def hips(self) -> int:
        """The skeleton's number of the hips."""
        return int(self.rig.skeleton.names.index(self.rig.skeleton.roles["hips"]))


class Options(NamedTuple):
    """What a bake makes of a motion."""

    root: str
    holds_object: bool
    """Whether the object is keyed where it stands, as the keys below an NLA strip would move it."""
    anchored: bool
    """Whether a motion in place is moved to the armature's origin."""
    looped_frames: int
    bound: Deviation | None


class Prepared(NamedTuple):
    """A bake whose settings are in order: the task that computes it, and where the result goes."""

    task: Callable[[Report], Baked]
    target: Target


def prepare(context: bpy.types.Context, obj: bpy.types.Object, settings: Any, ground: Ground | None = None) -> Prepared:
    """Read what a bake with BakeFields needs, by default on the ground that the armature is set to; UserError on what
    cannot be baked."""
    check_free(obj)
    bring_up_to_date(context, obj)
    character = load(obj)
    context.view_layer.update()
    rig = make_rig(obj)
    check_skeleton(obj, character, rig)
    recording = performing.chosen_recording(obj, settings)
    target = find_target(context, obj, settings, recording.name if recording else "")
    holds = settings.root == "BONE" and settings.target == "NLA" and places_object(obj)
    if settings.root == "OBJECT":
        _check_object(obj, "choose Root Bone as root motion")
    elif holds:
        _check_object(obj, "bake to a new Action")
    elif settings.target == "CURRENT":
        _check_still(obj, target.action)
    play = performing.prepare(context, obj, character, rig, settings, ground or find_ground(context, obj))
    stage = _make_stage(obj, rig)
    options = _make_options(context.scene, settings, holds, recorded=recording is not None and settings.as_recorded)
    return Prepared(lambda report: _compute(stage, options, play, report), target)


def hindrances(obj: bpy.types.Object, own_strip: bool = False) -> list[str]:
    """What will show the armature otherwise than the baked keys say, in words; NLA tracks do not below its own."""
    data = obj.animation_data
    tracks = data.nla_tracks if data is not None and data.use_nla and not own_strip else ()
    playing = [f"NLA track '{track.name}'" for track in tracks if not track.mute]
    resting = ["the armature's Rest Position"] if obj.data.pose_position == "REST" else []
    return [*external_motion(obj), *playing[:1], *resting]


def _compute(stage: Stage, options: Options, play: Callable[[Report], performing.Played], report: Report) -> Baked:
    motion, remark, warning = play(report)
    if options.looped_frames:
        motion = looped(motion, stage.hips, options.looped_frames)
    if options.root == "IN_PLACE":
        motion = carried(motion, stage.hips, stage.origin if options.anchored else motion.path[0])
    poses = _make_poses(stage, motion, options)
    tracks = make_tracks(stage.layout, poses)
    if options.bound is not None:
        every = count_keys(tracks)
        tracks, found = reduce_tracks(tracks, stage.rig, poses, stage.place, options.bound, report)
        kept = count_keys(tracks)
        remark += (
            f"; {kept} keys instead of {every} ({100 * kept / every:.0f} %), at most "
            f"{1000 * found.distance:.1f} mm and {math.degrees(found.angle):.2f} degrees off"
        )
    return Baked(tracks, motion.classes, remark, warning)


def _make_poses(stage: Stage, motion: Motion, options: Options) -> Poses:
    """The armature's channels, the path on its root bone or on the object."""
    on_object = options.root == "OBJECT"
    seen = carried(motion, stage.hips, stage.origin) if on_object else motion
    with core_errors(stage.label):
        locations, rotations = stage.rig.channels(seen.root_positions, seen.rotations)
    if on_object:
        return Poses(locations, rotations, *_move_object(stage, motion.path))
    if options.holds_object:
        return Poses(locations, rotations, *_move_object(stage, np.tile(stage.origin, (len(locations), 1))))
    return Poses(locations, rotations)


def _move_object(stage: Stage, frames: Doubles) -> tuple[Doubles, Doubles]:
    """The object's own locations [F,3] and rotations [F,4] that carry its origin along character frames [F,3]."""
    above = Matrix(stage.place.above.tolist()).to_quaternion()
    below, own = above.inverted(), above @ stage.turn
    turns = (Quaternion((0, 0, 1), heading - stage.origin[2]) for heading in frames[:, 2])
    rotations = np.array([below @ turn @ own for turn in turns])
    heads = np.column_stack((frames[:, :2], np.full(len(frames), stage.world[2, 3]), np.ones(len(frames))))
    return (heads @ np.linalg.inv(stage.place.above).T)[:, :3], rotations


def _make_stage(obj: bpy.types.Object, rig: Rig) -> Stage:
    world, basis = obj.matrix_world, obj.matrix_basis
    place = Place(np.array(world @ basis.inverted()), np.array(basis.to_scale()))
    layout = make_layout(obj, carriers(obj, rig))
    origin = np.array(performing.origin_frame(obj))
    return Stage(f"Armature '{obj.name}'", rig, layout, place, np.array(world), basis.to_quaternion(), origin)


def _make_options(scene: bpy.types.Scene, settings: Any, holds: bool, recorded: bool) -> Options:
    frames = max(round(settings.loop_seconds * scene_rate(scene)), 2) if settings.loop else 0
    bound = Deviation(settings.reduce_distance, settings.reduce_angle) if settings.reduce else None
    return Options(settings.root, holds, recorded or settings.place == "ORIGIN", frames, bound)


def _check_object(obj: bpy.types.Object, instead: str) -> None:
    """UserError where keys of the object's place would not put it there; it says what to do `instead` of such keys."""
    if any((*obj.delta_location, *obj.delta_rotation_euler)) or tuple(obj.delta_rotation_quaternion) != (1, 0, 0, 0):
        raise UserError(
            f"Armature '{obj.name}' has delta transforms, to which keys on the object would add: apply them first "
            f"(Object > Apply > Deltas), or {instead}"
        )


def _check_still(obj: bpy.types.Object, action: bpy.types.Action | None) -> None:
    """UserError where the Action's own keys move the object on which the character's root bone is."""
    if action is None:
        return
    moving = [c for c in versions.curves_of(action, obj) if not c.data_path.startswith("pose.")]
    if any(np.ptp([key.co.y for key in curve.keyframe_points] or [0]) > 0 for curve in moving):
        raise UserError(
            f"Action '{action.name}' moves the armature object itself ({moving[0].data_path}): choose Object as root "
            "motion, or bake to a new Action"
        )
