# SPDX-License-Identifier: GPL-3.0-or-later
"""A crowd: copies of an armature and what belongs to it, each with a trace of its own, baked."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from random import Random
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import bpy
import numpy as np
from mathutils import Matrix, Vector

from ..character.building import load
from ..compat.core import core
from ..compat.machine import memory
from ..errors import UserError
from ..ground.areas import outlines, painted_area, places_apart
from ..ground.meshes import find_ground
from ..jobs import Report
from ..mocap.sampling import scene_rate
from ..paths.following import shared
from ..paths.lines import TYPES as LINES
from ..paths.lines import line_of
from ..recordings.curves import curves_of
from ..recordings.recordings import TRACE_RATE
from ..recordings.traces import make_trace
from ..rig.belongings import belongings
from ..rig.posing import visit
from ..rig.rigs import make_rig
from ..settings.bake_fields import MIXED, BakeFields
from . import baking
from .crowd import RADIUS, Together
from .performing import character_frame, origin_frame
from .targets import Target, write

if TYPE_CHECKING:
    from fragmotion_core import Character, Doubles, PaintedArea

Spot = tuple[float, float, float]
"""Where a copy stands as the original sees it on the ground: x, y (m) and how far it is turned (rad)."""

_VALUE, _KEY = 8, 72  # bytes of a channel on a frame, and of a key of Blender's
_CHANNELS = 4  # of a bone
_REST = 2.0  # s that who has come to a path's end stands there
_GOAL = 3.0  # s that is gone for a place of an area at least
_FIXED = {"target": "NEW", "action": "", "root": "BONE", "place": "ORIGIN", "as_recorded": False, "markers": "NONE"}


def spots(count: int, layout: str, spacing: float) -> list[Spot]:
    """Places around the original: SQUARE fills a grid from the middle, RING is a circle that faces outwards. No two,
    and none and the original, are nearer than the spacing. PATH and AREA leave them where the original is, as they go
    elsewhere."""
    if layout in {"PATH", "AREA"}:
        return [(0.0, 0.0, 0.0)] * count
    if layout == "RING":
        radius = spacing / min(2 * math.sin(math.pi / count), 1) if count > 1 else spacing
        angles = [2 * math.pi * index / count for index in range(count)]
        return [(radius * math.sin(angle), -radius * math.cos(angle), angle) for angle in angles]
    reach = math.ceil((math.sqrt(count + 1) - 1) / 2)
    cells = itertools.product(range(-reach, reach + 1), repeat=2)
    nearest = sorted(cells, key=lambda cell: (max(map(abs, cell)), math.hypot(*cell), cell))
    return [(spacing * x, spacing * y, 0.0) for x, y in nearest[1 : count + 1]]


def prepare(context: bpy.types.Context, obj: bpy.types.Object, settings: Any) -> Callable[[Report], list[baking.Baked]]:
    """Read what the bakes need, as settings with PopulateFields say; the task that it returns calls nothing of Blender.

    A copy plays at its place just what the original would at its own, so that all are computed there, on the ground as
    it is at the copies' places.
    """
    bakes = list(_bakes(obj, settings))
    if settings.layout != "PATH":
        _check_memory(context, obj, [_seconds(obj, each) for each in bakes])
    ground = find_ground(context, obj)
    for each, moved in zip(bakes, movements(obj, settings)):
        each.moved = moved
    _set_walks(context, obj, settings, bakes)
    tasks = [baking.prepare(context, obj, each, ground and ground.seen_from(each.moved)).task for each in bakes]

    def task(report: Report) -> list[baking.Baked]:
        return [each(_share(report, index, len(tasks))) for index, each in enumerate(tasks)]

    return task


def populate(
    context: bpy.types.Context, obj: bpy.types.Object, crowd: Sequence[baking.Baked], settings: Any
) -> bpy.types.Collection:
    """Add a copy for each bake to a new collection; on an error the file is as before."""
    bake = _bake_settings(obj)
    with _whole_or_not_at_all(context) as collection:
        collection.name = f"{obj.name} Crowd"
        for number, (baked, moved) in enumerate(zip(crowd, movements(obj, settings)), 1):
            copy = _copy(obj, moved, number, collection)
            target = Target("NEW", None, copy.name, bake.frame_start)
            write(context, copy, target, baked.tracks, baked.classes, bake)
        for copied in collection.objects:
            copied.select_set(False)  # as the original may be
    return collection


def movements(obj: bpy.types.Object, settings: Any) -> list[Matrix]:
    """What moves the world from the original to each copy of a crowd, which may be larger or smaller."""
    places = spots(settings.count, settings.layout, settings.spacing)
    sizes = (1 + settings.sizes * Random(settings.seed + index).uniform(-1, 1) for index in range(settings.count))
    return [_around(obj, spot, size) for spot, size in zip(places, sizes)]


def _seconds(obj: bpy.types.Object, bake: SimpleNamespace) -> float:
    """How long a bake plays that goes along no path."""
    recorded = bake.trace_source == "RECORDING"
    return float(obj.fragmotion.recordings[bake.recording].seconds if recorded else bake.seconds)


def _check_memory(context: bpy.types.Context, obj: bpy.types.Object, seconds: Sequence[float]) -> None:
    """UserError where copies that play for so long each would fill the computer's memory."""
    frames = sum(seconds) * scene_rate(context.scene)
    reduce = obj.fragmotion.bake.reduce
    needed = frames * _CHANNELS * len(obj.data.bones) * (_VALUE if reduce else _VALUE + _KEY)
    if needed > memory():
        raise UserError(
            f"{len(seconds)} copies for {max(seconds):.0f} s need some {needed / 1e9:.0f} GB, and this computer has "
            f"{memory() / 1e9:.0f}: let there be fewer, or shorter, under Populate"
        )


def _set_walks(
    context: bpy.types.Context, obj: bpy.types.Object, settings: Any, bakes: Sequence[SimpleNamespace]
) -> None:
    """Give the bakes of a crowd what they walk, where they go along paths, about an area, or keep clear."""
    character, crowd = load(obj), settings.layout in {"PATH", "AREA"}
    if settings.layout == "PATH":
        lines = [line_of(context, each) for each in _curves(obj.fragmotion.crowd.paths)]
        moved = [each.moved for each in bakes]
        walks = shared(context, obj, obj.fragmotion.path, character.space, moved, settings.spacing, lines)
        _check_memory(context, obj, [each.seconds for each in walks])
        for each, walk in zip(bakes, walks):
            each.walk = walk
    if (settings.clear and (crowd or settings.traces == "PLAYERS")) or settings.layout == "AREA":
        _keep_clear(context, obj, settings, bakes, character)


def _keep_clear(
    context: bpy.types.Context,
    obj: bpy.types.Object,
    settings: Any,
    bakes: Sequence[SimpleNamespace],
    character: Character,
) -> None:
    """Let those of a crowd make way for each other, and for what stands around, where that is asked for."""
    chosen = obj.fragmotion.crowd
    stands = outlines(chosen.obstacles.all_objects) if chosen.obstacles is not None else []

    def together(seconds: float, follow: dict[str, Any], area: PaintedArea | None = None) -> Together:
        passers_by = _original(context, obj, bakes[0].frame_start, seconds)
        return Together(stands, seconds, follow, settings.clear, area, passers_by)

    if settings.layout == "PATH":
        follow = dict(bakes[0].walk.options, arrive=max(each.walk.options["arrive"] for each in bakes))
        seconds = follow.pop("seconds")
        if follow["end"] == "stand":
            seconds = min(seconds, follow["arrive"] + _REST)
        crowd = together(seconds, follow)
        for each in bakes:
            each.walk = crowd.add(each.walk.path, each.walk.path.start, each.moved)
    elif settings.layout == "AREA":
        area = painted_area(context, chosen.area)
        crowd = together(settings.seconds, {}, area)
        _go_about(area, chosen.area.name, settings, bakes, crowd, RADIUS / character.space.scale)
    else:
        crowd, start = together(settings.seconds, {}), origin_frame(obj)
        for each in bakes:
            style = character.style_names.index(each.style) if each.style else 0
            each.walk = crowd.add(make_trace(each, character.in_style(style).space), start, each.moved)


def _original(context: bpy.types.Context, obj: bpy.types.Object, first: float, seconds: float) -> list[Doubles]:
    """Where the original is at each control from a frame on, as core.keep_clear() takes passers-by: none where it is
    not seen."""
    if not obj.visible_get():
        return []
    rig, scene = make_rig(obj), context.scene
    apart = scene_rate(scene) / TRACE_RATE
    moves = obj.animation_data or obj.parent or len(obj.constraints)
    times = first + apart * np.arange(math.ceil(seconds * TRACE_RATE) if moves else 1)
    return [np.array([character_frame(context, obj, rig)[:2] for _ in visit(scene, times)])]


def _go_about(
    area: PaintedArea, name: str, settings: Any, bakes: Sequence[SimpleNamespace], together: Together, room: float
) -> None:
    """Let them go from place to place on the area of that name, so many m off its edge."""
    random = Random(settings.seed)
    starts = places_apart(area, name, len(bakes), settings.spacing, settings.seed, room)
    goals = math.ceil(settings.seconds / _GOAL)
    places = area.draw_ways(starts, goals, settings.seed + 1, room)
    for each, start, wished in zip(bakes, starts, places):
        seen = each.moved.inverted()
        x, y, _ = seen @ Vector(start)
        own = np.array([(seen @ Vector(place)).xy for place in wished])
        each.walk = together.add(own, (x, y, random.uniform(-math.pi, math.pi)), each.moved)


def _curves(paths: bpy.types.Collection | None) -> list[bpy.types.Object]:
    """The curves among which a crowd is shared out, none where no collection says so; UserError where it holds none."""
    if paths is None:
        return []
    found = sorted((each for each in paths.all_objects if each.type in LINES), key=lambda each: each.name)
    if not found:
        raise UserError(
            f"Collection '{paths.name}' holds no curve to go along: choose another, or none, under Populate"
        )
    return found


def _bakes(obj: bpy.types.Object, settings: Any) -> Iterator[SimpleNamespace]:
    """What each copy bakes: Bake's own settings, with a trace and a seed of its own."""
    ticked = []
    if settings.traces == "RECORDINGS" and settings.layout in {"SQUARE", "RING"}:
        ticked = [index for index, recording in enumerate(obj.fragmotion.recordings) if recording.train]
        if not ticked:
            raise UserError(
                f"No recording of armature '{obj.name}' is ticked: tick some under Recordings, or choose Simulated"
            )
    styles = load(obj).style_names
    habits = core.PLAYERS if settings.player == MIXED else [settings.player]
    for index in range(settings.count):
        each = _bake_settings(obj)
        each.seed, each.seconds, each.player = settings.seed + index, settings.seconds, habits[index % len(habits)]
        if settings.mix_styles and styles:
            each.style = Random(each.seed).choice(styles)
        each.trace_source = "RECORDING" if ticked else "PLAYER"
        each.recording = ticked[index % len(ticked)] if ticked else -1
        yield each


def _bake_settings(obj: bpy.types.Object) -> SimpleNamespace:
    """The settings of the Bake panel with what a crowd needs."""
    names = {name for base in BakeFields.__mro__ for name in getattr(base, "__annotations__", {})}
    bake = obj.fragmotion.bake
    return SimpleNamespace(**{name: getattr(bake, name) for name in names} | _FIXED)


def _share(report: Report, index: int, count: int) -> Report:
    return lambda fraction, _stage: report((index + fraction) / count, f"{index + 1} of {count}")


def _around(obj: bpy.types.Object, spot: Spot, size: float = 1.0) -> Matrix:
    """What moves the world from the original to a spot, where it is larger by so much."""
    x, y, turn = spot
    to_original = Matrix.Translation(obj.matrix_world.translation)
    facing = Matrix.Rotation(obj.matrix_world.to_euler().z, 4, "Z")
    moved = facing @ Matrix.Translation((x, y, 0)) @ facing.inverted() @ Matrix.Rotation(turn, 4, "Z")
    return to_original @ moved @ Matrix.Scale(size, 4) @ to_original.inverted()


def _copy(obj: bpy.types.Object, moved: Matrix, number: int, collection: bpy.types.Collection) -> bpy.types.Object:
    """A copy of the armature and of what it carries or deforms, but for the curves of its recordings, moved; their data
    are the originals'."""
    curves = [curves_of(obj, recording) for recording in obj.fragmotion.recordings]
    copies = {original: original.copy() for original in (obj, *belongings(obj)) if original not in curves}
    for original, copy in copies.items():
        copy.name = f"{original.name} {number}"
        collection.objects.link(copy)
        _tie(copy, copies)
        if original.parent not in copies:
            copy.parent = None
            copy.matrix_world = moved @ original.matrix_world
    armature = copies[obj]
    armature.animation_data_clear()
    armature.property_unset("fragmotion")
    return armature


def _tie(copy: bpy.types.Object, copies: dict[bpy.types.Object, bpy.types.Object]) -> None:
    """Let the copy belong to copies where the original belongs to originals."""
    if copy.parent in copies:
        copy.parent = copies[copy.parent]
    for modifier in copy.modifiers:
        if getattr(modifier, "object", None) in copies:
            modifier.object = copies[modifier.object]


@contextmanager
def _whole_or_not_at_all(context: bpy.types.Context) -> Iterator[bpy.types.Collection]:
    """A new collection of the scene; on an error it goes, and all that was added since."""
    scene = context.scene
    end, before = scene.frame_end, (set(bpy.data.objects), set(bpy.data.actions))
    collection = bpy.data.collections.new("Crowd")
    scene.collection.children.link(collection)
    try:
        yield collection
    except BaseException:
        for kind, former in zip((bpy.data.objects, bpy.data.actions), before):
            for added in set(kind) - former:
                kind.remove(added)
        bpy.data.collections.remove(collection)
        scene.frame_end = end
        context.view_layer.update()
        raise
