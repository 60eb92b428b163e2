# SPDX-License-Identifier: MIT
"""A skeleton from the hips down, and motions on it, as arrays at RATE frames a second."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import fragmotion_core as core
import numpy as np
from fragmotion_command.evaluate import rotations as q
from fragmotion_command.evaluate.rotations import Array
from scipy.interpolate import CubicSpline

from tools.shell import Failure

RATE = 60.0
_SIDES = ("left", "right")
_SWAY = 0.25 * RATE  # frames: standard deviation of what is smoothed by
_LONGEST_REST = 1e-9  # s by which a take's end may be missed


class Motion(NamedTuple):
    """What a body does."""

    name: str
    root: Array  # [F,3] m: the hips' place
    rotations: Array  # [F,B,4]: the hips' in the world, every other bone's in its parent


@dataclass(frozen=True)
class Body:
    """The bones of the hips' tree, parents first; bone 0 is the hips. Pairs are left and right."""

    skeleton: core.Skeleton
    bones: list[int]  # of the skeleton
    parents: list[int]
    offsets: Array  # [B,3] m
    legs: list[list[int]]  # thigh, shin, foot and toe of both sides
    leg_bones: list[int]  # these and all above them, parents first
    chest: int
    right: Array  # unit, from the left thigh to the right one, in the hips' frame
    scale: float  # 1.8 m / stature

    @property
    def feet(self) -> list[int]:
        """Ankles."""
        return [leg[2] for leg in self.legs]

    @property
    def toes(self) -> list[int]:
        """Balls of the feet."""
        return [leg[3] for leg in self.legs]

    def clip(self, motion: Motion) -> core.Clip:
        """The motion as the core has it; the bones above the hips rest."""
        rotations = np.tile([1.0, 0, 0, 0], (len(motion.root), len(self.skeleton.names), 1))
        rotations[:, self.bones] = motion.rotations
        return core.Clip(self.skeleton, motion.name, RATE, motion.root, rotations)


def body_of(skeleton: core.Skeleton) -> Body:
    """Failure where a skeleton has no legs of thigh, shin, foot and toe, which motion matching's features need."""
    hips = skeleton.names.index(skeleton.roles["hips"])
    bones = [hips]
    for bone, parent in enumerate(skeleton.parents):
        if parent in bones:
            bones.append(bone)
    parents = [-1] + [bones.index(skeleton.parents[bone]) for bone in bones[1:]]
    roles = {role: bones.index(skeleton.names.index(name)) for role, name in skeleton.roles.items()}
    legs = [_leg(side, roles, parents) for side in _SIDES]
    offsets = np.array(skeleton.offsets)[bones]
    up = [_above(leg[0], parents) for leg in legs]
    return Body(
        skeleton,
        bones,
        parents,
        offsets,
        legs,
        sorted({bone for leg, way in zip(legs, up) for bone in (*leg, *way)}),
        _chest(roles.get("head", 0), parents),
        q.unit(_place(legs[1][0], parents, offsets) - _place(legs[0][0], parents, offsets)),
        1.8 / skeleton.stature,
    )


def _leg(side: str, roles: dict[str, int], parents: list[int]) -> list[int]:
    missing = [part for part in ("thigh", "foot", "toe") if f"{side}_{part}" not in roles]
    if missing:
        raise Failure(f"motion matching needs a {side} {missing[0]}, and the takes' skeleton has none that is known")
    thigh, foot, toe = (roles[f"{side}_{part}"] for part in ("thigh", "foot", "toe"))
    shin = parents[foot]
    if parents[shin] != thigh or parents[toe] != foot:
        raise Failure(f"motion matching needs a {side} leg of thigh, shin, foot and toe, each the next one's parent")
    return [thigh, shin, foot, toe]


def _above(bone: int, parents: list[int]) -> list[int]:
    above = []
    while bone > 0:
        bone = parents[bone]
        above.append(bone)
    return above


def _chest(head: int, parents: list[int]) -> int:
    """Two bones below the head: where the neck begins."""
    for _ in range(2):
        head = max(0, parents[head])
    return head


def _place(bone: int, parents: list[int], offsets: Array) -> Array:
    """In the hips' frame, of a bone between which and the hips none turns."""
    place = np.zeros(3)
    while bone > 0:
        place = place + offsets[bone]
        bone = parents[bone]
    return place


def world(body: Body, root: Array, rotations: Array, bones: Sequence[int] | None = None) -> tuple[Array, Array]:
    """Heads [...,B,3] and world rotations [...,B,4], of all bones or those of `bones`, which hold their parents; the
    others are not set."""
    heads, oriented = np.empty((*rotations.shape[:-1], 3)), np.empty_like(rotations)
    heads[..., 0, :], oriented[..., 0, :] = root, rotations[..., 0, :]
    for bone in (bones or range(len(body.parents)))[1:]:
        parent = body.parents[bone]
        heads[..., bone, :] = heads[..., parent, :] + q.rotate(oriented[..., parent, :], body.offsets[bone])
        oriented[..., bone, :] = q.multiply(oriented[..., parent, :], rotations[..., bone, :])
    return heads, oriented


def hips_heading(body: Body, rotations: Array) -> Array:
    """[F] rad, unwrapped, of the line between the thighs; 0 faces +y."""
    right = q.rotate(rotations[:, 0], body.right)
    return np.unwrap(np.arctan2(right[:, 1], right[:, 0]))


def facing(body: Body, rotations: Array) -> Array:
    """[F] rad, unwrapped: where the body faces, as the core tells it. It is the hips' heading, smoothed: the middle of
    the line that fits what is around each frame best, weighted by a Gaussian."""
    reach = np.arange(-round(3 * _SWAY), round(3 * _SWAY) + 1)
    weight = np.exp(-0.5 * (reach / _SWAY) ** 2)
    heading = hips_heading(body, rotations)

    def moment(power: int, values: Array) -> Array:
        sums: Array = np.correlate(np.pad(values, reach[-1]), weight * reach**power, "valid")
        return sums

    w, wx, wxx = (moment(power, np.ones(len(heading))) for power in range(3))
    wy, wxy = (moment(power, heading) for power in range(2))
    line: Array = (wy * wxx - wxy * wx) / (w * wxx - wx * wx)
    return line


def derived(values: Array) -> Array:
    """Central differences a second along axis 0."""
    differences: Array = np.gradient(values, axis=0) * RATE
    return differences


def motion_of(body: Body, clip: core.Clip) -> Motion:
    """A clip at RATE, by cubic splines."""
    rotations = q.continuous(np.array(clip.rotations)[:, body.bones])
    times = np.arange(len(rotations)) / clip.rate
    new = np.arange(int(times[-1] * RATE + _LONGEST_REST) + 1) / RATE
    root = CubicSpline(times, clip.root_positions)(new)
    return Motion(clip.name, root, q.unit(CubicSpline(times, rotations)(new)))
