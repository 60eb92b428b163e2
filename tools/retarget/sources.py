# SPDX-License-Identifier: MIT
"""Takes of any skeletons, by the body that they are of, and bodies of the targets that the core reads."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import fragmotion_core as core
import numpy as np

from tools.evaluate.inputs import find_takes
from tools.evaluate.loading import core_failures, read_take
from tools.retarget.rigs import OpenRig

_SAME = 1e-3  # m by which the bones of one skeleton may differ from file to file


class Source(NamedTuple):
    """Takes of one skeleton, and the files that they are from."""

    skeleton: core.Skeleton
    clips: list[core.Clip]
    paths: list[Path]


def read_sources(paths: Sequence[Path], unit: float) -> list[Source]:
    """All takes, those of one skeleton together."""
    sources: list[Source] = []
    for file in find_takes(paths):
        with core_failures():
            take = read_take(file, unit)
        source = next((each for each in sources if same(each.skeleton, take.skeleton)), None)
        if source is None:
            source = Source(take.skeleton, [], [])
            sources.append(source)
        with core_failures(str(file.path)):
            source.clips.append(core.Clip.from_take(take, source.skeleton))
        source.paths.append(file.path)
    return sources


def same(a: core.Skeleton, b: core.Skeleton) -> bool:
    """Whether two skeletons have the same bones, wherever they stand."""
    if a.names != b.names or a.parents != b.parents:
        return False
    placed = np.array([name != a.roles["hips"] and parent >= 0 for name, parent in zip(a.names, a.parents)])
    alike = np.allclose(a.offsets[placed], b.offsets[placed], rtol=0, atol=_SAME)
    return alike and np.allclose(a.rest_rotations, b.rest_rotations, rtol=0, atol=_SAME)


def body_of(rig: OpenRig) -> core.Body:
    """The body of an armature."""
    with core_failures(f"Armature '{rig.obj.name}'"):
        return core.Body(rig.skeleton)


def read_body(path: Path, unit: float) -> core.Body:
    """The body of a file's skeleton; the motion in a BVH tells how it stands."""
    with core_failures():
        if path.suffix.lower() == ".asf":
            skeleton, clips = core.read_asf(path), []
        else:
            take = core.read_bvh(path, unit)
            skeleton = take.skeleton
            clips = [core.Clip.from_take(take)] if len(take.rotations) > 1 else []
    with core_failures(str(path)):
        return core.Body(skeleton, clips)
