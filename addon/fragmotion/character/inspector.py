# SPDX-License-Identifier: GPL-3.0-or-later
"""Why the policy plays what it plays: the classes that might come next, and what speaks for each."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, FloatVectorProperty

from ..compat import versions
from ..compat.core import core
from ..mocap.actions import SCENE_RATE, rate_of
from ..mocap.left_out import source_of
from . import building, classes
from .control_layout import DIRECTIONS, GAITS, ControlLayout, layout_of

if TYPE_CHECKING:
    from fragmotion_core import Alternative, Character

BEST = 5
"""Alternatives that are shown, and the chosen one where it is none of them."""

_STAND = "stand"
_GAITS = (
    (_STAND, "Stand", "No velocity"),
    *((gait, gait.title(), f"At a {gait}, or what is nearest to one of the speeds that it knows") for gait in GAITS),
)
_DIRECTIONS = tuple(
    (str(i), name.title(), f"{name.capitalize()}, or where that is between two that it knows, one of them")
    for i, name in enumerate(DIRECTIONS)
)
_TURNS = (
    ("2", "Left", "Turning left"),
    ("1", "None", "Not turning"),
    ("0", "Right", "Turning right"),
)
_MOST_FUTURE = 9.0  # Eq. 2 of at most 1 a step, discounted by 0.9 from the next step on


class Decision(NamedTuple):
    """Which of a style's classes plays, what is asked for, by the control's index, and whether a drive says so."""

    style: int
    playing: int
    control: int
    live: bool


class FragmentShown(NamedTuple):
    """A fragment as the user knows it."""

    text: str
    action: str
    """The Action that it was cut from; empty for a synthesized one."""
    frame: float = 0
    """The scene's frame where it begins."""
    mirrored: bool = False


class Line(NamedTuple):
    """A class that might be played next."""

    number: int
    name: str
    chosen: bool
    smoothness: float
    match: float
    future_value: float
    value: float
    fragments: list[FragmentShown]


_shown: list[Line] = []  # what the panel draws now; the bars look here
_inspected: list[_Inspected] = []  # the last one


def _bars(name: str, tip: str, most: float) -> Any:
    def values(_settings: Any) -> Sequence[float]:
        column = [getattr(line, name) for line in _shown]
        return (column + [0.0] * (BEST + 1))[: BEST + 1]

    return FloatVectorProperty(
        description=tip, size=BEST + 1, min=0, max=most, soft_max=most, precision=2, subtype="NONE", get=values
    )


class InspectorSettings(bpy.types.PropertyGroup):
    """Which decision the inspector shows, where no drive tells."""

    follow: BoolProperty(  # type: ignore[valid-type]
        name="Follow Drive",
        description="While driving, show the decision for the class that plays and the command of this moment",
        default=True,
    )
    gait: EnumProperty(  # type: ignore[valid-type]
        name="Gait", description="Speed that is asked for", items=_GAITS, default="walk"
    )
    direction: EnumProperty(  # type: ignore[valid-type]
        name="Direction", description="Direction that is asked for", items=_DIRECTIONS, default="0"
    )
    turn: EnumProperty(name="Turn", description="Turn that is asked for", items=_TURNS, default="1")  # type: ignore[valid-type]
    jump: BoolProperty(name="Jump", description="Whether a jump is asked for", default=False)  # type: ignore[valid-type]
    smoothness: _bars("smoothness", "How smoothly it follows what plays, 0 to 1 (Eq. 2, first factor)", 1)  # type: ignore[valid-type]
    match: _bars("match", "How well it performs the control, 0 to 1 (Eq. 2, second factor)", 1)  # type: ignore[valid-type]
    future_value: _bars(  # type: ignore[valid-type]
        "future_value", "Smoothness x match to be expected of all later steps, discounted: 0 to 9", _MOST_FUTURE
    )


def decision(obj: bpy.types.Object, settings: Any, active_class: int) -> Decision:
    """What is explained: what the drive plays in the style that it is in, else what is chosen in the panels."""
    drive = classes.driven(obj) if settings.follow else None
    if drive is not None:
        style = drive.player.playing_style
        space = building.load_to_draw(obj).in_style(style).space
        return Decision(style, drive.player.playing[0], int(space.nearest([list(drive.control)])[0]), True)
    style = classes.shown_style(obj.fragmotion.figures)
    character = building.load_to_draw(obj).in_style(style)
    playing, layout = min(active_class, len(character.representatives) - 1), layout_of(character.space)
    parts = (_velocity(layout, settings), int(settings.turn), int(settings.jump))
    return Decision(style, playing, int(np.ravel_multi_index(parts, layout.shape, mode="clip")), False)


def _velocity(layout: ControlLayout, settings: Any) -> int:
    """The number of the velocity that is nearest to what the settings say."""
    if settings.gait == _STAND:
        return 0
    off = [abs(GAITS.index(gait) - GAITS.index(settings.gait)) for gait in layout.gaits]
    direction = int(settings.direction) * layout.directions // len(DIRECTIONS)
    return 1 + off.index(min(off)) * layout.directions + direction


def explain(obj: bpy.types.Object, what: Decision) -> list[Line]:
    """The best classes after the one that plays, and the one that the policy says."""
    style, playing, control, _ = what
    character = building.load_to_draw(obj).in_style(style)
    inspected = inspect(character)
    chosen, left_out = int(character.table[playing, control]), classes.excluded(obj, style)
    allowed = [each for each in inspected.explain(playing, control) if each.next not in left_out]
    lines = allowed[:BEST] + [each for each in allowed[BEST:] if each.next == chosen]
    _shown[:] = [inspected.line(each, classes.name_of(obj, style, each.next), each.next == chosen) for each in lines]
    return _shown


def show(obj: bpy.types.Object, scene: bpy.types.Scene, action: bpy.types.Action, frame: float) -> None:
    """Let the armature play the Action from that frame."""
    versions.assign(obj, action)
    scene.frame_set(round(frame))


def forget() -> None:
    """Let go of what was evaluated."""
    _inspected.clear()
    _shown.clear()


class _Inspected:
    """A character as drawing needs it: evaluated, and its lists read once."""

    def __init__(self, character: Character) -> None:
        self.character, self.explain = character, core.Explainer(character)
        clips = character.clip_names
        self.clips = [clips[clip] for clip in character.fragment_clips.tolist()]
        self.ranges = character.fragment_ranges.tolist()
        self.origins = character.fragment_origins

    def line(self, each: Alternative, name: str, chosen: bool) -> Line:
        """An alternative as the panel shows it."""
        fragments = [self.fragment(fragment) for fragment in each.fragments]
        return Line(each.next, name, chosen, each.smoothness, each.match, each.future_value, each.value, fragments)

    def fragment(self, number: int) -> FragmentShown:
        """A fragment by where it was cut, where it was."""
        name, part = source_of(self.clips[number])
        action, origin = bpy.data.actions.get(name), self.origins[number]
        if action is None or origin not in {"captured", "mirrored"}:
            return FragmentShown(f"made of {self.clips[number].removesuffix(' transformed')}", "")
        rate = rate_of(action, SCENE_RATE, _scene_rate())
        start = action.frame_range[0] if part is None else part
        first, last = (start + seconds * rate for seconds in self.ranges[number])
        return FragmentShown(f"{first:.0f}-{last:.0f} {name}", name, first, origin == "mirrored")


def inspect(character: Character) -> _Inspected:
    """The character's evaluation; made once."""
    if not _inspected or _inspected[0].character is not character:
        _inspected[:] = [_Inspected(character)]
    return _inspected[0]


def _scene_rate() -> float:
    render = bpy.context.scene.render
    return float(render.fps / render.fps_base)
