# SPDX-License-Identifier: GPL-3.0-or-later
"""A storyboard played by a character: where it is to be by when, and what it does there, one after another."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

from ..compat.core import core
from ..recordings.looks import Aim, LookChange
from ..recordings.recordings import POSE_RATE, TRACE_RATE

if TYPE_CHECKING:
    from fragmotion_core import Character, PathFollower, Player

_STEPS = POSE_RATE // TRACE_RATE
_STAND = (0.0, 0.0, 0.0, 0.0)
_THERE = 0.2  # m: nearer than this it need not go
_LATEST = 30.0  # s by which it may be late
_REST = 1.0  # s that it stays at the end


class Beat(NamedTuple):
    """An entry: by how many seconds after the beginning it is to be at a place on the ground (None: where it is), in a
    style and looking somewhere on the way; then it does a move (-1: none)."""

    name: str
    seconds: float
    place: tuple[float, float] | None = None
    style: int = 0
    move: int = -1
    aim: Aim = Aim()


class Played(NamedTuple):
    """A trace's controls and, as Player.run has them, the moves, styles and looks in it; and when each beat was there,
    s."""

    trace: list[Sequence[float]]
    moves: list[list[int]]
    styles: list[list[int]]
    looks: list[LookChange]
    reached: list[float]


def play(character: Character, player: Player, beats: Sequence[Beat]) -> Played:
    """What the player, which has just been reset in the first beat's style, does of the beats, whose times ascend."""
    stage = _Stage(character, player, beats[0].style)
    for beat, following in zip(beats, [*beats[1:], None]):
        stage.change_style(beat.style)
        stage.look(beat.aim)
        stage.go_to(beat)
        stage.reached.append(stage.seconds)
        if beat.move >= 0:
            stage.do(beat.move, following)
    if not stage.is_held:
        stage.stand(_REST)
    return Played(stage.trace, stage.moves, stage.styles, stage.looks, stage.reached)


class _Stage:
    """What has been played so far."""

    def __init__(self, character: Character, player: Player, style: int) -> None:
        self.trace: list[Sequence[float]] = []
        self.moves: list[list[int]] = []
        self.styles: list[list[int]] = []
        self.looks: list[LookChange] = []
        self.reached: list[float] = []
        self._character, self._player = character, player
        self._style, self._aim = style, Aim()

    @property
    def is_held(self) -> bool:
        """Whether it ends in a move that is held."""
        return bool(self.moves) and sum(self.moves[-1][::2]) == len(self.trace)

    @property
    def seconds(self) -> float:
        """How long it is."""
        return len(self.trace) / TRACE_RATE

    def change_style(self, style: int) -> None:
        """Go on in this style."""
        if style != self._style:
            self.styles.append([len(self.trace), style])
            self._player.change_style(style)
            self._style = style

    def look(self, aim: Aim) -> None:
        """Look there from now on."""
        if aim != self._aim:
            self.looks.append(LookChange(len(self.trace), *aim))
            self._player.look(*aim)
            self._aim = aim

    def stand(self, seconds: float) -> None:
        """Stay for a while."""
        end = self.seconds + seconds
        while self.seconds < end:
            self._step(_STAND)

    def go_to(self, beat: Beat) -> None:
        """Be at the beat's place by its time, or as soon as it can."""
        follower = self._follower(beat, max(beat.seconds - self.seconds, 1 / TRACE_RATE))
        if follower is None:
            return self.stand(beat.seconds - self.seconds)
        while not (follower.stands and self.seconds >= beat.seconds):
            if self.seconds > beat.seconds + _LATEST:
                break
            self._step(tuple(follower.steer(self._player.frame, 1 / TRACE_RATE)))
        return None

    def do(self, move: int, following: Beat | None) -> None:
        """Do a move once; one with a loop until it must leave for the next beat, or to the end where there is none."""
        what, begins = self._character.moves[move], len(self.trace)
        begin, end = what.loop
        self._player.start_move(move)
        self._step(_STAND)
        if end > begin and following is None:
            self.stand(what.wait + end + _REST)
            self.moves.append([begins, move, len(self.trace) - begins])
            return
        if end > begin and following is not None:
            ending = (len(what.clip.root_positions) - 1) / what.clip.rate - end
            self.stand(following.seconds - ending - self._way_to(following) - self.seconds)
        self._player.release_move(move)
        self.moves.append([begins, move, len(self.trace) - begins])
        while not what.upper_body and move in (self._player.playing_moves[0], self._player.waiting_moves[0]):
            self._step(_STAND)

    def _way_to(self, beat: Beat) -> float:
        """How long it walks to a beat, s."""
        follower = self._follower(beat)
        return 0.0 if follower is None else float(follower.seconds_left)

    def _follower(self, beat: Beat, arrive: float = 0.0) -> PathFollower | None:
        """What leads to the beat's place; None where it is there."""
        x, y, _ = self._player.frame
        if beat.place is None or math.dist((x, y), beat.place) < _THERE:
            return None
        space = self._character.in_style(self._player.playing_style).space
        follower: PathFollower = core.PathFollower(space, core.Path([(x, y), beat.place]), arrive=arrive)
        return follower

    def _step(self, control: Sequence[float]) -> None:
        self.trace.append(control)
        for _ in range(_STEPS):
            self._player.step(control, 1 / POSE_RATE)
