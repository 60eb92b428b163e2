# SPDX-License-Identifier: GPL-3.0-or-later
"""Takes of motion capture files onto an armature, an Action for each."""

from __future__ import annotations

import os
from collections.abc import Collection, Generator, Iterator, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, wait
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import bpy
import numpy as np

from ..compat import versions
from ..compat.core import core
from ..errors import UserError, core_errors
from ..files import check_regular
from ..rig.bodies import keep_four_legs
from ..rig.rigs import carriers, make_rig, over_origin
from ..rig.selection import select
from ..rig.writing import write_poses
from . import by_blender
from .by_blender import NoTakes
from .comparing import keep_source
from .doctor import WAIT, examine, keep_findings, keep_remarks
from .retargeting import Brought, Channels, has_names_of, is_as_tall, key_times, make_action, retargeted_takes
from .sampling import rig_with_feet
from .scratch import scratch_scene
from .take_files import BY_BLENDER, TakeFile

if TYPE_CHECKING:
    from fragmotion_core import Rig, Skeleton, Take

METRES = {"CENTIMETRES": 0.01, "METRES": 1.0, "INCHES": 0.0254}
"""Metres in one unit of a BVH file, where the user says."""

_SHORTEST_BONE = 0.001  # m; Blender deletes bones without length
_STUB = 0.01  # m; length of a bone that has none
_ROOT_LENGTH = 0.2  # of the stature, at most
_LONGEST_NAME = 63  # bytes
_STILL = 1e-6  # m; a location that stays below never leaves its rest
_BVH, _AMC = ".bvh", ".amc"
_UNIT = 0.01  # m in one unit of a BVH file, until the body tells otherwise
_STAGE = 1 / 3  # of the progress: reading, examining, writing


class Imported(NamedTuple):
    """The armature that takes came onto, their Actions with the file of each, the files of a folder that hold none,
    what is wrong with each that cannot be read, or brought onto it, and how many takes of the same bones, but of a body
    of other proportions, were brought onto it."""

    obj: bpy.types.Object
    actions: list[bpy.types.Action]
    files: list[Path]
    without: list[Path]
    broken: list[str]
    resized: int = 0


class _ReadFile(NamedTuple):
    """A file's takes, and whether the user told their unit."""

    path: Path
    takes: list[Take]
    is_kept: bool


def import_takes(
    context: bpy.types.Context,
    name: str,
    files: Sequence[TakeFile],
    unit: float | None,
    onto: bpy.types.Object | None = None,
    mends: bool = True,
    character: str = "",
) -> Generator[float, None, Imported]:
    """Make an Action from each take: on an armature that is made from the first one, or on the body of an armature that
    is there. `unit`: m in one unit of a BVH file; None: the body's size tells. `character`: the armature whose takes
    come, in files that Blender reads and that hold several; "": all. Gives the share that is done. On an error, and
    where it is closed before its end, nothing stays in the file."""
    read, without, broken = yield from _read_all(context, files, unit, character)
    takes = [take for each in read for take in each.takes]
    core.tell_four_legs(takes)
    kept = [each.is_kept for each in read for _ in each.takes]
    paths = [each.path for each in read for _ in each.takes]
    examined = yield from examine(takes, mends, kept, _STAGE, 2 * _STAGE)
    takes = [each.take for each in examined]
    with _undone_on_error(context):
        obj = onto or make_armature(context, name, takes[0].skeleton)
        if onto is None:
            keep_four_legs(obj, takes[0].skeleton)
        rig = rig_with_feet(context, obj)
        fitting, refused, resized = _brought(obj, rig, takes, is_new=onto is None)
        if not fitting:
            raise UserError(refused[0])
        brought = list(fitting.values())
        examined, paths = [examined[index] for index in fitting], [paths[index] for index in fitting]
        moving = set(carriers(obj, rig)) | (set() if onto else _moving_bones(obj, [each.channels for each in brought]))
        actions = []
        for index, (each, (channels, remarks, clip, skeleton)) in enumerate(zip(examined, brought)):
            actions.append(make_action(context.scene, each.take.name, each.take.rate))
            keep_findings(actions[-1], each.found)
            keep_remarks(actions[-1], remarks)
            if clip is not None and skeleton is not None:
                keep_source(actions[-1], clip, skeleton)
            times = key_times(actions[-1], len(channels[1]))
            write_poses(actions[-1], obj, times, *channels, moving)
            yield _STAGE * (2 + index / len(examined))
        versions.assign(obj, actions[0])
        context.view_layer.update()
    return Imported(obj, actions, paths, without, [*broken, *refused], resized)


def _read_all(
    context: bpy.types.Context, files: Sequence[TakeFile], unit: float | None, character: str
) -> Generator[float, None, tuple[list[_ReadFile], list[Path], list[str]]]:
    """Each file's takes, the files of a folder in which nothing moves, and what is wrong with those that cannot be
    read; UserError where that is each of them."""
    read, without, broken = [], [], []
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        by_core = {f: pool.submit(_read_by_core, f, unit or _UNIT) for f in files if not _is_by_blender(f)}
        try:
            for index, file in enumerate(files):
                yield _STAGE * index / len(files)
                try:
                    if file in by_core:
                        takes = yield from _awaited(by_core[file], _STAGE * index / len(files))
                    else:
                        takes = _read_by_blender(context, file, character)
                    _check_names(file, takes)
                except NoTakes as error:
                    if file.named or len(files) == 1:
                        broken.append(str(error))
                    else:
                        without.append(file.path)
                except UserError as error:
                    broken.append(str(error))
                else:
                    read.append(_ReadFile(file.path, takes, unit is not None and file.path.suffix.lower() == _BVH))
        finally:
            for reading in by_core.values():
                reading.cancel()
    if not read and broken:
        more = len(broken) - 1
        raise UserError(broken[0] + (f"; nor can {more} more files be read" if more else ""))
    if not read:
        raise UserError(f"'{without[0]}' and {len(without) - 1} more: no armature in them is animated")
    return read, without, broken


def _awaited(reading: Future[list[Take]], share: float) -> Generator[float, None, list[Take]]:
    """What a file is read to; gives the share that is done before while it lasts."""
    while not wait([reading], WAIT).done:
        yield share
    return reading.result()


def _is_by_blender(file: TakeFile) -> bool:
    return file.path.suffix.lower() in BY_BLENDER


def _read_by_blender(context: bpy.types.Context, file: TakeFile, character: str) -> list[Take]:
    """The file's takes, read into a scratch scene."""
    with scratch_scene(context):
        return by_blender.read_takes(context, file.path, character)


def _read_by_core(file: TakeFile, unit: float) -> list[Take]:
    """The file's one take; the core's message names file and line."""
    with core_errors():
        asf = core.find_asf(file.path) if file.path.suffix.lower() == _AMC else None
        for path in (asf, file.path):
            if path is not None:
                check_regular(path)
        return [core.read_asf_amc(asf, file.path) if asf else core.read_bvh(file.path, unit)]


def _of_other_proportions(takes: Sequence[Take]) -> set[int]:
    """Which takes have the first one's bones on a body of another size: as they are, their feet would not stand."""
    first, *_ = own = [take.skeleton for take in takes]
    return {i for i, each in enumerate(own) if each.names == first.names and not is_as_tall(each, first)}


def _brought(
    obj: bpy.types.Object, rig: Rig, takes: Sequence[Take], is_new: bool
) -> tuple[dict[int, Brought], list[str], int]:
    """By its number, each take's channels: as they are on the armature that was made from them, else brought onto its
    body; why others cannot be; and how many have its bones, but other proportions, and are brought over where that
    can be."""
    has_bones = {i for i, take in enumerate(takes) if is_new and has_names_of(rig, take.skeleton)}
    placed = make_rig(obj, over_origin(obj))

    def bring(numbers: list[int]) -> tuple[dict[int, Brought], list[str]]:
        brought, refused = retargeted_takes(obj, rig, [takes[i] for i in numbers], placed)
        return {numbers[each]: done for each, done in brought.items()}, refused

    resized, _ = bring(sorted(_of_other_proportions(takes))) if is_new else ({}, [])
    own = {i: Brought(rig.take_channels(takes[i]), []) for i in has_bones - resized.keys()}
    others, refused = bring([i for i in range(len(takes)) if i not in own and i not in resized])
    return dict(sorted((own | resized | others).items())), refused, len(resized)


@contextmanager
def _undone_on_error(context: bpy.types.Context) -> Iterator[None]:
    """On an error remove the objects and Actions made inside, and give back the selection, active object and mode."""
    selected, active = context.selected_objects, context.view_layer.objects.active
    mode = active.mode if active else "OBJECT"
    in_mode = [obj for obj in context.view_layer.objects if obj.mode == mode != "OBJECT"]
    known_objects, known_actions = set(bpy.data.objects), set(bpy.data.actions)
    try:
        yield
    except BaseException:
        _remove(context, set(bpy.data.objects) - known_objects, set(bpy.data.actions) - known_actions)
        if in_mode:
            select(context, in_mode, active)
            bpy.ops.object.mode_set(mode=mode)
        select(context, selected, active)
        raise


def _check_names(file: TakeFile, takes: Sequence[Take]) -> None:
    """UserError where Blender cannot have a bone's name."""
    long = [name for take in takes for name in take.skeleton.names if len(name.encode()) > _LONGEST_NAME]
    if long:
        raise UserError(f"'{file.path}': bone name '{long[0]}' is longer than Blender's {_LONGEST_NAME} bytes")


def make_armature(context: bpy.types.Context, name: str, skeleton: Skeleton) -> bpy.types.Object:
    """An armature with the skeleton's bones at rest, active and alone selected, and in front: it has no mesh that would
    be seen in what it stands in."""
    if context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    obj = bpy.data.objects.new(name, bpy.data.armatures.new(name))
    context.collection.objects.link(obj)
    obj.show_in_front = True
    select(context, [obj], obj)
    bpy.ops.object.mode_set(mode="EDIT")
    try:
        _add_bones(obj.data, skeleton)
    finally:
        bpy.ops.object.mode_set(mode="OBJECT")
    return obj


def _add_bones(armature: bpy.types.Armature, skeleton: Skeleton) -> None:
    heads, tails = skeleton.rest_heads(), skeleton.rest_tails()
    for name, parent, head, tail in zip(skeleton.names, skeleton.parents, heads, tails):
        bone = armature.edit_bones.new(name)
        bone.head = head
        bone.tail = tail if np.linalg.norm(tail - head) >= _SHORTEST_BONE else head + np.array((0, 0, _STUB))
        bone.parent = armature.edit_bones[skeleton.names[parent]] if parent >= 0 else None
    root = armature.edit_bones[skeleton.names[0]]
    if root.name != skeleton.roles["hips"]:  # it reaches to where the hips happened to stand at rest, often metres away
        root.length = min(root.length, _ROOT_LENGTH * skeleton.stature)


def _moving_bones(obj: bpy.types.Object, channels: Sequence[Channels]) -> set[str]:
    """The bones that any take moves from their rest; all takes key these, so that none leaves its mark on the next."""
    furthest = np.max([np.abs(locations).max(axis=(0, 2)) for locations, _ in channels], axis=0)
    return {bone.name for bone, distance in zip(obj.data.bones, furthest) if distance > _STILL}


def _remove(
    context: bpy.types.Context, objects: Collection[bpy.types.Object], actions: Collection[bpy.types.Action]
) -> None:
    for obj in objects:
        armature = obj.data
        bpy.data.objects.remove(obj)
        bpy.data.armatures.remove(armature)
    for action in actions:
        bpy.data.actions.remove(action)
    context.view_layer.update()
