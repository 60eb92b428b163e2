# SPDX-License-Identifier: GPL-3.0-or-later
"""Frames of an Action that Build leaves out: calibration poses, T-poses, stumbles."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import bpy
import numpy as np
from bpy.props import IntProperty

from ..compat import versions
from ..compat.core import core
from ..errors import UserError

if TYPE_CHECKING:
    from fragmotion_core import Clip, Doubles, Skeleton

    Bools = np.ndarray[Any, np.dtype[np.bool_]]

_FEWEST = 2  # samples of a part
_SAME_FRAME = 0.01
_PART = re.compile(r"(.*) from (-?[\d.]+)")


def _keep_order(span: Any, _context: bpy.types.Context) -> None:
    if span.last < span.first:
        span.last = span.first


class FrameSpan(bpy.types.PropertyGroup):
    """Scene frames first to last, both included."""

    first: IntProperty(  # type: ignore[valid-type]
        name="First", description="First scene frame that is left out", default=1, update=_keep_order
    )
    last: IntProperty(  # type: ignore[valid-type]
        name="Last", description="Last scene frame that is left out", default=1, update=_keep_order
    )


def spans_of(action: bpy.types.Action) -> list[tuple[int, int]]:
    """The Action's frames that are left out: first and last."""
    return [(span.first, span.last) for span in action.fragmotion.left_out]


def parts_of(times: Doubles, spans: Iterable[tuple[int, int]]) -> list[slice]:
    """The runs of samples at these scene frames that no span touches and that move: at least two samples."""
    return [run for run in _runs(~_is_left_out(times, spans)) if run.stop - run.start >= _FEWEST]


def _is_left_out(times: Doubles, spans: Iterable[tuple[int, int]]) -> Bools:
    """[F]: whether a span touches the sample at a scene frame."""
    touched = np.zeros(len(times), bool)
    for first, last in spans:
        touched |= (times >= first - _SAME_FRAME) & (times <= last + _SAME_FRAME)
    return touched


def _runs(flags: Bools) -> list[slice]:
    """Where flags are set without a gap."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], flags, [False])).astype(int)))
    return [slice(begin, end) for begin, end in zip(edges[::2].tolist(), edges[1::2].tolist())]


def leave_out_likewise(source: bpy.types.Action, frames: Doubles, made: bpy.types.Action, times: Doubles) -> None:
    """Leave out of an Action, whose samples at `times` show the source's at `frames`, what the source leaves out."""
    for run in _runs(_is_left_out(frames, spans_of(source))):
        span = made.fragmotion.left_out.add()
        span.first = int(np.floor(times[run.start] + _SAME_FRAME))
        span.last = int(np.ceil(times[run.stop - 1] - _SAME_FRAME))


def cut(clip: Clip, skeleton: Skeleton, times: Doubles, spans: Iterable[tuple[int, int]]) -> list[Clip]:
    """The clip's parts around the spans, so that no fragment crosses one; UserError where nothing is left."""
    parts = parts_of(times, spans)
    if not parts:
        raise UserError(f"Action '{clip.name}': all of its frames are left out: untick it, or leave out fewer")
    return [part_of(clip, skeleton, f"{clip.name} from {times[part][0]:g}", part) for part in parts]


def part_of(clip: Clip, skeleton: Skeleton, name: str, part: slice) -> Clip:
    """Some frames of a clip, with their markers, as a clip of that name."""
    markers = [(at - part.start, text) for at, text in clip.markers if part.start <= at <= part.stop - 1]
    cut: Clip = core.Clip(skeleton, name, clip.rate, clip.root_positions[part], clip.rotations[part])
    return cut.with_markers(markers)


def source_of(name: str) -> tuple[str, float | None]:
    """The Action's name of a clip or its mirror image, and the part's first scene frame (None: the whole Action)."""
    name = name if name in bpy.data.actions else name.removesuffix(" mirrored")
    part = None if name in bpy.data.actions else _PART.fullmatch(name)
    return (part[1], float(part[2])) if part else (name, None)


def choose_span(scene: bpy.types.Scene, obj: bpy.types.Object, action: bpy.types.Action) -> tuple[int, int]:
    """The frames that the timeline shows as chosen: the preview range, else the selected keys, else the current frame.

    Keys say nothing where all or none of them are selected.
    """
    if scene.use_preview_range:
        return scene.frame_preview_start, scene.frame_preview_end
    selected = _selected_keys(versions.curves_of(action, obj))
    return selected or (scene.frame_current, scene.frame_current)


def _selected_keys(curves: Iterable[bpy.types.FCurve]) -> tuple[int, int] | None:
    frames, flags = [np.empty(0, np.float32)], [np.empty(0, bool)]
    for curve in curves:
        count = len(curve.keyframe_points)
        points, selected = np.empty(2 * count, np.float32), np.empty(count, bool)
        curve.keyframe_points.foreach_get("co", points)
        curve.keyframe_points.foreach_get("select_control_point", selected)
        frames.append(points[::2])
        flags.append(selected)
    chosen = np.concatenate(flags)
    if chosen.all() or not chosen.any():
        return None
    at = np.concatenate(frames)[chosen]
    return int(np.floor(at.min())), int(np.ceil(at.max()))
