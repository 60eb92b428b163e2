# SPDX-License-Identifier: MIT
"""Takes from files."""

from __future__ import annotations

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from pathlib import Path
from typing import NamedTuple

from . import by_blender
from .core import core
from .files import UNIT
from .running import say

_OF_UNIT = "unit"  # a finding's code
_FEWEST = 2  # frames of a take, and of a part of one


class FileTake(NamedTuple):
    """A take, and the file that it is from."""

    path: Path
    take: core.Take


class Led(NamedTuple):
    """A clip or a part of one, from its frame `first` on, on the way that its feet tell, m/s; 0 where they tell
    none. Not `by_feet`: straight ahead at a speed that was given, as they tell none."""

    first: int
    clip: core.Clip
    speed: float
    by_feet: bool = True


def read_take(path: Path, unit: float = UNIT) -> core.Take:
    """The take of a file, an AMC's on the skeleton that lies beside it; ValueError names what is wrong."""
    return core.read_bvh(path, unit) if path.suffix.lower() == ".bvh" else core.read_asf_amc(core.find_asf(path), path)


def read_each(paths: Sequence[Path], unit: float = UNIT) -> list[core.Take | str]:
    """The take of each file, or why it cannot be read; together they tell whether a body goes on four legs."""
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        read = list(pool.map(partial(_read_or_cause, unit=unit), paths))
    core.tell_four_legs([take for take in read if not isinstance(take, str)])
    return read


def read_all(paths: Sequence[Path]) -> list[tuple[Path, core.Take | str]]:
    """Each take of each file, those of Blender's importers among them, or why a file cannot be read."""
    others = [path for path in paths if by_blender.needs_blender(path)]
    own = [path for path in paths if path not in others]
    read = dict(zip(own, ([take] for take in read_each(own))))
    told = [(path, take) for path in paths for take in (read[path] if path in read else _of_others(path))]
    core.tell_four_legs([take for _, take in told if isinstance(take, core.Take)])
    return told


def _of_others(path: Path) -> Sequence[core.Take | str]:
    try:
        by_blender.check()
    except ValueError as error:
        return [f"{path}: {error}"]
    try:
        return by_blender.read_takes(path)
    except ValueError as error:
        return [str(error)]


def _read_or_cause(path: Path, unit: float) -> core.Take | str:
    try:
        return read_take(path, unit)
    except (ValueError, OSError) as error:
        return str(error)


def read_mended(paths: Sequence[Path], unit: float | None) -> list[FileTake]:
    """The takes, with what is surely wrong put right and said; a file that cannot be read, or that holds a single pose,
    is named and left out. ValueError where that is each of them. `unit`: m in one of a BVH file; None: the body's size
    tells."""
    others = [path for path in paths if by_blender.needs_blender(path)]
    own = [path for path in paths if path not in others]
    read = read_each(own, UNIT if unit is None else unit)
    takes = [FileTake(path, take) for path, take in zip(own, read) if not isinstance(take, str)]
    by_others, causes = _read_by_blender(others)
    takes += by_others
    causes += [cause for cause in read if isinstance(cause, str)]
    causes += [f"{each.path}: holds a single pose, no motion" for each in takes if not _moves(each)]
    takes = list(filter(_moves, takes))
    if not takes:
        raise ValueError("; ".join(causes))
    for cause in causes:
        say(f"left out: {cause}")
    examined = core.examine([each.take for each in takes], progress=hear)
    return [_mended(each, examination, unit is not None) for each, examination in zip(takes, examined)]


def _read_by_blender(paths: Sequence[Path]) -> tuple[list[FileTake], list[str]]:
    """All takes of files that Blender reads, and why others cannot be read; one cause for all where there is no bpy."""
    takes: list[FileTake] = []
    causes: list[str] = []
    if not paths:
        return takes, causes
    try:
        by_blender.check()
    except ValueError as error:
        return takes, [f"{with_more([str(path) for path in paths])}: {error}"]
    for path in paths:
        try:
            takes += [FileTake(path, take) for take in by_blender.read_takes(path)]
        except ValueError as error:
            causes.append(str(error))
    core.tell_four_legs([each.take for each in takes])
    return takes, causes


def _moves(each: FileTake) -> bool:
    return len(each.take.rotations) >= _FEWEST


def hear(_fraction: float, _stage: str) -> None:
    """Python hears of Ctrl+C whenever it is called."""


def _mended(each: FileTake, examination: core.Examination, keeps_unit: bool) -> FileTake:
    chosen = [f for f in examination.findings if f.safe and not (keeps_unit and f.code == _OF_UNIT)]
    if not chosen:
        return each
    codes = dict.fromkeys(finding.code for finding in chosen)
    for code in codes:
        texts = [finding.text for finding in chosen if finding.code == code]
        say(f"{each.path.name}: mended: {with_more(texts)}")
    return FileTake(each.path, core.mend(each.take, chosen, progress=hear))


def with_more(texts: Sequence[str]) -> str:
    """The first of several like texts, and how many more there are."""
    return texts[0] + (f" (and {len(texts) - 1} more like it)" if len(texts) > 1 else "")


def on_one_body(takes: Sequence[FileTake]) -> tuple[core.Skeleton, list[core.Clip]]:
    """The first take's skeleton, and all takes on it; those of a body of other proportions are brought over, and it is
    said, so that their feet stand."""
    skeletons = [each.take.skeleton for each in takes]
    first, *others = core.group_skeletons(skeletons)
    skeleton = skeletons[0]
    clips = {index: core.Clip.from_take(takes[index].take, skeleton) for index in first}
    known = list(clips.values())
    for group in others:
        clips.update(zip(group, _brought_over([takes[index] for index in group], skeleton, known)))
    return skeleton, [clips[index] for index in range(len(takes))]


def _brought_over(takes: Sequence[FileTake], skeleton: core.Skeleton, known: Sequence[core.Clip]) -> list[core.Clip]:
    """Takes of one other skeleton on this one, of which clips are known; as they are where they cannot be brought."""
    own = takes[0].take.skeleton
    clips = [core.Clip.from_take(each.take, own) for each in takes]
    who = f"{with_more([each.path.name for each in takes])}: of a body of other proportions, {own.stature:.2f} m tall,"
    try:
        brought = core.Retarget(core.Body(own, clips), core.Body(skeleton, known)).apply_all(clips)
    except ValueError as error:
        say(f"{who} on one of {skeleton.stature:.2f} m as it is, so that feet may float or sink: {error}")
        return [core.Clip.from_take(each.take, skeleton) for each in takes]
    say(f"{who} brought onto one of {skeleton.stature:.2f} m")
    return [result.clip for result in brought]


def led_by_feet(clip: core.Clip, skeleton: core.Skeleton, speed: float = 0) -> list[Led]:
    """The clip; one that goes on the spot on the way that its feet tell, at `speed` m/s where that is told, and
    straight ahead at that where they tell none. One that holds several motions one after the other, some of which go on
    the spot, in its parts: what lies between two that have a gap between them is in none."""
    spans = [] if speed else clip.motions_within(skeleton)
    if spans:
        return [_led(span[0], part_of(clip, skeleton, clip.name, slice(*span)), skeleton, 0) for span in spans]
    ends = [*clip.discontinuities(skeleton), len(clip.root_positions)]
    parts = [slice(*span) for span in zip([0, *ends], ends) if span[1] - span[0] >= _FEWEST]
    if len(ends) > 1:
        led = [_led(part.start, part_of(clip, skeleton, clip.name, part), skeleton, 0) for part in parts]
        if any(each.speed for each in led):
            return led
    return [_led(0, clip, skeleton, speed)]


def _led(first: int, part: core.Clip, skeleton: core.Skeleton, speed: float) -> Led:
    way = part.led_by_feet(skeleton, speed)
    return Led(first, way[0], way[1] or speed, way[1] > 0) if way else Led(first, part, 0)


def part_of(clip: core.Clip, skeleton: core.Skeleton, name: str, part: slice) -> core.Clip:
    """Some frames of a clip, with their markers, as a clip of that name."""
    markers = [(at - part.start, text) for at, text in clip.markers if part.start <= at <= part.stop - 1]
    cut = core.Clip(skeleton, name, clip.rate, clip.root_positions[part], clip.rotations[part])
    return (cut.as_led() if clip.led else cut).with_markers(markers)
