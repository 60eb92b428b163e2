# SPDX-License-Identifier: MIT
"""Takes of any skeletons, by the body that they are of, and bodies of the targets that the core reads."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from ..by_blender import RIGS, read_rig
from ..core import core
from ..evaluate.loading import core_failures
from ..files import BY_BLENDER, find_takes
from ..takes import read_mended
from .roles import make_body


class Source(NamedTuple):
    """Takes of one skeleton, and the files that they are from."""

    skeleton: core.Skeleton
    clips: list[core.Clip]
    paths: list[Path]


def read_sources(paths: Sequence[Path], unit: float | None) -> list[Source]:
    """All takes, mended, those of one skeleton together."""
    read = read_mended(find_takes(paths, BY_BLENDER), unit)
    files, takes = [each.path for each in read], [each.take for each in read]
    groups = core.group_skeletons([take.skeleton for take in takes])
    return [_source([takes[index] for index in group], [files[index] for index in group]) for group in groups]


def _source(takes: Sequence[core.Take], paths: list[Path]) -> Source:
    skeleton = takes[0].skeleton
    clips = []
    for take, path in zip(takes, paths):
        with core_failures(str(path)):
            clips.append(core.Clip.from_take(take, skeleton))
    return Source(skeleton, clips, paths)


def read_body(path: Path, unit: float, roles: Sequence[tuple[str, str]], armature: str | None) -> core.Body:
    """The body of a file's skeleton, or of the rig of that name in it; the motion in a BVH tells how it stands."""
    clips: list[core.Clip] = []
    skin = None
    if path.suffix.lower() in RIGS:
        skeleton, skin = read_rig(path, armature)
    elif path.suffix.lower() == ".asf":
        skeleton = core.read_asf(path)
    else:
        take = core.read_bvh(path, unit)
        skeleton = take.skeleton
        clips = [core.Clip.from_take(take)] if len(take.rotations) > 1 else []
    with core_failures(str(path)):
        return make_body(skeleton, clips, roles, skin)
