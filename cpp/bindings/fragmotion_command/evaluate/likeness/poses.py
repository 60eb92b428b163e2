# SPDX-License-Identifier: MIT
"""Motions, of whatever rate and maker, as poses alike: 60 a second, and no more in them than 30 a second can hold."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.ndimage import gaussian_filter1d

from ...core import core
from ..rotations import Array, continuous, unit

RATE = 60.0  # poses a second
_LOW_PASS = 0.033 * RATE  # frames: standard deviation of what is smoothed by
_TURN = round(RATE / 30)  # frames over which turns are told
_SIDES = ("left", "right")


@dataclass(frozen=True)
class Body:
    """The bones of the hips' tree, and among these, by their places in it, those that are looked at; pairs are left and
    right."""

    skeleton: core.Skeleton
    bones: list[int]  # of the skeleton
    hips: int
    head: int
    thighs: list[int]
    hands: list[int]
    balls: list[int]  # of the feet; ankles where there are no toes


class Poses(NamedTuple):
    """What a body does."""

    raw: Array  # [F,B,3] m: places, whatever is in them
    heads: Array  # [F,B,3] m: the same, low-passed
    turns: Array  # [F-2,B] rad/s at which each bone turns in the world, over a thirtieth of a second


def body_of(skeleton: core.Skeleton) -> Body:
    """ValueError where a skeleton lacks a bone that is looked at."""
    roles = {role: skeleton.names.index(name) for role, name in skeleton.roles.items()}
    for side in _SIDES:
        roles.setdefault(f"{side}_toe", roles.get(f"{side}_foot", -1))
    looked_at = ["hips", "head", *(f"{side}_{part}" for part in ("thigh", "hand", "toe") for side in _SIDES)]
    missing = [role.replace("_", " ") for role in looked_at if roles.get(role, -1) < 0]
    if missing:
        raise ValueError(f"the takes' skeleton has no {missing[0]} that is known")
    bones = [roles["hips"]]
    for bone, parent in enumerate(skeleton.parents):
        if parent in bones:
            bones.append(bone)
    hips, head, *pairs = (bones.index(roles[role]) for role in looked_at)
    return Body(skeleton, bones, hips, head, pairs[:2], pairs[2:4], pairs[4:])


def poses_of(body: Body, clip: core.Clip) -> Poses:
    """A clip's, by cubic splines."""
    heads, rotations = (part[:, body.bones] for part in clip.world_transforms(body.skeleton))
    seconds = np.arange(len(heads)) / clip.rate
    new = np.arange(0, seconds[-1], 1 / RATE)
    heads, rotations = (CubicSpline(seconds, values)(new) for values in (heads, continuous(rotations)))
    smooth = gaussian_filter1d(heads, _LOW_PASS, axis=0, mode="nearest")
    return Poses(heads, smooth, turn_rates(unit(rotations)))


def turn_rates(rotations: Array) -> Array:
    """[F-2,B] rad/s between world rotations [F,B,4] that are a thirtieth of a second apart."""
    cosine = np.abs(np.sum(rotations[_TURN:] * rotations[:-_TURN], -1)).clip(0, 1)
    rates: Array = 2 * np.arccos(cosine) * RATE / _TURN
    return rates


def heading(body: Body, heads: Array) -> Array:
    """[F] rad, unwrapped, of the line between the thighs; 0 faces +y."""
    left, right = (heads[:, thigh, :2] for thigh in body.thighs)
    across = right - left
    return np.unwrap(np.arctan2(across[:, 1], across[:, 0]))


def derived(values: Array, times: int = 1) -> Array:
    """Central differences a second along axis 0, so many times over."""
    for _ in range(times):
        values = np.gradient(values, 1 / RATE, axis=0)
    return values
