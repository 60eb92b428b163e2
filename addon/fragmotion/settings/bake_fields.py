# SPDX-License-Identifier: GPL-3.0-or-later
"""What a bake and a crowd can be told."""

from __future__ import annotations

import math

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

from .common import CHOOSING, TraceFields, length_field, player_field, policy_field, seed_field, source_field

DRIVING = "DRIVING"
"""The choice of the policy that Build put first."""

MIXED = "MIXED"
"""The choice of all simulated players in turn."""

_RECORDING = (
    "RECORDING",
    "Recording",
    "The recording that is selected in the Recordings panel; while there is none, the panel bakes a simulated player",
)

_TARGETS = (
    ("NEW", "New Action", "A new Action, named after the recording: 'Stroll Bake'"),
    ("CURRENT", "Current Action", "The Action that plays, from the playhead on: its keys there are replaced"),
    (
        "NLA",
        "NLA Strip",
        "A new Action as a strip on a new NLA track; the Action that plays is pushed down below it. Where keys below "
        "move the armature object and the root bone carries the character, it stands still during the strip",
    ),
)

_ROOTS = (
    ("BONE", "Root Bone", "The root bone carries the character along its path"),
    ("OBJECT", "Object", "The armature object itself carries the character along its path, as game engines expect"),
    ("IN_PLACE", "In Place", "The character stays where it starts and faces one way, as on a treadmill"),
)

_PLACES = (
    ("ORIGIN", "Origin", "Under the armature's origin, facing its -Y (towards the front view)"),
    ("CHARACTER", "Continue", "Where the character stands now, facing as it does: goes on from the current frame"),
)

_MARKERS = (
    ("NONE", "None", "No markers"),
    ("SCENE", "Timeline", "A marker in the scene's timeline wherever another class begins"),
    ("ACTION", "Action", "A pose marker in the Action wherever another class begins"),
)

_LAYOUTS = (
    ("SQUARE", "Square", "A grid around the armature; all face as it does"),
    ("RING", "Ring", "A circle around the armature that faces outwards"),
    (
        "PATH",
        "Along Paths",
        "One behind the other along the path that is set under Path, or several; no trace drives them",
    ),
    ("AREA", "Painted Area", "From place to place on a mesh, where its active vertex group is painted"),
)

_CROWD_TRACES = (
    ("PLAYERS", "Simulated", "A simulated player for each copy"),
    (
        "RECORDINGS",
        "Ticked Recordings",
        "The ticked recordings of the Recordings panel, in turn, each copy with a seed of its own",
    ),
)

_LAST_FRAME = 1_048_574  # that a scene can have


def _suggest_actions(_settings: object, _context: bpy.types.Context, text: str) -> list[str]:
    return [action.name for action in bpy.data.actions if text.lower() in action.name.lower()]


def _suggest_styles(_settings: object, context: bpy.types.Context, _text: str) -> list[str]:
    obj = context.active_object
    return [] if obj is None else [row.name for row in obj.fragmotion.figures.styles]


class BakeFields(TraceFields):
    """What a bake can be told."""

    trace_source: source_field(_RECORDING, default="RECORDING")  # type: ignore[valid-type]
    recording: IntProperty(  # type: ignore[valid-type]
        name="Recording Number",
        description="Which recording of the Recordings panel is baked, from 0; -1 is the one that is selected there",
        default=-1,
        min=-1,
    )
    as_recorded: BoolProperty(  # type: ignore[valid-type]
        name="As Recorded",
        description="Bake the recording as it was seen, with the policy, seed and start that it was recorded with",
        default=True,
    )
    policy: policy_field(CHOOSING, DRIVING, (DRIVING, "Driving", "The policy that Build was told to drive with"))  # type: ignore[valid-type]
    style: StringProperty(  # type: ignore[valid-type]
        name="Style",
        description="The style in which the character goes; empty: its first. Recordings have styles of their own",
        search=_suggest_styles,
    )
    place: EnumProperty(  # type: ignore[valid-type]
        name="Start", description="Where the character starts", items=_PLACES, default="ORIGIN"
    )
    target: EnumProperty(  # type: ignore[valid-type]
        name="To", description="What the motion is baked to", items=_TARGETS, default="NEW"
    )
    root: EnumProperty(  # type: ignore[valid-type]
        name="Root Motion", description="What carries the character along its path", items=_ROOTS, default="BONE"
    )
    reduce: BoolProperty(  # type: ignore[valid-type]
        name="Reduce Keys",
        description="Leave out the keys without which every bone stays, on every frame, within both bounds",
        default=False,
    )
    reduce_distance: FloatProperty(  # type: ignore[valid-type]
        name="Distance",
        description="How far a bone's head may be from its place at most on any frame, in the world (2 mm at first)",
        default=0.002,
        min=0.00001,
        soft_max=0.05,
        step=0.1,
        precision=4,
        unit="LENGTH",
    )
    reduce_angle: FloatProperty(  # type: ignore[valid-type]
        name="Angle",
        description="How far a bone may be turned from its direction at most on any frame, in degrees",
        default=math.radians(1.0),
        min=math.radians(0.001),
        soft_max=math.radians(10),
        subtype="ANGLE",
    )
    markers: EnumProperty(  # type: ignore[valid-type]
        name="Markers", description="Where to mark the changes of class", items=_MARKERS, default="NONE"
    )
    loop: BoolProperty(  # type: ignore[valid-type]
        name="Loop",
        description="Ease the end of the motion so that it ends as it began: the same pose at the same velocity",
        default=False,
    )
    loop_seconds: FloatProperty(  # type: ignore[valid-type]
        name="Over",
        description="How long before its end the motion begins to turn into its beginning, in seconds",
        default=0.5,
        min=0.1,
        max=10.0,
        unit="TIME_ABSOLUTE",
    )
    player: player_field("Whose habits drive the character", "walker")  # type: ignore[valid-type]
    seconds: length_field(20.0)  # type: ignore[valid-type]
    frame_start: IntProperty(  # type: ignore[valid-type]
        name="Start Frame",
        description="Scene frame of the first key",
        default=1,
        min=-_LAST_FRAME,
        max=_LAST_FRAME,
    )
    fit_end: BoolProperty(  # type: ignore[valid-type]
        name="Fit Scene End",
        description="Extend the scene to the last baked frame where it ends before; it is never shortened",
        default=True,
    )
    action: StringProperty(  # type: ignore[valid-type]
        name="Action",
        description=(
            "Action to write to: this armature's keys in it are replaced. A new name makes a new one; empty means one "
            "named after the recording"
        ),
        search=_suggest_actions,
        search_options={"SUGGESTION"},
    )
    seed: seed_field("Draws the simulated player's targets and which fragment of a class plays")  # type: ignore[valid-type]


class PopulateFields:
    """What a crowd can be told."""

    count: IntProperty(  # type: ignore[valid-type]
        name="Copies", description="How many copies of the armature to add", default=8, min=1, soft_max=100, max=1000
    )
    layout: EnumProperty(  # type: ignore[valid-type]
        name="Layout", description="How the copies stand around the armature", items=_LAYOUTS, default="SQUARE"
    )
    spacing: FloatProperty(  # type: ignore[valid-type]
        name="Spacing",
        description="How far the copies stand from each other at least when they start",
        default=2.0,
        min=0.01,
        soft_max=20.0,
        unit="LENGTH",
    )
    traces: EnumProperty(  # type: ignore[valid-type]
        name="Traces", description="What drives the copies", items=_CROWD_TRACES, default="PLAYERS"
    )
    player: player_field("Whose habits drive the copies", MIXED, (MIXED, "Mixed", "All the habits, in turn"))  # type: ignore[valid-type]
    seconds: length_field(20.0, who="the simulated players play")  # type: ignore[valid-type]
    mix_styles: BoolProperty(  # type: ignore[valid-type]
        name="Mix Styles",
        description="Draw a style for each copy that a simulated player drives; else all have Bake's. Recordings have "
        "styles of their own",
        default=True,
    )
    clear: BoolProperty(  # type: ignore[valid-type]
        name="Keep Clear",
        description="They make way for each other, for the armature where it is seen, and for obstacles: none comes nearer "
        "to another than 0.4 m. Ticked recordings are played as they are",
        default=True,
    )
    sizes: FloatProperty(  # type: ignore[valid-type]
        name="Sizes",
        description="By how much copies are larger or smaller than the armature at most",
        default=0.0,
        min=0.0,
        max=0.5,
        subtype="FACTOR",
    )
    seed: seed_field("Of the first copy; the others count on: no two do the same")  # type: ignore[valid-type]
