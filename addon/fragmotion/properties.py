# SPDX-License-Identifier: GPL-3.0-or-later
"""What the user sets and what a build found, kept in the .blend with the armature; and the tick of an Action.

The fields of a stage are written down once: the panel's settings and the stage's operator both have them.
"""

from __future__ import annotations

import math
from typing import Any

import bpy
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    IntProperty,
    IntVectorProperty,
    PointerProperty,
    StringProperty,
)

from .classes import ClassRow
from .core import core
from .coverage import COLUMNS
from .inspector import InspectorSettings
from .left_out import FrameSpan
from .suggesting import NumberTried
from .takes import Take

DRIVING = "DRIVING"
"""The choice of the policy that Build put first."""

_DEFAULTS = core.BuildOptions()
_SOURCES = (
    ("PLAYER", "Simulated", "A made-up joystick session: a stick with inertia that chases targets"),
    ("FILE", "CSV File", "A CSV file with the header velocity_x,velocity_y,turn,jump and 10 rows a second"),
)
_TAKES = ("TAKES", "Takes", "The ticked takes of the Takes panel")
_TAKE = ("TAKE", "Take", "The take that is selected in the Takes panel")
_HABITS = tuple((name, name.title(), f"A simulated player with the habits of a {name}") for name in core.PLAYERS)
_RELATIVE = (
    (
        "VIEW",
        "By View",
        "Up on the stick is away from you. The character turns to where the stick points and goes there, on the spot "
        "first where that is behind it. While you turn it yourself, or if its takes hold no good turns, it goes there "
        "at once, sidewards or backwards if need be",
    ),
    ("CHARACTER", "By Character", "Up on the stick is where the character faces. It turns only as you turn it"),
)
_CUTS = (
    ("gait", "At Footsteps", "Cut where a foot strikes the ground; by windows where the armature has no feet"),
    ("windows", "By Windows", "Cut into windows of equal length, whatever the feet do"),
)
_POLICY_LABELS = {
    "anticipate": ("Anticipate", "Looks ahead, as value iteration does, and knows how long any player keeps a control"),
    "iterate": ("Value Iteration", "Looks ahead, with a model of how the controls change learned from the trace alone"),
    "svm": ("SVM", "A support vector machine that learned from the best path through the trace"),
    "greedy": ("Greedy", "The best next class, without a look at what comes after it"),
}
_POLICIES = tuple((name, *_POLICY_LABELS.get(name, (name.title(), ""))) for name in core.POLICIES)
POLICY_NAMES = {name: label for name, label, _ in _POLICIES}
"""What the core's policies are called in the panel."""


_KEEPING = (
    ("PACKED", "In the .blend", "Inside the .blend file"),
    ("BESIDE", "Beside It", "In a policy file beside the .blend, written when that is saved"),
)
_TARGETS = (
    ("NEW", "New Action", "A new Action, named after the take"),
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
)
_CROWD_TRACES = (
    ("PLAYERS", "Simulated", "A simulated player for each copy"),
    ("TAKES", "Ticked Takes", "The ticked takes of the Takes panel, in turn, each copy with a seed of its own"),
)
_LAST_FRAME = 1_048_574  # that a scene can have
MIXED = "MIXED"
"""The choice of all simulated players in turn."""


def _player(description: str, default: str, *others: tuple[str, str, str]) -> Any:
    """Whose habits a simulated player has."""
    return EnumProperty(name="Player", description=description, items=(*others, *_HABITS), default=default)


def _length(default: float, least: float = 0.5, who: str = "the simulated player plays") -> Any:
    return FloatProperty(
        name="Length",
        description=f"How long {who}, in seconds",
        default=default,
        min=least,
        max=3600.0,
        unit="TIME_ABSOLUTE",
    )


def _seed(description: str) -> Any:
    return IntProperty(name="Seed", description=description, default=1, min=0)


def _factor(name: str, description: str, default: float) -> Any:
    return FloatProperty(name=name, description=description, default=default, min=0.0, max=1.0, subtype="FACTOR")


def _policy(description: str, default: str, *others: tuple[str, str, str], name: str = "Policy") -> Any:
    return EnumProperty(name=name, description=description, items=(*others, *_POLICIES), default=default)


def _trace_source(*others: tuple[str, str, str]) -> Any:
    return EnumProperty(
        name="Trace",
        description="Where the joystick session comes from",
        items=(*_SOURCES, *others),
        default="PLAYER",
    )


_CHOOSING = "How the next class is chosen from the class that plays and the control"


class TraceFields:
    """Where a trace comes from."""

    trace_source: _trace_source()  # type: ignore[valid-type]
    trace_file: StringProperty(  # type: ignore[valid-type]
        name="Trace File",
        description="CSV file: velocity_x,velocity_y (m/s), turn (-1 to 1, 1 is left), jump (0 or 1); 10 rows a second",
        subtype="FILE_PATH",
    )


class BuildFields(TraceFields):
    """What a build can be told."""

    trace_source: _trace_source(_TAKES)  # type: ignore[valid-type]
    longest: FloatProperty(  # type: ignore[valid-type]
        name="Longest Fragment",
        description="Longest fragment in seconds; shorter ones respond faster, longer ones move more naturally",
        default=_DEFAULTS.longest,
        min=_DEFAULTS.shortest,
        max=2.0,
        soft_max=0.5,
        step=5,
        precision=2,
        unit="TIME_ABSOLUTE",
    )
    cut: EnumProperty(  # type: ignore[valid-type]
        name="Cut", description="Where takes are cut into fragments", items=_CUTS, default=_DEFAULTS.cut
    )
    classes: IntProperty(  # type: ignore[valid-type]
        name="Classes",
        description="Number of clusters of similar fragments; there must be at least as many fragments",
        default=_DEFAULTS.classes,
        min=2,
        soft_max=500,
    )
    seed: _seed("Same takes and same seed: same character")  # type: ignore[valid-type]
    mirror: BoolProperty(  # type: ignore[valid-type]
        name="Mirror",
        description="Learn from the mirror image of every take too (left and right bones by name)",
        default=_DEFAULTS.mirror,
    )
    synthesize: BoolProperty(  # type: ignore[valid-type]
        name="Fill Gaps",
        description="Synthesize fragments for the directions and speeds that the takes lack",
        default=_DEFAULTS.synthesize,
    )
    policy: _policy(_CHOOSING, _DEFAULTS.policies[0])  # type: ignore[valid-type]
    player: _player("Whose habits the policy learns from", "explorer")  # type: ignore[valid-type]
    seconds: _length(60.0, 1.0)  # type: ignore[valid-type]


def _suggest_actions(_settings: object, _context: bpy.types.Context, text: str) -> list[str]:
    return [action.name for action in bpy.data.actions if text.lower() in action.name.lower()]


class BakeFields(TraceFields):
    """What a bake can be told."""

    trace_source: _trace_source(_TAKE)  # type: ignore[valid-type]
    take: IntProperty(  # type: ignore[valid-type]
        name="Take Number",
        description="Which take of the Takes panel is baked, from 0; -1 is the one that is selected there",
        default=-1,
        min=-1,
    )
    as_recorded: BoolProperty(  # type: ignore[valid-type]
        name="As Recorded",
        description="Bake the take as it was seen, with the policy, seed and start that it was recorded with",
        default=True,
    )
    policy: _policy(_CHOOSING, DRIVING, (DRIVING, "Driving", "The policy that Build was told to drive with"))  # type: ignore[valid-type]
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
    player: _player("Whose habits drive the character", "walker")  # type: ignore[valid-type]
    seconds: _length(20.0)  # type: ignore[valid-type]
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
            "named after the take"
        ),
        search=_suggest_actions,
        search_options={"SUGGESTION"},
    )
    seed: _seed("Draws the simulated player's targets and which fragment of a class plays")  # type: ignore[valid-type]


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
    player: _player("Whose habits drive the copies", MIXED, (MIXED, "Mixed", "All the habits, in turn"))  # type: ignore[valid-type]
    seconds: _length(20.0, who="the simulated players play")  # type: ignore[valid-type]
    seed: _seed("Of the first copy; the others count on: no two do the same")  # type: ignore[valid-type]


class BuildSettings(BuildFields, bpy.types.PropertyGroup):
    """The panel's settings of Build."""


class PopulateSettings(PopulateFields, bpy.types.PropertyGroup):
    """The panel's settings of Populate."""


class BakeSettings(BakeFields, bpy.types.PropertyGroup):
    """The panel's settings of Bake."""


class DriveSettings(TraceFields, bpy.types.PropertyGroup):
    """The panel's settings of Drive."""

    relative: EnumProperty(  # type: ignore[valid-type]
        name="Stick", description="What the direction of the stick is relative to", items=_RELATIVE, default="VIEW"
    )
    seed: _seed("Draws which fragment of a class plays: the same controls and the same seed, the same motion")  # type: ignore[valid-type]
    replay: _policy(  # type: ignore[valid-type]
        "The policy that replays a take",
        "RECORDED",
        ("RECORDED", "As Recorded", "The policy and the seed that the take was recorded with"),
        name="Replay With",
    )
    follow: BoolProperty(  # type: ignore[valid-type]
        name="Follow", description="Move the view with the character; it goes back when the drive ends", default=True
    )
    show_velocity: BoolProperty(  # type: ignore[valid-type]
        name="Velocity",
        description="Arrows on the ground, half a second long: the velocity asked for (blue), the character's (orange)",
        default=True,
    )
    show_path: BoolProperty(  # type: ignore[valid-type]
        name="Path", description="The way that the character went", default=True
    )
    show_ideal: BoolProperty(  # type: ignore[valid-type]
        name="Ideal Path",
        description="The way of a ghost that does just what the controls say, since the drive or the recording began",
        default=True,
    )
    show_feet: BoolProperty(  # type: ignore[valid-type]
        name="Feet", description="Discs under the feet that stand on the ground", default=True
    )
    show_figures: BoolProperty(  # type: ignore[valid-type]
        name="Figures",
        description="Class, control, rest of the fragment, quality, response time and updates a second",
        default=True,
    )
    show_stick: BoolProperty(  # type: ignore[valid-type]
        name="Stick",
        description="A stick in the corner of the view, to be dragged with the mouse",
        default=True,
    )
    player: _player("Whose habits the trace has", "walker")  # type: ignore[valid-type]
    seconds: _length(20.0)  # type: ignore[valid-type]


class FeelSettings(bpy.types.PropertyGroup):
    """How the character moves when it is driven and baked, whatever its policy."""

    # PlayerOptions' responsiveness and root_adjustment, under the names that saved files have.
    promptness: _factor(  # type: ignore[valid-type]
        "Responsiveness",
        "How soon the character answers when the stick moves a lot: at 0 it waits, half a second at most, for the "
        "moment where what it does next joins on best; at 1 it answers at once, and its feet may slide",
        0.5,
    )
    pull: _factor(  # type: ignore[valid-type]
        "Root Adjustment",
        "How much the body does of what the stick says beyond what its takes do: at 0 it moves as the actor did, "
        "at 1 it goes and turns up to two fifths faster, slower or aside",
        1.0,
    )
    lock_feet: BoolProperty(  # type: ignore[valid-type]
        name="Planted Feet", description="Feet that stand stay where they are, and legs follow", default=True
    )


class PolicyFigure(bpy.types.PropertyGroup):
    """How one policy did, by its `name`."""

    quality: FloatProperty()  # type: ignore[valid-type]


class CoverageFigure(bpy.types.PropertyGroup):
    """A row, by its `name`, of the table that says how many controls are performed well."""

    performed: IntVectorProperty(size=len(COLUMNS))  # type: ignore[valid-type]
    total: IntVectorProperty(size=len(COLUMNS))  # type: ignore[valid-type]


class BuildFigures(bpy.types.PropertyGroup):
    """What the last build found."""

    captured: IntProperty()  # type: ignore[valid-type]
    fragments: IntProperty()  # type: ignore[valid-type]
    classes: IntProperty()  # type: ignore[valid-type]
    controls: IntProperty()  # type: ignore[valid-type]
    seconds: FloatProperty()  # type: ignore[valid-type]
    quality: FloatProperty()  # type: ignore[valid-type]
    examiner: StringProperty()  # type: ignore[valid-type]
    sources: StringProperty()  # type: ignore[valid-type]
    policies: CollectionProperty(type=PolicyFigure)  # type: ignore[valid-type]
    performed: IntProperty()  # type: ignore[valid-type]
    coverage: CollectionProperty(type=CoverageFigure)  # type: ignore[valid-type]
    distances: StringProperty(subtype="BYTE_STRING", options={"HIDDEN"})  # type: ignore[valid-type]
    """[102] float32: ControlDis to the nearest fragment."""


class CharacterSettings(bpy.types.PropertyGroup):
    """An armature object's `fragmotion`: settings, figures, the policy file's bytes and the takes."""

    build: PointerProperty(type=BuildSettings)  # type: ignore[valid-type]
    bake: PointerProperty(type=BakeSettings)  # type: ignore[valid-type]
    populate: PointerProperty(type=PopulateSettings)  # type: ignore[valid-type]
    drive: PointerProperty(type=DriveSettings)  # type: ignore[valid-type]
    feel: PointerProperty(type=FeelSettings)  # type: ignore[valid-type]
    figures: PointerProperty(type=BuildFigures)  # type: ignore[valid-type]
    classes: CollectionProperty(type=ClassRow)  # type: ignore[valid-type]
    tried: CollectionProperty(type=NumberTried)  # type: ignore[valid-type]
    policy: StringProperty(subtype="BYTE_STRING", options={"HIDDEN"})  # type: ignore[valid-type]
    keep_policy: EnumProperty(  # type: ignore[valid-type]
        name="Keep Policy", description="Where the policy is kept from the next time that you save", items=_KEEPING
    )
    policy_file: StringProperty(  # type: ignore[valid-type]
        name="Policy File", description="Where the policy is kept; // is the folder of the .blend"
    )
    policy_digest: StringProperty(options={"HIDDEN"})  # type: ignore[valid-type]
    takes: CollectionProperty(type=Take)  # type: ignore[valid-type]
    active_take: IntProperty(name="Take", description="The take that is selected in the list")  # type: ignore[valid-type]
    digest: StringProperty(options={"HIDDEN"})  # type: ignore[valid-type]
    """Of the policy's bytes, by which panels know it without reading it."""


class ActionSettings(bpy.types.PropertyGroup):
    """An Action's `fragmotion`."""

    use: BoolProperty(  # type: ignore[valid-type]
        name="Learn from it", description="Build cuts fragments from the ticked Actions", default=False
    )
    left_out: CollectionProperty(type=FrameSpan)  # type: ignore[valid-type]


class WindowSettings(bpy.types.PropertyGroup):
    """The window manager's `fragmotion`: what no file need remember."""

    active_action: IntProperty()  # type: ignore[valid-type]
    active_class: IntProperty(min=0)  # type: ignore[valid-type]
    inspector: PointerProperty(type=InspectorSettings)  # type: ignore[valid-type]


CLASSES = (
    ClassRow,
    NumberTried,
    Take,
    FrameSpan,
    InspectorSettings,
    BuildSettings,
    BakeSettings,
    PopulateSettings,
    DriveSettings,
    FeelSettings,
    PolicyFigure,
    CoverageFigure,
    BuildFigures,
    CharacterSettings,
    ActionSettings,
    WindowSettings,
)
_OWNERS = (
    (bpy.types.Object, CharacterSettings),
    (bpy.types.Action, ActionSettings),
    (bpy.types.WindowManager, WindowSettings),
)


def register() -> None:
    """Give objects, Actions and the window manager their `fragmotion`; its classes are registered."""
    for owner, settings in _OWNERS:
        owner.fragmotion = PointerProperty(type=settings)


def unregister() -> None:
    """Take it away again."""
    for owner, _ in _OWNERS:
        del owner.fragmotion
