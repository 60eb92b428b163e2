# SPDX-License-Identifier: MIT
"""Motion matching: ten times a second, look for the frame of all takes that fits the pose that is shown and the path
that the stick asks for, and go on from there.

Written anew after D. Holden's description and the constants of his example program ("Motion Matching", 2020, and
Clavet 2016), for characters that are steered by a velocity as they see it and a turn rate. Many characters are played
at once, each on its own, so that NumPy has something to work on."""

from __future__ import annotations

import time
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from fragmotion_command.evaluate.rotations import Array, turned

from tools.measuring.peers.kinematics.bodies import RATE, Body, Motion
from tools.measuring.peers.kinematics.legs import knee_hinges
from tools.measuring.peers.motion_matching.constants import Constants
from tools.measuring.peers.motion_matching.feet import FootLock
from tools.measuring.peers.motion_matching.library import (
    AHEAD,
    POSE,
    Database,
    Library,
    database_of,
    directions,
    floors_of,
    library_of,
)
from tools.measuring.peers.motion_matching.search import Search
from tools.measuring.peers.motion_matching.showing import PoseTrack, RootTrack
from tools.measuring.peers.motion_matching.simulation import Simulation

_DT = 1 / RATE


class Shown(NamedTuple):
    """What N characters showed."""

    root: Array  # [N,F,3] m
    rotations: Array  # [N,F,B,4]
    entered: Array  # [N,F] transitions since the first frame
    frames: Array  # [N,F] of the database
    seconds: float  # of the processor, all together
    search_seconds: float  # of these in the search


class Material(NamedTuple):
    """What is to be matched: a library and what of the body was read from the takes."""

    body: Body
    library: Library
    hinges: Array  # [2,3] knee_hinges()
    floors: Array  # [2]: where the balls of the feet stand, m of a character of 1.8 m


def material_of(body: Body, motions: Sequence[Motion], made: Sequence[Motion] = ()) -> Material:
    """Of captured motions, and of more that were made of them."""
    floors = floors_of(body, motions, body.toes)
    return Material(body, library_of(body, [*motions, *made], floors), knee_hinges(body, list(motions)), floors)


class Matcher:
    """A database that can be played."""

    def __init__(self, material: Material, constants: Constants | None = None) -> None:
        self.material, self.constants = material, constants or Constants()
        self.database: Database = database_of(material.library, self.constants)
        self.search = Search(self.database, self.constants.ignored, self.constants.transition_cost)

    def still(self, rank: float = 0.0) -> int:
        """A frame to begin with: at this share (0 .. 1) of those that may be gone to, from the slowest on."""
        candidates = np.flatnonzero(self.database.allowed)
        speeds = np.linalg.norm(self.material.library.frames.velocity[candidates], axis=1)
        return int(candidates[np.argsort(speeds)[int(rank * (len(candidates) - 1))]])

    def play(self, controls: Array, starts: Sequence[int]) -> Shown:
        """Play controls [N,F,3] (velocity to the right and forward, m/s; turn rate, rad/s), a frame each, from these
        frames of the database."""
        began = time.process_time()
        game = _Game(self, np.array(starts))
        shown = [game.step(controls[:, frame]) for frame in range(controls.shape[1])]
        root, rotations, entered, frames = (np.stack(parts, 1) for parts in zip(*shown))
        return Shown(root, rotations, entered, frames, time.process_time() - began, game.search_seconds)


class _Game:
    """N characters that play."""

    def __init__(self, matcher: Matcher, starts: Array) -> None:
        self._matcher, self._constants = matcher, matcher.constants
        count, constants = len(starts), matcher.constants
        body, library, hinges, floors = matcher.material
        self._frames, self._last = library.frames, library.last
        self._scale = body.scale
        self._playing = starts.copy()
        self._entered = np.zeros(count, int)
        self._simulation = Simulation(count, constants)
        self._root = RootTrack(library.frames, self._playing, constants)
        self._pose = PoseTrack(library.frames, count, constants)
        self._feet = FootLock(body, hinges, floors, count, constants)
        self._changed = np.zeros(count)
        self._wait, self._wait_forced = np.full(count, constants.search), np.full(count, constants.search)
        self._begun = False
        self.search_seconds = 0.0

    def step(self, control: Array) -> tuple[Array, Array, Array, Array]:
        """Show the next frame under a control [N,3]; the first one is that which the characters start from."""
        changed = self._simulation.command(control, _DT if self._begun else 0.0)
        forced = self._forced(changed / _DT)
        if self._begun:
            self._find(control, forced)
        self._wait -= _DT
        if self._begun:
            self._advance()
        self._begun = True
        root, rotations = self._pose.shown(self._playing, self._root)
        contact = self._matcher.database.contact[self._playing]
        rotations = self._feet.applied(root, rotations, contact)
        return root, rotations, self._entered.copy(), self._playing.copy()

    def _forced(self, changed: Array) -> Array:
        """Who must search because a quick change of the command has just ended."""
        most = self._constants.forced
        forced: Array = (self._wait_forced <= 0) & (self._changed >= most) & (changed < most)
        self._changed = changed
        self._wait_forced = np.where(forced, self._constants.search, self._wait_forced - _DT * (self._wait_forced > 0))
        return forced

    def _find(self, control: Array, forced: Array) -> None:
        ends = self._playing >= self._last[self._playing]
        who = np.flatnonzero(forced | (self._wait <= 0) | ends)
        if not len(who):
            return
        began = time.process_time()
        queries = self._queries(control)
        search = self._matcher.search
        found = np.array([search.best(queries[i], int(self._playing[i]), bool(ends[i])) for i in who])
        self._wait[who] = self._constants.search
        self.search_seconds += time.process_time() - began
        self._go_to(who, found)

    def _queries(self, control: Array) -> Array:
        """[N,27]: the pose that plays, and where the simulated objects will be, as the roots see it."""
        database, root = self._matcher.database, self._root
        places, headings = self._simulation.ahead(control)
        places = turned(places - root.place[:, None], -root.heading[:, None])
        path = np.concatenate((places, directions(headings - root.heading[:, None])), 1)
        path = path.reshape(len(control), 4 * len(AHEAD))
        wanted = (path - database.offset[POSE:]) / database.scale[POSE:]
        return np.concatenate((database.features[self._playing, :POSE], wanted), 1)

    def _go_to(self, who: Array, found: Array) -> None:
        """Those who found another frame than theirs."""
        other = found != self._playing[who]
        who, found = who[other], found[other]
        self._root.go_to(who, found)
        self._pose.go_to(who, self._playing[who], found)
        self._playing[who] = found
        self._entered[who] += 1

    def _advance(self) -> None:
        before = self._playing
        self._playing = np.minimum(before + 1, self._last[before])
        self._root.advance(before, self._playing)
        self._pose.fade()
        self._simulation.step(_DT)
        self._root.draw_to(self._simulation, self._scale)
