# SPDX-License-Identifier: MIT
"""What the characters show of the frames that play: the roots' ways and the poses, both inertialized at transitions."""

from __future__ import annotations

import numpy as np
from fragmotion_command.evaluate import rotations as q
from fragmotion_command.evaluate.rotations import Array, turned, wrapped

from tools.measuring.peers.kinematics.bodies import RATE
from tools.measuring.peers.kinematics.springs import faded, share
from tools.measuring.peers.motion_matching.constants import Constants
from tools.measuring.peers.motion_matching.library import Frames
from tools.measuring.peers.motion_matching.simulation import Simulation

_DT = 1 / RATE


class RootTrack:
    """N roots that move as their frames' do. What is shown, place [N,2] and heading [N], is `base` and a fading
    offset."""

    def __init__(self, frames: Frames, playing: Array, constants: Constants) -> None:
        self._frames, self._constants = frames, constants
        count = len(playing)
        self._base, self._base_heading = np.zeros((count, 2)), np.zeros(count)
        self._off, self._off_velocity = np.zeros((count, 2)), np.zeros((count, 2))
        self._off_heading, self._off_turning = np.zeros(count), np.zeros(count)
        self.show(playing)

    def show(self, playing: Array) -> None:
        """Set what is shown while these frames play."""
        frames = self._frames
        self.place, self.heading = self._base + self._off, self._base_heading + self._off_heading
        velocity = turned(frames.velocity[playing], self._base_heading - frames.heading[playing])
        self.velocity = velocity + self._off_velocity
        self.turning = frames.turning[playing] + self._off_turning

    def go_to(self, who: Array, frame: Array) -> None:
        """The characters `who` go to new frames: what they show goes on from here, and what differs fades."""
        frames = self._frames
        self._base[who], self._base_heading[who] = self.place[who], self.heading[who]
        self._off[who], self._off_heading[who] = 0, 0
        new = turned(frames.velocity[frame], self.heading[who] - frames.heading[frame])
        self._off_velocity[who] = self.velocity[who] - new
        self._off_turning[who] = self.turning[who] - frames.turning[frame]

    def advance(self, before: Array, after: Array) -> None:
        """From frames to those that follow them in their takes."""
        frames = self._frames
        step = frames.place[after] - frames.place[before]
        self._base = self._base + turned(step, self._base_heading - frames.heading[before])
        self._base_heading = self._base_heading + frames.heading[after] - frames.heading[before]
        blend = self._constants.blend
        self._off, self._off_velocity = faded(self._off, self._off_velocity, blend, _DT)
        self._off_heading, self._off_turning = faded(self._off_heading, self._off_turning, blend, _DT)
        self.show(after)

    def draw_to(self, simulation: Simulation, scale: float) -> None:
        """Move and turn what is shown toward the simulated objects: a share of the way, no faster than a share of its
        own speed, but never further from them than is allowed. `scale`: 1.8 m / stature."""
        by = self._drawn(simulation.place - self.place)
        turn = self._drawn_turn(wrapped(simulation.heading - self.heading))
        by = by + _pull(self.place + by - simulation.place, self._constants.farthest / scale)
        wide = wrapped(self.heading + turn - simulation.heading)
        turn = turn + np.clip(wide, -self._constants.widest, self._constants.widest) - wide
        self.place, self._base = self.place + by, self._base + by
        self.heading, self._base_heading = self.heading + turn, self._base_heading + turn

    def _drawn(self, way: Array) -> Array:
        by = share(self._constants.place_halflife, _DT) * way
        most = self._constants.ratio * np.linalg.norm(self.velocity, axis=1) * _DT
        return by + _pull(by, most)

    def _drawn_turn(self, angle: Array) -> Array:
        most = self._constants.ratio * np.abs(self.turning) * _DT
        return np.clip(share(self._constants.heading_halflife, _DT) * angle, -most, most)


def _pull(vectors: Array, most: Array | float) -> Array:
    """What brings vectors [N,2] to a length of `most` where they are longer."""
    length = np.linalg.norm(vectors, axis=1)
    factor = np.where(length > most, most / np.maximum(length, 1e-12) - 1, 0.0)
    pull: Array = vectors * factor[:, None]
    return pull


class PoseTrack:
    """N poses: their frames' and an offset of every bone that fades, as a vector of axis times angle."""

    def __init__(self, frames: Frames, count: int, constants: Constants) -> None:
        self._frames, self._blend = frames, constants.blend
        bones = frames.rotations.shape[1]
        self._hips, self._hips_velocity = np.zeros((count, 3)), np.zeros((count, 3))
        self._turns, self._spins = np.zeros((count, bones, 3)), np.zeros((count, bones, 3))

    def go_to(self, who: Array, before: Array, after: Array) -> None:
        """The characters `who` leave frames for others: the poses that they show go on, and what differs fades."""
        frames = self._frames
        self._hips[who] += frames.hips[before] - frames.hips[after]
        self._hips_velocity[who] += frames.hips_velocity[before] - frames.hips_velocity[after]
        shown = q.multiply(q.of_vector(self._turns[who]), frames.rotations[before])
        self._turns[who] = q.to_vector(q.multiply(shown, q.inverse(frames.rotations[after])))
        self._spins[who] += frames.spins[before] - frames.spins[after]

    def fade(self) -> None:
        """A frame goes by."""
        self._hips, self._hips_velocity = faded(self._hips, self._hips_velocity, self._blend, _DT)
        self._turns, self._spins = faded(self._turns, self._spins, self._blend, _DT)

    def shown(self, playing: Array, root: RootTrack) -> tuple[Array, Array]:
        """The hips' places [N,3] in the world and the rotations [N,B,4]."""
        frames = self._frames
        hips = q.turned_flat(frames.hips[playing] + self._hips, root.heading)
        hips[:, :2] += root.place
        rotations = q.multiply(q.of_vector(self._turns), frames.rotations[playing])
        rotations[:, 0] = q.multiply(q.about_z(root.heading), rotations[:, 0])
        return hips, rotations
