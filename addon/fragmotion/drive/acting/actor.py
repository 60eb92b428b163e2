# SPDX-License-Identifier: GPL-3.0-or-later
"""What plays an armature."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import bpy

from ...bake.performing import character_frame, origin_frame
from ...character.building import check_skeleton, has_character, in_styles, load, make_player
from ...compat.core import core
from ...errors import core_errors
from ...ground.meshes import Ground
from ...input.steering import Control
from ...rig.posing import check_free
from ...rig.rigs import carriers, make_rig
from .joined import Joined, Pose
from .slider import Slider

if TYPE_CHECKING:
    from fragmotion_core import ControlSpace, Doubles

    from ...rig.motion import Motion


class Actor:
    """Plays an armature's character, or lets the body slide where it has none. UserError where it cannot be driven.

    It begins where its DriveSettings.start says. Its character stands on `ground`; what slides, slides on the plane.
    """

    def __init__(
        self,
        context: bpy.types.Context,
        obj: bpy.types.Object,
        seed: int,
        policy: str = "",
        ground: Ground | None = None,
    ) -> None:
        check_free(obj)
        self._obj, self.rig = obj, make_rig(obj)
        self.skeleton = self.rig.skeleton
        carriers(obj, self.rig)
        self.character = load(obj) if has_character(obj) else None
        self.policy = policy or (self.character.policy if self.character else "")
        self._spaces = [styled.space for styled in in_styles(self.character)] if self.character else []
        self.player: Any
        if self.character is None:
            self._spaces = [core.ControlSpace()]
            self.player = Slider(self.skeleton, self.space)
        else:
            check_skeleton(obj, self.character, self.rig)
            with core_errors("Drive"):
                self.player = make_player(obj, self.character, seed, policy)
                self.player.stand_on(ground)
        self._joined: Joined | None = None
        self._pose: Pose
        stands = obj.fragmotion.drive.start == "CHARACTER"
        self.player.reset(*(character_frame(context, obj, self.rig) if stands else origin_frame(obj)))

    def step(self, control: Control, seconds: float) -> tuple[Doubles, Doubles]:
        """Play on, and return the pose: root position [3] and rotations [B,4]."""
        root, rotations = self.player.step(control, seconds)
        if self._joined is None:
            return root, rotations
        self._pose = self._joined.show(Pose(root, rotations, self.player.frame))
        return self._pose.root, self._pose.rotations

    @property
    def style(self) -> int:
        """The number of the style that plays."""
        return 0 if self.character is None else int(self.player.playing_style)

    @property
    def space(self) -> ControlSpace:
        """What controls mean in the style that plays."""
        return self._spaces[self.style if len(self._spaces) > 1 else 0]

    def turns_well(self) -> tuple[bool, bool]:
        """Whether it turns about as fast as it is told while it walks, and while it runs."""
        if self.character is None:
            return True, True
        walking, running = core.turns_well(self.character, self.policy, self.style)
        return walking, running

    def join_on(self, shown: Motion) -> None:
        """Show what a recording showed that begins now, until `take_over`."""
        assert self.character is not None
        root, rotations = self.step(Control(), 0.0)
        self._pose = Pose(root, rotations, self.frame)
        self._joined = Joined(self.character, shown, self._pose)

    def take_over(self) -> None:
        """Show what is played from the next step on, joined on to what the recording showed."""
        if self._joined is not None:
            self._joined.take_over()

    @property
    def is_joined(self) -> bool:
        """Whether it is shown joined on to what a recording showed."""
        return self._joined is not None

    def begin(self, frame: Sequence[float], style: int = 0) -> None:
        """Stand at a character frame, in a style."""
        self._joined = None
        if self.character is None:
            self.player.reset(*frame)
        else:
            self.player.reset(*frame, style=style)

    def start_afresh(self) -> None:
        """Stand where the character is, as a replay will begin."""
        self.begin(self.frame, self.style)

    @property
    def frame(self) -> tuple[float, float, float]:
        """Where the character is, m, and its heading, radians from +Y."""
        frame: tuple[float, float, float] = self.player.frame if self._joined is None else self._pose.frame
        return frame
