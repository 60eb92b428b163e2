# SPDX-License-Identifier: GPL-3.0-or-later
"""An armature's character along a path: a recording like one from a stick."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import bpy
import numpy as np
from mathutils import Matrix, Vector

from ..character.building import check_skeleton, load, make_player
from ..compat.core import core
from ..errors import UserError, core_errors
from ..ground.meshes import find_ground, remarks_of
from ..jobs import Report
from ..recordings.holding import reaches_now
from ..recordings.looks import AS_CAPTURED, LookChange, aim_of
from ..recordings.recordings import POSE_RATE, Recording, add_recording
from ..rig.motion import Motion
from ..rig.rigs import make_rig
from .lines import Line, line_of, through

if TYPE_CHECKING:
    from fragmotion_core import ControlSpace, Doubles, Path, PathWalk, Player

_LONGEST = 3600.0  # s that a path which ends is followed at most
_STEP, _FEWEST = 0.05, 3  # m between the points of a part of a path, and how many it has
_LATE = 0.25  # s that an arrival may differ from what was asked


def find_line(context: bpy.types.Context, settings: Any) -> Line:
    """The line that PathSettings ask for; UserError where there is none."""
    if settings.source == "SELECTED":
        chosen = [obj for obj in context.selected_objects if obj.type == "EMPTY"]
        return through(context, "The selected empties", chosen)
    if settings.source == "COLLECTION":
        if settings.collection is None:
            raise UserError("No collection is chosen: choose one that holds the way points")
        return through(context, f"Collection '{settings.collection.name}'", list(settings.collection.objects))
    if settings.curve is None:
        raise UserError("No path is chosen: choose a curve or Grease Pencil object, or press Draw Path")
    return line_of(context, settings.curve)


def make_path(line: Line, settings: Any, space: ControlSpace) -> Path:
    """The core's path, with speeds where the line's widths give them."""
    speeds = None
    if settings.speed_by == "RADIUS":
        speeds = (settings.speed or space.walk) * line.widths
        if not (speeds > 0).all():
            raise UserError(f"{line.name}: its radius is 0 somewhere, where the character would stand still")
    with core_errors(line.name):
        path: Path = core.Path(line.points, line.closed, speeds)
        return path


def follow(
    context: bpy.types.Context,
    obj: bpy.types.Object,
    settings: Any,
    standing: tuple[float, float, float],
) -> tuple[Recording, str, list[str]]:
    """Let the character follow the path of PathSettings, from the path's beginning or from where it is `standing`, and
    keep that as a recording. Returns it, how it went, and what the user should be warned of; on a UserError nothing has
    changed."""
    character = load(obj)
    check_skeleton(obj, character, make_rig(obj))
    line = find_line(context, settings)
    path = make_path(line, settings, character.space)
    start = path.start if settings.start == "PATH" else standing
    options, ground = _options(context, obj, settings), find_ground(context, obj)
    with core_errors("Follow Path"):
        player = make_player(obj, character, settings.seed)
        walk = core.follow_path(player, path, start, rate=POSE_RATE, **options)
        player.stand_on(ground)
        player.reset(*start)
        aim = aim_of(obj.fragmotion.look)
        looks = [] if aim.look == AS_CAPTURED else [LookChange(0, *aim)]
        reaches = [reach for reach in reaches_now(context, obj, obj.fragmotion.bake) if reach.control < len(walk.trace)]
        performance = player.run(walk.trace, POSE_RATE, looks=looks or None, reaches=reaches or None)
    motion = Motion(performance.root_positions, performance.rotations, performance.path, performance.classes)
    recording = add_recording(
        obj,
        walk.trace,
        name=f"Along {line.name}"[:60],
        seed=settings.seed,
        policy=character.policy,
        start=start,
        quality=performance.quality,
        shown=(np.arange(len(motion.path)) / POSE_RATE, motion),
        looks=looks,
        reaches=reaches,
    )
    return (
        recording,
        _tell(walk, path, settings),
        [*line.remarks, *_limits(walk, options.get("arrive"), character.space), *remarks_of(player, ground)],
    )


class Walk(NamedTuple):
    """A path for one character, and what core.follow_path is told of it."""

    path: Path
    options: dict[str, Any]

    @property
    def seconds(self) -> float:
        """How long it takes: up to its end, or for as long as was asked where it goes on from there."""
        longest, stands = self.options["seconds"], self.options["end"] == "stand"
        return float(min(longest, self.options["arrive"]) if stands else longest)

    def enter(self, player: Player, scale: float) -> None:
        """This player is to walk it, of a body that is so much smaller than 1.8 m: it need not be known beforehand."""

    def trace(self, player: Player, rate: float, report: Report) -> Doubles:
        """What a player does along it [T,4]; then the player stands at the beginning again, to be run at this rate."""
        with core_errors("Follow Path"):
            walk = core.follow_path(player, self.path, rate=rate, progress=report, **self.options)
            player.reset(*self.path.start, style=player.playing_style)
        trace: Doubles = walk.trace
        return trace


def shared(
    context: bpy.types.Context,
    obj: bpy.types.Object,
    settings: Any,
    space: ControlSpace,
    moved: Sequence[Matrix],
    spacing: float,
    lines: Sequence[Line] = (),
) -> list[Walk]:
    """The path of PathSettings, or several lines, for characters that go along it one behind the other, so far apart,
    in a world that lies so in ours: on each line parts of the same length, which all take the same time. UserError
    where they are too short for so many."""
    if settings.speed_by == "RADIUS":
        raise UserError("Several characters on one path go at one pace: choose another than Radius under Path")
    options = _options(context, obj, settings)
    lines = lines or [find_line(context, settings)]
    walks: list[Walk] = []
    for number, line in enumerate(lines):
        own = moved[number :: len(lines)]
        walks += _along(line, settings, space, own, spacing, options) if own else []
    order = sorted(range(len(moved)), key=lambda index: (index % len(lines), index // len(lines)))
    placed = dict(zip(order, walks))
    return [placed[index] for index in range(len(moved))]


def _along(
    line: Line,
    settings: Any,
    space: ControlSpace,
    moved: Sequence[Matrix],
    spacing: float,
    options: dict[str, Any],
) -> list[Walk]:
    """Those of one line."""
    count = len(moved)
    with core_errors(line.name):
        path = core.Path(line.points, line.closed or settings.end == "LOOP")
    left = path.length - spacing * (count if path.is_closed else count - 1)
    if left < (0 if path.is_closed else spacing):
        raise UserError(
            f"{line.name} is {path.length:.1f} m long, too short for {count} copies {spacing:g} m apart: let there be "
            "fewer, or nearer"
        )
    parts = [
        _part(path, number * spacing, path.length if path.is_closed else left, each.inverted())
        for number, each in enumerate(moved)
    ]
    if not options.get("arrive"):
        steering = {name: value for name, value in options.items() if name != "seconds"}
        with core_errors("Follow Path"):
            options = dict(options)
            options["arrive"] = max(core.PathFollower(space, part, **steering).seconds_left for part in parts)
    return [Walk(part, options) for part in parts]


def _part(path: Path, begin: float, length: float, seen: Matrix) -> Path:
    """A path from so many metres on, as one sees it elsewhere: of a closed one all, of an open one so much."""
    ways = np.linspace(begin, begin + length, max(int(length / _STEP), _FEWEST), endpoint=not path.is_closed)
    part: Path = core.Path([tuple((seen @ Vector((*place, 0))).xy) for place in path.places(ways)], path.is_closed)
    return part


def _options(context: bpy.types.Context, obj: bpy.types.Object, settings: Any) -> dict[str, Any]:
    """What settings ask of core.follow_path."""
    options: dict[str, Any] = {"end": settings.end.lower(), "seconds": _LONGEST}
    if settings.end != "STAND":
        options["seconds"] = settings.seconds
    if settings.speed_by == "ARRIVE":
        options["arrive"] = _arrival(context, obj, settings)
    elif settings.speed_by == "SPEED":
        options["speed"] = settings.speed
    if settings.facing == "FIXED":
        options.update(facing="heading", heading=settings.heading)
    elif settings.facing == "OBJECT":
        if settings.look_at is None:
            raise UserError("No object to face is chosen: choose one, or let the character face along the path")
        shown = settings.look_at.evaluated_get(context.evaluated_depsgraph_get())
        options.update(facing="place", place=shown.matrix_world.translation[:2])
    return options


def _arrival(context: bpy.types.Context, obj: bpy.types.Object, settings: Any) -> float:
    """Seconds from the frame at which a bake begins to that of the arrival."""
    render, first = context.scene.render, obj.fragmotion.bake.frame_start
    seconds = (settings.arrive_frame - first) * render.fps_base / render.fps
    if seconds <= 0:
        raise UserError(
            f"The character is to arrive at frame {settings.arrive_frame}, and sets off at frame {first}, where Bake "
            "begins: choose a later frame to arrive"
        )
    return float(seconds)


def _tell(walk: PathWalk, path: Path, settings: Any) -> str:
    off = f"{walk.mean_distance:.2f} m from the path in the mean, {walk.greatest_distance:.2f} m at most"
    told = f"{path.length:.1f} m; {off}"
    if walk.arrived and settings.end == "STAND":
        return f"{told}; stands {walk.arrival_distance:.2f} m from its end after {walk.seconds:.1f} s"
    return f"{told}; past its end after {walk.seconds:.1f} s" if walk.arrived else told


def _limits(walk: PathWalk, asked: float | None, space: ControlSpace) -> list[str]:
    """What was asked and could not be done; `asked` is the time of arrival, s, if any."""
    warnings = []
    if walk.asked_speed > space.run:
        warnings.append(
            f"The path asks for {walk.asked_speed:.1f} m/s, and the character runs at {space.run:.1f} m/s: it went as "
            "fast as it can"
        )
    if not walk.arrived:
        warnings.append(f"The character has not come to the path's end within {walk.seconds:.0f} s")
    elif asked is not None and abs(walk.seconds - asked) > _LATE:
        warnings.append(f"The character arrived after {walk.seconds:.1f} s, and was to after {asked:.1f} s")
    return warnings
