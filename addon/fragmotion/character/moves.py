# SPDX-License-Identifier: GPL-3.0-or-later
"""The armature's moves: what the list says of them, and the character that has them.

The character is given the moves when they are needed and have changed since: no build is made anew for them. A move
whose Action is gone stays what the character has of it.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty, StringProperty

from ..compat.core import core
from ..compat.event_keys import KEYS
from ..errors import SinglePose, UserError, core_errors
from ..mocap.hands import hand_pose, with_hands
from ..mocap.left_out import part_of
from ..mocap.sampling import sample, sample_times
from ..rig.rigs import make_rig
from .building import has_character, load_whole, replace
from .staleness import digest_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from fragmotion_core import Character, Clip, Doubles, Move, Rig

NO_KEY = "NONE"
_FREE_KEYS = (*"FGHCVBNXZTYUIOPJKLM", "ONE", "TWO", "THREE", "FOUR", "FIVE", "SIX", "SEVEN", "EIGHT", "NINE", "ZERO")
_SAME_FRAME = 0.01
_BUTTONS = (
    ("NONE", "No Button", "No button of a gamepad"),
    ("B", "B", "The right one of the four buttons"),
    ("X", "X", "The left one of the four buttons"),
    ("Y", "Y", "The upper one of the four buttons"),
    ("BACK", "Back", "The button in the middle, on the left"),
    ("LEFTSTICK", "Left Stick", "The left stick, pressed down"),
    ("RIGHTSTICK", "Right Stick", "The right stick, pressed down"),
    ("DPAD_UP", "Up", "The directional pad, up"),
    ("DPAD_DOWN", "Down", "The directional pad, down"),
    ("DPAD_LEFT", "Left", "The directional pad, to the left"),
    ("DPAD_RIGHT", "Right", "The directional pad, to the right"),
)
_TOLD = ("name", "whole", "first", "last", "upper_body", "wait", "loop", "loop_first", "loop_last")


class MoveRow(bpy.types.PropertyGroup):
    """A move, by its `name`."""

    action: PointerProperty(  # type: ignore[valid-type]
        name="Action", description="The take that holds the move", type=bpy.types.Action
    )
    whole: BoolProperty(name="Whole Action", description="All of the Action is the move", default=True)  # type: ignore[valid-type]
    first: IntProperty(name="First", description="First scene frame of the move", default=1)  # type: ignore[valid-type]
    last: IntProperty(name="Last", description="Last scene frame of the move", default=1)  # type: ignore[valid-type]
    upper_body: BoolProperty(  # type: ignore[valid-type]
        name="Upper Body",
        description="Only what is above the legs moves, while the legs go on walking",
        default=False,
    )
    wait: FloatProperty(  # type: ignore[valid-type]
        name="Wait",
        description="Seconds in which it looks for the moment that joins best, after its key is pressed",
        default=0.5,
        min=0,
        max=2,
        unit="TIME_ABSOLUTE",
    )
    loop: BoolProperty(  # type: ignore[valid-type]
        name="Loop", description="Play some frames again and again while the key is held", default=False
    )
    loop_first: IntProperty(name="Loop First", description="First scene frame of the loop", default=1)  # type: ignore[valid-type]
    loop_last: IntProperty(name="Loop Last", description="Last scene frame of the loop", default=1)  # type: ignore[valid-type]
    key: EnumProperty(name="Key", description="The key that starts it while you drive", items=KEYS, default=NO_KEY)  # type: ignore[valid-type]
    button: EnumProperty(  # type: ignore[valid-type]
        name="Button", description="The button of a gamepad that starts it while you drive", items=_BUTTONS
    )
    kept: StringProperty(options={"HIDDEN"})  # type: ignore[valid-type]
    """Its name in the character; empty where it is not there yet."""


def add_move(
    context: bpy.types.Context,
    obj: bpy.types.Object,
    action: bpy.types.Action,
    frames: tuple[int, int] | None,
    used_keys: Iterable[str],
) -> MoveRow:
    """Add a move to the list, of these frames of an Action or of all, with a key that is free, and to the character.

    UserError where it cannot be one: then nothing has changed.
    """
    moves = obj.fragmotion.moves
    names = {row.name for row in moves}
    taken = {*used_keys, *(row.key for row in moves)}
    row: MoveRow = moves.add()
    row.name = next(name for number in range(len(names) + 1) if (name := _numbered(action.name, number)) not in names)
    row.action, row.whole = action, frames is None
    row.first, row.last = frames or (round(action.frame_range[0]), round(action.frame_range[1]))
    row.loop_first, row.loop_last = row.first, row.last
    row.key = next((key for key in _FREE_KEYS if key not in taken), NO_KEY)
    try:
        rig = make_rig(obj)
        make_move(context, obj, rig, row, hand_pose(context, obj, rig))
        bring_up_to_date(context, obj)
    except BaseException:
        moves.remove(len(moves) - 1)
        raise
    obj.fragmotion.active_move = len(moves) - 1
    return row


def remove_move(context: bpy.types.Context, obj: bpy.types.Object, index: int) -> None:
    """Take a move out of the list and, if it can be, out of the character."""
    settings = obj.fragmotion
    settings.moves.remove(index)
    settings.active_move = max(min(index, len(settings.moves) - 1), 0)
    bring_up_to_date(context, obj)


def bring_up_to_date(context: bpy.types.Context, obj: bpy.types.Object) -> None:
    """Give the armature's character the moves of the list, where they have changed. UserError that names the one that
    cannot be a move; then the character is as before."""
    if not has_character(obj) or obj.fragmotion.moves_told == _told(obj):
        return
    character = load_whole(obj)
    context.view_layer.update()
    rig, known = make_rig(obj), {move.name: move for move in character.moves}
    hands = hand_pose(context, obj, rig)
    moves = [make_move(context, obj, rig, row, hands, known) for row in obj.fragmotion.moves]
    with core_errors(f"Armature '{obj.name}'"):
        changed = character.with_moves(moves)
    replace(obj, changed)
    for row in obj.fragmotion.moves:
        row.kept = row.name
    obj.fragmotion.moves_told = _told(obj)


def list_moves(obj: bpy.types.Object, used_keys: Iterable[str]) -> None:
    """Have the moves of a character that was loaded in the list, beside those that are there: without an Action."""
    rows = obj.fragmotion.moves
    listed, taken = {row.name for row in rows}, {*used_keys, *(row.key for row in rows)}
    for move in load_whole(obj).moves:
        if move.name in listed:
            continue
        row = rows.add()
        row.name = row.kept = move.name
        row.upper_body, row.wait, row.loop = move.upper_body, move.wait, move.loop[1] > move.loop[0]
        row.key = next((key for key in _FREE_KEYS if key not in taken), NO_KEY)
        taken.add(row.key)


def check_keys(obj: bpy.types.Object, used_keys: Mapping[str, str]) -> None:
    """UserError where two moves have one key or button, or a move has a key that does something else while driving."""
    trouble = key_trouble(obj.fragmotion.moves, used_keys)
    if trouble:
        raise UserError(f"Armature '{obj.name}': {trouble}")


def key_trouble(rows: Sequence[Any], used_keys: Mapping[str, str]) -> str:
    """What is wrong with the keys of moves; empty where nothing is. `used_keys`: what other keys do."""
    for field in ("key", "button"):
        owners: dict[str, str] = {}
        for row in rows:
            key = getattr(row, field)
            if key == NO_KEY:
                continue
            if key in owners:
                return f"moves '{owners[key]}' and '{row.name}' are both on {field} {key}: give one of them another"
            if field == "key" and key in used_keys:
                return f"move '{row.name}' is on key {key}, which does '{used_keys[key]}' already: give it another"
            owners[key] = row.name
    return ""


def names_of(character: Character | None) -> list[str]:
    """The moves of a character, in the order of their numbers."""
    return [] if character is None else list(character.move_names)


def triggers_of(obj: bpy.types.Object, character: Character | None) -> list[tuple[str, str]]:
    """The key and the button of each of the character's moves."""
    rows = {row.kept: row for row in obj.fragmotion.moves}
    found = (rows.get(name) for name in names_of(character))
    return [(row.key, row.button) if row is not None else (NO_KEY, NO_KEY) for row in found]


def _numbered(name: str, number: int) -> str:
    return f"{name}.{number:03}" if number else name


def _told(obj: bpy.types.Object) -> str:
    """All that decides the character's moves; empty where there are none."""
    rows = [[getattr(row, name) for name in _TOLD] + [_digest(row)] for row in obj.fragmotion.moves]
    return json.dumps(rows) if rows else ""


def _digest(row: MoveRow) -> str:
    return digest_of(row.action) if row.action is not None else ""


def make_move(
    context: bpy.types.Context, obj: bpy.types.Object, rig: Rig, row: Any, hands: Doubles | None,
    known: Mapping[str, Move] | None = None,
) -> Move:  # fmt: skip
    """The move that a MoveRow tells, its hands as in hand_pose(); without an Action it is that which the character has.
    UserError where it cannot be one."""
    if row.action is None:
        kept = (known or {}).get(row.kept)
        if kept is None:
            raise UserError(f"Move '{row.name}' has no Action: choose one, or remove the move")
        loop = kept.loop if row.loop else (0.0, 0.0)
        with core_errors(f"Armature '{obj.name}'"):
            move: Move = core.Move(row.name, kept.clip, row.upper_body, row.wait, loop)
        return move
    clip, start = _clip(context, obj, rig, row, hands)
    loop = (0.0, 0.0)
    if row.loop:
        loop = (row.loop_first - start[0]) * start[1], (row.loop_last - start[0]) * start[1]
    with core_errors(f"Armature '{obj.name}'"):
        made: Move = core.Move(row.name, clip, row.upper_body, row.wait, loop)
    return made


def _clip(
    context: bpy.types.Context, obj: bpy.types.Object, rig: Rig, row: Any, hands: Doubles | None
) -> tuple[Clip, tuple[float, float]]:
    """The row's frames of its Action; the scene frame at which they begin, and seconds a scene frame."""
    single = UserError(f"Move '{row.name}' is of one frame: choose more frames of Action '{row.action.name}'")
    try:
        clip = with_hands(sample(context, obj, row.action, rig), rig, hands)
    except SinglePose:
        raise single from None
    times = sample_times(context.scene, obj, row.action)
    second = 1 / clip.rate / (times[1] - times[0])
    if row.whole:
        return clip, (times[0], second)
    inside = np.flatnonzero((times >= row.first - _SAME_FRAME) & (times <= row.last + _SAME_FRAME))
    if not len(inside):
        raise UserError(
            f"Move '{row.name}': Action '{row.action.name}' has nothing from frame {row.first} to {row.last}: choose "
            f"frames from {times[0]:g} to {times[-1]:g}"
        )
    if len(inside) < 2:
        raise single
    part = slice(inside[0], inside[-1] + 1)
    with core_errors(f"Move '{row.name}'"):
        cut = part_of(clip, rig.skeleton, row.name, part)
    return cut, (times[inside[0]], second)
