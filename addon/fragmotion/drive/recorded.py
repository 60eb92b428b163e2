# SPDX-License-Identifier: GPL-3.0-or-later
"""Drives by a recording: replayed, or recorded over."""

from __future__ import annotations

import bpy

from ..character.building import has_character, load
from ..character.moves import names_of
from ..edits.replaying import shown_poses
from ..errors import UserError
from ..recordings.recordings import TRACE_RATE, Recording, asked_of, numbered_moves, numbered_styles, trace_of
from .acting.punch import Own, Punch
from .session import RATE, Session, opened


def replay(
    context: bpy.types.Context, obj: bpy.types.Object, recording: Recording, seed: int = -1, policy: str = ""
) -> Session:
    """Begin a drive by a recording, from where it began; by default with its seed, and its policy where there is it.

    UserError where the recording is damaged.
    """
    trace, begin = trace_of(recording), tuple(recording.start)
    known = load(obj).policies if has_character(obj) else []
    chosen = policy or (recording.policy if recording.policy in known else "")
    with opened(context, obj, recording.seed if seed < 0 else seed, chosen) as driven:
        styled = numbered_styles(recording, driven.styling.names)
        moves, asked = numbered_moves(recording, names_of(driven.actor.character)), asked_of(recording)
        driven.play(trace, begin, moves, styled, asked.looks, asked.reaches)
        return driven


def record_over(
    context: bpy.types.Context, obj: bpy.types.Object, recording: Recording, begin: float, end: float
) -> Session:
    """Begin a drive by a recording, over which the stick is recorded from `begin` to `end` (s); what follows is played
    again. UserError where that is no stretch of it, or it is damaged."""
    trace, start_frame = trace_of(recording), tuple(recording.start)
    first, last = round(begin * TRACE_RATE), min(round(end * TRACE_RATE), len(trace))
    if not 0 <= first < last:
        raise UserError(
            f"Recording '{recording.name}' lasts {recording.seconds:.1f} s: there is nothing of it to record over from "
            f"{begin:.1f} s to {end:.1f} s. Move the playhead onto it"
        )
    known = load(obj).policies if has_character(obj) else []
    chosen = recording.policy if recording.policy in known else ""
    shown = shown_poses(obj, recording)
    if shown is not None and len(shown.classes) <= first * RATE // TRACE_RATE:
        raise UserError(
            f"Recording '{recording.name}' shows nothing from {begin:.1f} s on: move the playhead before it"
        )
    with opened(context, obj, recording.seed, chosen) as driven:
        character, asked = driven.actor.character, asked_of(recording)
        styled = numbered_styles(recording, driven.styling.names)
        own = Own(recording.name, trace, asked, numbered_moves(recording, names_of(character)), styled)
        driven.play_over(Punch(own, first, last, RATE, character), start_frame, styled, shown)
        return driven
