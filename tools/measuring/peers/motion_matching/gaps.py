# SPDX-License-Identifier: MIT
"""Motions for the controls that the takes lack, so that motion matching, too, has something to find there: takes whose
path is turned, scaled and bent and their strides with it, as Fragmotion fills its own gaps, and one that stands."""

from __future__ import annotations

from collections.abc import Sequence

import fragmotion_core as core
import numpy as np
from fragmotion_command.evaluate import rotations as q
from fragmotion_command.evaluate.rotations import Array, turned, wrapped
from numpy.typing import ArrayLike

from tools.measuring.peers.kinematics.bodies import RATE, Body, Motion, derived, world
from tools.measuring.peers.kinematics.legs import set_balls
from tools.measuring.peers.motion_matching.library import floors_of, root_of

PERFORMED = 0.3  # ControlDis up to which the takes perform a control
_WIDEST = 0.2  # m of a character of 1.8 m by which each foot is set out
_LEAST = 2.0  # s of a take that is used
_SLOWEST = 0.25  # m/s that a take must move for its direction to be told
_TEMPO = 1.2  # by which a take is played faster or slower, at most
_SWAY = 0.5  # s over which speeds are averaged
_STAND = 3.0  # s


class Source:
    """A take, forward or backward in time, as its root moves."""

    def __init__(self, body: Body, motion: Motion, backward: bool) -> None:
        order = slice(None, None, -1 if backward else 1)
        self.motion = Motion(motion.name, motion.root[order].copy(), motion.rotations[order].copy())
        self.backward = backward
        heads = world(body, self.motion.root, self.motion.rotations)[0]
        self.root = root_of(body, self.motion, heads)
        velocity = turned(derived(self.root.place), -self.root.heading)
        speeds = np.column_stack((velocity, derived(self.root.heading)))
        self.velocity, self.turning = speeds[:, :2].mean(0), float(speeds[:, 2].mean())
        frames = round(_SWAY * RATE)
        steady = np.stack([np.convolve(column, np.full(frames, 1 / frames), "valid") for column in speeds.T], 1)
        self.unsteady = float(np.linalg.norm(steady[:, :2].std(0)) + steady[:, 2].std())

    def effort(self, velocity: Array, turning: float, space: core.ControlSpace) -> float:
        """How much must be changed for it to move so, m/s and rad/s: about 1 for an eighth of a turn of the path, or
        half again the speed."""
        own, speed = float(np.linalg.norm(self.velocity)), float(np.linalg.norm(velocity))
        if own < _SLOWEST:
            return np.inf
        effort = 0.5 * abs(turning - self.turning) / space.turn_rate + self.backward + 2 * self.unsteady
        if speed == 0:
            return effort + own / space.walk
        faster = float(np.log(speed / own) / np.log(1.5))
        effort += abs(float(wrapped(_angle(velocity) - _angle(self.velocity)))) / (np.pi / 4)
        return effort + (faster * faster if faster > 0 else -faster)


def _angle(velocity: Array) -> Array:
    return np.asarray(np.arctan2(velocity[1], velocity[0]))


class Change:
    """How a source becomes one of another mean velocity and turn rate."""

    def __init__(self, source: Source, velocity: Array, turning: float) -> None:
        speed, own = float(np.linalg.norm(velocity)), float(np.linalg.norm(source.velocity))
        moves = speed > 0
        self.direction = float(_angle(velocity) - _angle(source.velocity)) if moves else 0.0
        self.tempo = float(np.clip(np.sqrt(speed / own), 1 / _TEMPO, _TEMPO)) if moves else 1.0
        self.scale = speed / own / self.tempo
        self.bend = (turning - source.turning * self.tempo) / (RATE * self.tempo)  # rad a frame


def transformed(body: Body, source: Source, change: Change, hinges: Array, name: str) -> Motion:
    """The changed source: feet set so that strides fit the path, the path changed, and all of it at the tempo."""
    hips, rotations = _seen_from_root(source)
    balls = _balls(body, hips, rotations, change)
    rotations = set_balls(body, hinges, hips, rotations, balls)
    frames = np.arange(len(hips))
    heading = source.root.heading - source.root.heading[0] + change.bend * frames
    turn = change.direction - source.root.heading[0] + change.bend * (frames[:-1] + 0.5)
    steps = turned(change.scale * np.diff(source.root.place, axis=0), turn)
    place = np.concatenate((np.zeros((1, 2)), np.cumsum(steps, 0)))
    root = q.turned_flat(hips, heading)
    root[:, :2] += place
    rotations[:, 0] = q.multiply(q.about_z(heading), rotations[:, 0])
    times = np.arange(0, len(hips) - 1, change.tempo)
    return Motion(name, _at(root, times), q.unit(_at(q.continuous(rotations), times)))


def _seen_from_root(source: Source) -> tuple[Array, Array]:
    rotations = source.motion.rotations.copy()
    rotations[:, 0] = q.multiply(q.about_z(-source.root.heading), rotations[:, 0])
    hips = source.motion.root.copy()
    hips[:, :2] -= source.root.place
    return q.turned_flat(hips, -source.root.heading), rotations


def _balls(body: Body, hips: Array, rotations: Array, change: Change) -> Array:
    """Where the balls of the feet go [F,2,3], seen from the root: about their mean places turned and scaled like the
    path, and apart as far as it takes for the legs not to cross where they did not."""
    balls = world(body, hips, rotations, body.leg_bones)[0][:, body.toes]
    middle = balls[..., :2].mean(0)
    places = middle + change.scale * turned(balls[..., :2] - middle, np.array(change.direction))
    before, after = (float((p[:, 1, 0] - p[:, 0, 0]).min()) for p in (balls, places))
    apart = np.clip((before - after) / 2, 0, _WIDEST / body.scale)
    balls[..., :2] = places + np.array([[-apart, 0], [apart, 0]])
    return balls


def _at(values: Array, times: Array) -> Array:
    """Between frames, in a straight line."""
    low = times.astype(int)
    share = (times - low).reshape(-1, *[1] * (values.ndim - 1))
    between: Array = (1 - share) * values[low] + share * values[low + 1]
    return between


def standing(body: Body, motions: Sequence[Motion]) -> Motion:
    """The pose of all motions in which the feet are most side by side, low and still, held."""
    floors = floors_of(body, motions, [*body.toes, *body.feet])
    costs = [_standing_costs(body, motion, floors) for motion in motions]
    best = int(np.argmin([cost.min() for cost in costs]))
    frame = int(np.argmin(costs[best]))
    count = round(_STAND * RATE)
    root, rotations = motions[best].root[frame], motions[best].rotations[frame]
    return Motion("stands", np.tile(root, (count, 1)), np.tile(rotations, (count, 1, 1)))


def _standing_costs(body: Body, motion: Motion, floors: Array) -> Array:
    heads = world(body, motion.root, motion.rotations)[0]
    root = root_of(body, motion, heads)
    points = heads[:, [*body.toes, *body.feet]] * body.scale
    local = turned(points[..., :2] - root.place[:, None] * body.scale, -root.heading[:, None])
    raised = np.abs(points[..., 2] - floors).sum(1)
    speed = np.linalg.norm(derived(root.place), axis=1)
    costs: Array = np.abs(local[:, 0, 1] - local[:, 1, 1]) + raised + 0.1 * speed
    return costs


def fill(
    body: Body, motions: Sequence[Motion], space: core.ControlSpace, distances: ArrayLike, hinges: Array
) -> list[Motion]:
    """Motions for every control without a jump that is further than PERFORMED from what the takes perform; `distances`
    [102] tell how far each is. Takes of two seconds or more are changed."""
    long = [motion for motion in motions if len(motion.root) >= _LEAST * RATE]
    sources = [Source(body, motion, backward) for motion in long for backward in (False, True)]
    made = [standing(body, motions)]
    for control, distance in enumerate(np.asarray(distances)):
        x, y, turn, jump = space.points[control]
        if not sources or jump or distance <= PERFORMED or (x == y == turn == 0):
            continue
        velocity, turning = np.array([x, y]), float(turn * space.turn_rate)
        efforts = [source.effort(velocity, turning, space) for source in sources]
        best = sources[int(np.argmin(efforts))]
        if np.isfinite(min(efforts)):
            name = f"{control} of {best.motion.name}"
            made.append(transformed(body, best, Change(best, velocity, turning), hinges, name))
    return made
