# SPDX-License-Identifier: MIT
"""What a policy file keeps of the takes that a character is built from: how much of them, how large, how soon read."""

from __future__ import annotations

import time
from dataclasses import dataclass

import fragmotion_core as core
import numpy as np
from fragmotion_command.evaluate.loading import Recordings
from numpy.typing import NDArray

from tests.python.policy_reader import Clip, read_policy

_LOADS = 20


@dataclass(frozen=True)
class Stored:
    """Of a character: takes and their frames; bytes of its file, of which for each rotation of a bone in a frame of a
    take or of its image; how far bones' ends are off at most, m; seconds of CPU that the file takes to load."""

    takes: int
    frames: int
    file_bytes: int
    bytes_a_rotation: float
    off: float
    load_seconds: float


def policy_of(recordings: Recordings) -> bytes:
    """The file of a character of these takes, built with the defaults."""
    return core.build(recordings.skeleton, recordings.clips, [core.simulate_trace("explorer", 60, 1)]).to_bytes()


def measure_stored(recordings: Recordings, data: bytes) -> Stored:
    """Read their file."""
    skeleton, takes = recordings.skeleton, recordings.clips
    images = core.mirrored(skeleton, takes)
    clips = read_policy(data).styles[0].clips[: 2 * len(takes)]
    rotations = sum(clip.rotations.shape[0] * clip.rotations.shape[1] for clip in clips)
    kept = [
        (clip, take) for clip, take in zip(clips, [*takes, *images]) if len(clip.places) == len(take.root_positions)
    ]
    off = max(_off(skeleton, clip, take) for clip, take in kept)  # cycles go round and round
    size = sum(clip.size for clip in clips)
    frames = sum(len(take.root_positions) for take in takes)
    return Stored(len(takes), frames, len(data), size / rotations, off, min(_load_seconds(data) for _ in range(_LOADS)))


def _load_seconds(data: bytes) -> float:
    start = time.process_time()
    core.Character.from_bytes(data)
    return time.process_time() - start


def _off(skeleton: core.Skeleton, clip: Clip, take: core.Clip) -> float:
    kept = core.Clip(skeleton, clip.name, clip.rate, clip.places, clip.rotations)
    off = _ends(skeleton, kept) - _ends(skeleton, take)
    off[..., 2] -= np.median(off[..., 2])  # by which Build brought the take to the floor of the others
    return float(np.linalg.norm(off, axis=-1).max())


def _ends(skeleton: core.Skeleton, clip: core.Clip) -> NDArray[np.float64]:
    """[F,2B,3]: where bones begin, and their tips; bones above the hips follow these."""
    heads, rotations = clip.world_transforms(skeleton)
    w, axis = rotations[..., :1], rotations[..., 1:]
    across = 2 * np.cross(axis, skeleton.tips)
    tips = heads + skeleton.tips + w * across + np.cross(axis, across)
    below = [_is_below_hips(skeleton, bone) for bone in range(len(skeleton.names))]
    return np.concatenate([heads[:, below], tips[:, below]], 1)


def _is_below_hips(skeleton: core.Skeleton, bone: int) -> bool:
    hips = skeleton.names.index(skeleton.roles["hips"])
    while bone > hips:
        bone = skeleton.parents[bone]
    return bone == hips
