# SPDX-License-Identifier: MIT
"""Two-bone inverse kinematics: a leg that brings its ankle to a place, for many legs at once."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from fragmotion_command.evaluate import rotations as q
from fragmotion_command.evaluate.rotations import Array

from tools.measuring.peers.kinematics.bodies import Body, Motion, world

_THIN = 1e-12


class Leg(NamedTuple):
    """Where a leg's joints are, and the axis about which its knee bends; [...,3] each."""

    hip: Array
    knee: Array
    ankle: Array
    hinge: Array


def reach(leg: Leg, target: Array, reserve: float) -> tuple[Array, Array]:
    """World rotations of thigh and shin that bring the ankle to `target`: the knee bends about its hinge, the way knees
    bend, and the thigh swings. `reserve` (m) of the leg's length is never used."""
    upper, lower, way = leg.knee - leg.hip, leg.ankle - leg.knee, target - leg.hip
    long = _dot(upper, upper)
    hinge = q.unit(leg.hinge - (_dot(leg.hinge, upper) / long)[..., None] * upper)
    across = np.sqrt(np.maximum(_THIN, _dot(lower, lower) - _dot(lower, hinge) ** 2))
    most = np.sqrt(long) + np.sqrt(_dot(lower, lower)) - reserve
    far = np.minimum(np.sqrt(_dot(way, way)), most)
    cosine = (far * far - long - _dot(lower, lower)) / (2 * np.sqrt(long) * across)
    bend = np.arccos(np.clip(cosine, -1, 1))
    bent = np.arctan2(_dot(hinge, q.cross(upper, lower)), _dot(upper, lower))
    turn = q.about(hinge, bend - bent)
    swing = q.between(upper + q.rotate(turn, lower), way)
    return swing, q.multiply(swing, turn)


def _dot(a: Array, b: Array) -> Array:
    return np.asarray(np.sum(a * b, -1))


def knee_hinges(body: Body, motions: list[Motion]) -> Array:
    """[2,3]: what the knees bend about in the motions, in the thighs' frames."""
    sums = np.zeros((2, 3))
    for motion in motions:
        heads, oriented = world(body, motion.root, motion.rotations, body.leg_bones)
        for side, (thigh, shin, foot, _) in enumerate(body.legs):
            bend = q.cross(heads[:, shin] - heads[:, thigh], heads[:, foot] - heads[:, shin])
            sums[side] += q.rotate(q.inverse(oriented[:, thigh]), bend).sum(0)
    return q.unit(sums)


def set_balls(
    body: Body, hinges: Array, root: Array, rotations: Array, targets: Array, reserve: float = 0.005
) -> Array:
    """The rotations [...,B,4] whose balls of the feet are at `targets` [...,2,3], as far as legs reach; feet keep their
    orientations in the world."""
    rotations = rotations.copy()
    heads, oriented = world(body, root, rotations, body.leg_bones)
    for side, (thigh, shin, foot, ball) in enumerate(body.legs):
        hip, knee, below = (heads[..., bone, :] for bone in (thigh, shin, foot))
        leg = Leg(hip, knee, below, q.rotate(oriented[..., thigh, :], hinges[side]))
        ankle = targets[..., side, :] + heads[..., foot, :] - heads[..., ball, :]
        swing, bent = reach(leg, ankle, reserve)
        upper, lower = q.multiply(swing, oriented[..., thigh, :]), q.multiply(bent, oriented[..., shin, :])
        above = oriented[..., body.parents[thigh], :]
        rotations[..., thigh, :] = q.multiply(q.inverse(above), upper)
        rotations[..., shin, :] = q.multiply(q.inverse(upper), lower)
        rotations[..., foot, :] = q.multiply(q.inverse(lower), oriented[..., foot, :])
    return rotations
