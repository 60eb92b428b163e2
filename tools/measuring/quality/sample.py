# SPDX-License-Identifier: MIT
"""The sample character's takes in its usual manner, as the core has them."""

from __future__ import annotations

import sys
from functools import cache
from importlib import import_module
from typing import Any

import fragmotion_core as core
import numpy as np
from fragmotion_command.evaluate.loading import Recordings
from fragmotion_command.evaluate.rotations import Array
from scipy.spatial.transform import Rotation

from tools.paths import TOP


@cache
def sample_recordings() -> Recordings:
    """Made anew by sample_rigs, which the sample's .blend is made by."""
    if str(TOP / "sample_rigs") not in sys.path:
        sys.path.append(str(TOP / "sample_rigs"))
    body, gait, takes = (import_module(name) for name in ("body", "gait", "takes"))
    skeleton = _skeleton(body)
    usual = [take for take in takes.all_takes() if not take.manner]
    return Recordings(skeleton, [_clip(skeleton, take.name, takes.FPS, gait.synthesize(take)) for take in usual])


def _skeleton(body: Any) -> core.Skeleton:
    """Its bones' rest frames are the world's axes, from which its rotations are told."""
    bones = body.BONES
    names = [bone.name for bone in bones]
    return core.Skeleton(
        names,
        [names.index(bone.parent) if bone.parent else -1 for bone in bones],
        np.tile([1.0, 0, 0, 0], (len(bones), 1)),
        [bone.head - (body.head(bone.parent) if bone.parent else 0) for bone in bones],
        [bone.tail - bone.head for bone in bones],
    )


def _clip(skeleton: core.Skeleton, name: str, rate: float, motion: Any) -> core.Clip:
    hips = skeleton.roles["hips"]
    matrices = [motion.world[hips] if bone == hips else motion.local(bone) for bone in skeleton.names]
    return core.Clip(skeleton, name, rate, motion.hips, np.stack([_quaternions(each) for each in matrices], 1))


def _quaternions(matrices: Array) -> Array:
    """[F,4] w, x, y, z of [F,3,3]."""
    turns: Array = Rotation.from_matrix(matrices).as_quat()[:, [3, 0, 1, 2]]
    return turns
