# SPDX-License-Identifier: MIT
"""What motion matching keeps of takes: their frames' poses and velocities, and the features by which it finds them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from fragmotion_command.evaluate import rotations as q
from fragmotion_command.evaluate.rotations import Array
from scipy.ndimage import median_filter
from scipy.signal import savgol_filter

from tools.measuring.peers.kinematics.bodies import RATE, Body, Motion, derived, hips_heading, world
from tools.measuring.peers.motion_matching.constants import Constants
from tools.shell import Failure

AHEAD = (20, 40, 60)  # frames of the path
POSE = 15  # features that tell the pose; the path's follow
FEATURES = POSE + 4 * len(AHEAD)
_PLACE_WINDOW, _HEADING_WINDOW = 31, 61  # frames
_LAST = 30  # frames that tell how a path goes on
_CONTACT_WINDOW = 6  # frames
_STANDING = 0.02  # share of the time in which a point is under where it stands


class Root(NamedTuple):
    """Where a motion's root is: under the chest, facing as the hips do, both smoothed."""

    place: Array  # [F,2] m
    heading: Array  # [F] rad, unwrapped


def root_of(body: Body, motion: Motion, heads: Array) -> Root:
    """Of a motion whose heads [F,B,3] are these."""
    place = _smooth(heads[:, body.chest, :2], _PLACE_WINDOW)
    heading = hips_heading(body, motion.rotations)
    direction = _smooth(np.stack((np.cos(heading), np.sin(heading)), -1), _HEADING_WINDOW)
    return Root(place, np.unwrap(np.arctan2(direction[:, 1], direction[:, 0])))


def _smooth(values: Array, window: int) -> Array:
    window = min(window, len(values) - 1 + len(values) % 2)
    smoothed: Array = savgol_filter(values, window, min(3, window - 1), axis=0, mode="interp")
    return smoothed


class Frames(NamedTuple):
    """Frames of one motion or, one after the other, of many. What is of the root is in the world, what is of the body
    in the root's frame."""

    place: Array  # [F,2] m
    heading: Array  # [F] rad
    velocity: Array  # [F,2] m/s
    turning: Array  # [F] rad/s
    hips: Array  # [F,3] m
    hips_velocity: Array  # [F,3] m/s
    rotations: Array  # [F,B,4]
    spins: Array  # [F,B,3] rad/s
    stopping: Array  # [F,27] features; the path stops at the take's end
    going_on: Array  # [F,27] features; the path goes on there
    ball_speed: Array  # [F,2] m/s of a character of 1.8 m, as the next two
    ball_height: Array  # [F,2] m over where the ball stands
    hips_speed: Array  # [F]


def frames_of(body: Body, motion: Motion, floors: Array) -> Frames:
    """All that is kept of a motion; `floors` [2]: where the balls of the feet stand, m of a character of 1.8 m."""
    heads = world(body, motion.root, motion.rotations)[0]
    root = root_of(body, motion, heads)
    rotations = motion.rotations.copy()
    rotations[:, 0] = q.multiply(q.about_z(-root.heading), rotations[:, 0])
    hips = q.turned_flat(motion.root - _flat(root.place), -root.heading)
    pose = _pose_features(body, heads, root)
    return Frames(
        root.place,
        root.heading,
        derived(root.place),
        derived(root.heading),
        hips,
        derived(hips),
        rotations,
        _spins(rotations),
        np.concatenate((pose, _path_features(root, goes_on=False)), 1),
        np.concatenate((pose, _path_features(root, goes_on=True)), 1),
        np.linalg.norm(derived(heads[:, body.toes]), axis=2) * body.scale,
        heads[:, body.toes, 2] * body.scale - floors,
        np.linalg.norm(derived(heads[:, 0]), axis=1) * body.scale,
    )


def _flat(place: Array) -> Array:
    return np.concatenate((place, np.zeros((*place.shape[:-1], 1))), -1)


def _spins(rotations: Array) -> Array:
    """Angular velocities, by central differences, in the frames that the rotations are relative to."""
    middle = q.to_vector(q.multiply(rotations[2:], q.inverse(rotations[:-2]))) * RATE / 2
    return np.concatenate((middle[:1], middle, middle[-1:]))


def _pose_features(body: Body, heads: Array, root: Root) -> Array:
    """[F,15]: places of the feet, velocities of the feet and of the hips, as the root sees them."""
    feet = [heads[:, foot] for foot in body.feet]
    places = [foot - _flat(root.place) for foot in feet]
    velocities = [derived(point) for point in (*feet, heads[:, 0])]
    return np.concatenate([q.turned_flat(vectors, -root.heading) for vectors in (*places, *velocities)], 1)


def _path_features(root: Root, goes_on: bool) -> Array:
    """[F,12]: where the root will be, and where it will face, as it sees that now."""
    frames = np.arange(len(root.place))
    place, heading = _continued(root) if goes_on else root
    at = [np.minimum(frames + ahead, len(place) - 1) for ahead in AHEAD]
    places = [q.turned(place[later] - root.place, -root.heading) for later in at]
    return np.concatenate((*places, *(directions(heading[later] - root.heading) for later in at)), 1)


def directions(angle: Array) -> Array:
    """Where one faces who turned by an angle from +y."""
    return np.stack((-np.sin(angle), np.cos(angle)), -1)


def _continued(root: Root) -> Root:
    """The path with its last half second's mean velocity and turn rate going on."""
    last = min(_LAST, len(root.place) - 1)
    rate = (root.heading[-1] - root.heading[-1 - last]) / last
    middle = (root.heading[-1] + root.heading[-1 - last]) / 2
    step = q.turned(root.place[-1] - root.place[-1 - last], -middle) / last
    later = root.heading[-1] + rate * np.arange(1, max(AHEAD) + 1)
    steps = np.cumsum(q.turned(np.tile(step, (len(later), 1)), later - rate / 2), 0)
    return Root(np.concatenate((root.place, root.place[-1] + steps)), np.concatenate((root.heading, later)))


def floors_of(body: Body, motions: Sequence[Motion], bones: Sequence[int]) -> Array:
    """Where the heads of bones of the legs stand, m of a character of 1.8 m: the median over the motions of the height
    over which each is nearly always."""
    heights = []
    for motion in motions:
        heads = world(body, motion.root, motion.rotations, body.leg_bones)[0]
        heights.append(np.quantile(heads[:, bones, 2], _STANDING, axis=0, method="lower"))
    found: Array = np.median(heights, axis=0) * body.scale
    return found


class Library(NamedTuple):
    """All takes' frames."""

    frames: Frames
    take: Array  # [F] number of each frame's take
    first: Array  # [F] first frame of each frame's take
    last: Array  # [F]


def library_of(body: Body, motions: Sequence[Motion], floors: Array) -> Library:
    """Of motions of two frames or more."""
    each = [frames_of(body, motion, floors) for motion in motions]
    counts = np.array([len(frames.place) for frames in each])
    first = np.repeat(np.cumsum(counts) - counts, counts)
    joined = Frames(*(np.ascontiguousarray(np.concatenate(parts)) for parts in zip(*each)))
    return Library(joined, np.repeat(np.arange(len(counts)), counts), first, first + np.repeat(counts, counts) - 1)


class Database(NamedTuple):
    """A library as some constants make it."""

    library: Library
    features: Array  # [F,27] float32: less their mean, over their spread, weighted
    offset: Array  # [27]
    scale: Array  # [27]
    allowed: Array  # [F] frames that may be gone to
    contact: Array  # [F,2] balls that stand

    @property
    def bytes(self) -> int:
        """What a program that plays keeps of it, numbers of 4 bytes."""
        kept = [*self.library.frames[:8], self.features]
        return 4 * sum(array.size for array in kept) + self.contact.size


def database_of(library: Library, constants: Constants) -> Database:
    """Failure where no take is long enough for a frame of it to be gone to."""
    raw = library.frames.going_on if constants.goes_on else library.frames.stopping
    allowed = np.arange(len(raw)) <= library.last - constants.ends
    if not allowed.any():
        raise Failure("motion matching needs a take of a second or more, and there is none")
    offset, scale = raw.mean(0), _scales(raw, constants)
    normal = ((raw - offset) / scale).astype(np.float32)
    return Database(library, normal, offset, scale, allowed, _contacts(library, constants))


def _scales(raw: Array, constants: Constants) -> Array:
    """[27]: what each feature is divided by; those of one kind alike."""
    path = 2 * len(AHEAD)
    kinds = [(3, constants.foot_place)] * 2 + [(3, constants.foot_velocity)] * 2 + [(3, constants.hip_velocity)]
    kinds += [(path, constants.places), (path, constants.directions)]
    scales, at = [], 0
    for size, weight in kinds:
        spread = max(float(raw[:, at : at + size].std(0).mean()), 1e-9)
        scales += [spread / weight] * size
        at += size
    return np.array(scales)


def _contacts(library: Library, constants: Constants) -> Array:
    frames = library.frames
    limit = constants.contact_speed + constants.contact_share * frames.hips_speed[:, None]
    stands = (frames.ball_speed < limit) & (frames.ball_height < constants.contact_height)
    takes = np.split(stands.astype(np.uint8), np.flatnonzero(np.diff(library.take)) + 1)
    filtered: Array = np.concatenate([median_filter(take, size=(_CONTACT_WINDOW, 1)) for take in takes])
    return filtered.astype(bool)
