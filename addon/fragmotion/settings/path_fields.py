# SPDX-License-Identifier: GPL-3.0-or-later
"""What Follow Path can be told."""

from __future__ import annotations

import bpy
from bpy.props import EnumProperty, FloatProperty, IntProperty, PointerProperty

from ..paths.lines import TYPES
from .common import length_field, seed_field

_SOURCES = (
    ("CURVE", "A Line", "A curve, or the first stroke of a Grease Pencil object"),
    (
        "SELECTED",
        "Empties",
        "A smooth line through the empties that are selected, in the order of their names",
    ),
    ("COLLECTION", "Collection", "A smooth line through the objects of a collection, in the order of their names"),
)
_SPEEDS = (
    ("SPEED", "Speed", "The same speed all the way, but for bends that are too tight for it"),
    ("RADIUS", "Radius", "The speed times the radius of the curve's points (Alt S in Edit Mode), or a stroke's width"),
    ("ARRIVE", "Arrive at Frame", "As fast as it takes to be at the path's end at a frame"),
)
_FACINGS = (
    ("ALONG", "Along the Path", "Where the path goes"),
    ("FIXED", "Fixed", "Always the same way"),
    ("OBJECT", "Towards Object", "Towards an object, where that is now"),
)
_ENDS = (
    ("STAND", "Stand", "Stop at the path's end and stand there; a closed path is gone round once"),
    ("LOOP", "Loop", "Go round and round; an open path is closed by a straight line"),
    ("GO_ON", "Go On", "Go straight on"),
)
_STARTS = (
    ("PATH", "On the Path", "At the path's beginning, facing along it"),
    ("CHARACTER", "Where It Stands", "Where the character stands now; it goes to the path's beginning first"),
)


def _is_line(_settings: PathSettings, obj: bpy.types.Object) -> bool:
    return obj.type in TYPES


class PathSettings(bpy.types.PropertyGroup):
    """The panel's settings of Follow Path."""

    source: EnumProperty(  # type: ignore[valid-type]
        name="Path", description="What the character follows", items=_SOURCES, default="CURVE"
    )
    curve: PointerProperty(  # type: ignore[valid-type]
        name="Curve",
        description="A curve or Grease Pencil object; its height does not count",
        type=bpy.types.Object,
        poll=_is_line,
    )
    collection: PointerProperty(  # type: ignore[valid-type]
        name="Way Points", description="A collection of way points", type=bpy.types.Collection
    )
    start: EnumProperty(  # type: ignore[valid-type]
        name="Start", description="Where the character sets off", items=_STARTS, default="PATH"
    )
    speed_by: EnumProperty(  # type: ignore[valid-type]
        name="Pace", description="How fast the character goes", items=_SPEEDS, default="SPEED"
    )
    speed: FloatProperty(  # type: ignore[valid-type]
        name="Speed",
        description="How fast to go; 0: as fast as the character walks. It goes no faster than it runs",
        default=1.2,
        min=0.0,
        soft_max=5.0,
        max=1000.0,
        unit="VELOCITY",
    )
    arrive_frame: IntProperty(  # type: ignore[valid-type]
        name="Frame",
        description="The frame at which it is at the path's end, in a bake from Bake's start frame on",
        default=240,
    )
    facing: EnumProperty(  # type: ignore[valid-type]
        name="Facing", description="Where the character faces", items=_FACINGS, default="ALONG"
    )
    heading: FloatProperty(  # type: ignore[valid-type]
        name="Heading", description="Where to face, counter-clockwise from +Y", default=0.0, subtype="ANGLE"
    )
    look_at: PointerProperty(  # type: ignore[valid-type]
        name="Object", description="The object that the character faces", type=bpy.types.Object
    )
    end: EnumProperty(  # type: ignore[valid-type]
        name="At the End", description="What the character does at the path's end", items=_ENDS, default="STAND"
    )
    seconds: length_field(20.0, who="the character goes")  # type: ignore[valid-type]
    seed: seed_field("Draws which fragment of a class plays: the same path and the same seed, the same motion")  # type: ignore[valid-type]
