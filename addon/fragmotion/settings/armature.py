# SPDX-License-Identifier: GPL-3.0-or-later
"""What an armature keeps in the .blend: settings of its stages, what was built, the policy and the recordings."""

from __future__ import annotations

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

from ..character.classes import ClassRow, shown_style
from ..character.control_layout import ControlLayout
from ..character.coverage import COLUMNS
from ..character.moves import MoveRow
from ..character.suggesting import NumberTried
from ..control_rig.binding import ControlRigSettings, is_source
from ..ground.meshes import WITH_FACES
from ..recordings.recordings import Recording
from ..rig.bodies import DoubtfulBone, RoleBone
from ..rig.hanging import HangingBone
from .bake_fields import BakeFields, PopulateFields
from .build_fields import BuildFields
from .common import TraceFields, factor_field, length_field, player_field, policy_field, seed_field
from .look_fields import LookSettings
from .path_fields import PathSettings
from .pin_fields import PinFields
from .reach_fields import ReachSettings
from .story_fields import BeatSettings

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

_STARTS = (
    ("CHARACTER", "As It Stands", "Where the character stands at the playhead, facing as it does"),
    ("ORIGIN", "Origin", "Under the armature's origin, facing its -Y (towards the front view)"),
)

_GROUNDS = (
    ("PLANE", "Plane", "Level ground at height 0"),
    ("OBJECT", "Object", "The faces of an object: feet stand on it, on slopes and stairs, too"),
    ("COLLECTION", "Collection", "The faces of all that is visible in a collection"),
)

_HANDS = (
    ("RELAXED", "Relaxed", "Fingers side by side and bent, as of a hand that does nothing"),
    ("ACTION", "Action", "As on the first frame of an Action, such as a fist"),
    ("REST", "Rest Pose", "As in the armature's rest pose"),
)

_KEEPING = (
    ("PACKED", "In the .blend", "Inside the .blend file"),
    ("BESIDE", "Beside It", "In a policy file beside the .blend, written when that is saved"),
)


class BuildSettings(BuildFields, bpy.types.PropertyGroup):
    """The panel's settings of Build."""


class PopulateSettings(PopulateFields, bpy.types.PropertyGroup):
    """The panel's settings of Populate."""


def _is_mesh(_settings: CrowdSettings, obj: bpy.types.Object) -> bool:
    return bool(obj.type == "MESH")


class CrowdSettings(bpy.types.PropertyGroup):
    """What a crowd goes along, about and around."""

    area: PointerProperty(  # type: ignore[valid-type]
        name="Area",
        description="The mesh on which they go about, where its active vertex group is painted",
        type=bpy.types.Object,
        poll=_is_mesh,
    )
    paths: PointerProperty(  # type: ignore[valid-type]
        name="Paths",
        description="A collection of curves among which they are shared out; empty: they go along the one of Path",
        type=bpy.types.Collection,
    )
    obstacles: PointerProperty(  # type: ignore[valid-type]
        name="Obstacles",
        description="A collection: they keep clear of the boxes around its objects, seen from above",
        type=bpy.types.Collection,
    )


class BakeSettings(BakeFields, bpy.types.PropertyGroup):
    """The panel's settings of Bake."""


class DriveSettings(TraceFields, bpy.types.PropertyGroup):
    """The panel's settings of Drive."""

    relative: EnumProperty(  # type: ignore[valid-type]
        name="Stick", description="What the direction of the stick is relative to", items=_RELATIVE, default="VIEW"
    )
    start: EnumProperty(  # type: ignore[valid-type]
        name="Start", description="Where a drive begins; a replay begins where its recording did", items=_STARTS
    )
    seed: seed_field("Draws which fragment of a class plays: the same controls and the same seed, the same motion")  # type: ignore[valid-type]
    replay: policy_field(  # type: ignore[valid-type]
        "The policy that replays a recording",
        "RECORDED",
        ("RECORDED", "As Recorded", "The policy and the seed that it was recorded with"),
        name="Replay With",
    )
    follow: BoolProperty(  # type: ignore[valid-type]
        name="Follow", description="Move the view with the character; it goes back when the drive ends", default=True
    )
    click_to_walk: BoolProperty(  # type: ignore[valid-type]
        name="Click to Walk",
        description="A click on the ground sends the character there; with Shift it runs. Any other input takes over",
        default=True,
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
        description="What is asked for, what the character does, what is recorded, and for how long",
        default=True,
    )
    show_details: BoolProperty(  # type: ignore[valid-type]
        name="Details",
        description="Below it the class that plays, its quality, how soon the stick was answered, and updates a second",
        default=False,
    )
    show_stick: BoolProperty(  # type: ignore[valid-type]
        name="Stick",
        description="A stick in the corner of the view, to be dragged with the mouse",
        default=True,
    )
    player: player_field("Whose habits the trace has", "walker")  # type: ignore[valid-type]
    seconds: length_field(20.0)  # type: ignore[valid-type]
    over_seconds: length_field(2.0, 0.1, "Record Over lets you drive, from the playhead on")  # type: ignore[valid-type]


class PinSettings(PinFields, bpy.types.PropertyGroup):
    """The panel's settings of Pin Here."""


def _may_be_ground(_settings: GroundSettings, obj: bpy.types.Object) -> bool:
    return obj.type in WITH_FACES


class FeelSettings(bpy.types.PropertyGroup):
    """How the character moves when it is driven and baked, whatever its policy."""

    # The core's PlayerOptions.
    responsiveness: factor_field(  # type: ignore[valid-type]
        "Responsiveness",
        "How soon the character follows the stick: in the middle it speeds up and brakes as a body does, by nearly 5 "
        "metres a second in a second; at 0 half as fast; at 1 at once, as if it weighed nothing, and feet may slide",
        0.5,
    )
    root_adjustment: factor_field(  # type: ignore[valid-type]
        "Root Adjustment",
        "How much the body does of what the stick says beyond what its takes do: at 0 it moves as the actor did, "
        "at 1 it goes up to three fifths faster, slower or aside, and turns as the stick says",
        1.0,
    )
    lock_feet: BoolProperty(  # type: ignore[valid-type]
        name="Planted Feet", description="Feet that stand stay where they are, and legs follow", default=True
    )


class GroundSettings(bpy.types.PropertyGroup):
    """What the character stands on when it is driven, baked and copied."""

    kind: EnumProperty(name="Ground", description="What the character goes on", items=_GROUNDS, default="PLANE")  # type: ignore[valid-type]
    object: PointerProperty(  # type: ignore[valid-type]
        name="Object",
        description="The object whose faces are the ground, as it stands when a drive or a bake begins",
        type=bpy.types.Object,
        poll=_may_be_ground,
    )
    collection: PointerProperty(  # type: ignore[valid-type]
        name="Collection",
        description="The collection whose visible objects are the ground, without what belongs to the character",
        type=bpy.types.Collection,
    )


class PolicyFigure(bpy.types.PropertyGroup):
    """How one policy did, by its `name`."""

    quality: FloatProperty()  # type: ignore[valid-type]


class CoverageFigure(bpy.types.PropertyGroup):
    """A row, by its `name`, of the table that says how many controls are done."""

    performed: IntVectorProperty(size=len(COLUMNS))  # type: ignore[valid-type]
    total: IntVectorProperty(size=len(COLUMNS))  # type: ignore[valid-type]


class _Coverage:
    """Which controls there are, and how many of them are done."""

    performed: IntProperty()  # type: ignore[valid-type]
    makes_jumps: BoolProperty()  # type: ignore[valid-type]
    coverage: CollectionProperty(type=CoverageFigure)  # type: ignore[valid-type]
    distances: StringProperty(subtype="BYTE_STRING", options={"HIDDEN"})  # type: ignore[valid-type]
    """[controls] float32: ControlDis to the nearest fragment."""
    # As ControlLayout says it; what has none was built with the paper's.
    gaits: StringProperty(default=", ".join(ControlLayout().gaits))  # type: ignore[valid-type]
    directions: IntProperty(default=ControlLayout().directions)  # type: ignore[valid-type]
    turn: BoolProperty(default=True)  # type: ignore[valid-type]
    jump: BoolProperty(default=True)  # type: ignore[valid-type]


class StyleFigure(_Coverage, bpy.types.PropertyGroup):
    """What the last build found of one style, by its `name`."""

    fragments: IntProperty()  # type: ignore[valid-type]
    classes: IntProperty()  # type: ignore[valid-type]
    quality: FloatProperty()  # type: ignore[valid-type]
    rows: CollectionProperty(type=ClassRow)  # type: ignore[valid-type]
    """Its classes; the first style's are the armature's."""


_listed: list[tuple[str, str, str]] = []  # Blender keeps no reference to an enumeration's texts


def _styles(figures: BuildFigures, _context: bpy.types.Context | None) -> list[tuple[str, str, str]]:
    """The character's styles, as EnumProperty wants them."""
    _listed[:] = [
        (str(i), style.name, "Show the classes, the decisions and the coverage of this style")
        for i, style in enumerate(figures.styles)
    ]
    return _listed


def _show_style(figures: BuildFigures, number: int) -> None:
    figures.active_style = number


class BuildFigures(_Coverage, bpy.types.PropertyGroup):
    """What the last build found."""

    abilities: StringProperty(options={"HIDDEN"})  # type: ignore[valid-type]
    """What it can do, in words; empty of what an earlier version built."""
    captured: IntProperty()  # type: ignore[valid-type]
    fragments: IntProperty()  # type: ignore[valid-type]
    classes: IntProperty()  # type: ignore[valid-type]
    controls: IntProperty()  # type: ignore[valid-type]
    seconds: FloatProperty()  # type: ignore[valid-type]
    stature: FloatProperty()  # type: ignore[valid-type]
    quality: FloatProperty()  # type: ignore[valid-type]
    examiner: StringProperty()  # type: ignore[valid-type]
    sources: StringProperty()  # type: ignore[valid-type]
    policies: CollectionProperty(type=PolicyFigure)  # type: ignore[valid-type]
    styles: CollectionProperty(type=StyleFigure)  # type: ignore[valid-type]
    shown_style: EnumProperty(  # type: ignore[valid-type]
        name="Style",
        description="The style whose classes, decisions and controls the panels show",
        items=_styles,
        get=shown_style,
        set=_show_style,
    )
    active_style: IntProperty(min=0)  # type: ignore[valid-type]


def _bake_selected(settings: CharacterSettings, _context: bpy.types.Context) -> None:
    """What was selected last is what is baked."""
    if settings.recordings:
        settings.bake.trace_source = "RECORDING"


def _is_other_armature(settings: CharacterSettings, obj: bpy.types.Object) -> bool:
    return is_source(obj, settings.id_data)


class CharacterSettings(bpy.types.PropertyGroup):
    """An armature object's `fragmotion`: settings, figures, the policy file's bytes and the recordings."""

    roles: CollectionProperty(type=RoleBone)  # type: ignore[valid-type]
    """What the bones are to the body, where the user has looked at it."""
    doubts: CollectionProperty(type=DoubtfulBone)  # type: ignore[valid-type]
    hanging: CollectionProperty(type=HangingBone)  # type: ignore[valid-type]
    source: PointerProperty(  # type: ignore[valid-type]
        name="From",
        description="Another armature of this file, whose Actions this one is to perform",
        type=bpy.types.Object,
        poll=_is_other_armature,
    )
    control_rig: PointerProperty(type=ControlRigSettings)  # type: ignore[valid-type]
    build: PointerProperty(type=BuildSettings)  # type: ignore[valid-type]
    hands: EnumProperty(  # type: ignore[valid-type]
        name="Hands",
        description="How the fingers are in takes that do not move them, from the next Build on",
        items=_HANDS,
    )
    hand_action: PointerProperty(  # type: ignore[valid-type]
        name="Pose", description="The Action whose first frame has the hand pose", type=bpy.types.Action
    )
    bake: PointerProperty(type=BakeSettings)  # type: ignore[valid-type]
    populate: PointerProperty(type=PopulateSettings)  # type: ignore[valid-type]
    crowd: PointerProperty(type=CrowdSettings)  # type: ignore[valid-type]
    drive: PointerProperty(type=DriveSettings)  # type: ignore[valid-type]
    pin: PointerProperty(type=PinSettings)  # type: ignore[valid-type]
    pin_at: PointerProperty(  # type: ignore[valid-type]
        name="Pin At",
        description="Where Pin Here wants the character, facing the object's -Y; empty: at the 3D cursor",
        type=bpy.types.Object,
    )
    path: PointerProperty(type=PathSettings)  # type: ignore[valid-type]
    story: CollectionProperty(type=BeatSettings)  # type: ignore[valid-type]
    active_beat: IntProperty(name="Entry", description="The entry that is selected in the storyboard")  # type: ignore[valid-type]
    feel: PointerProperty(type=FeelSettings)  # type: ignore[valid-type]
    ground: PointerProperty(type=GroundSettings)  # type: ignore[valid-type]
    look: PointerProperty(type=LookSettings)  # type: ignore[valid-type]
    left_hand: PointerProperty(type=ReachSettings)  # type: ignore[valid-type]
    right_hand: PointerProperty(type=ReachSettings)  # type: ignore[valid-type]
    held: FloatProperty(  # type: ignore[valid-type]
        name="Weight",
        description="How much a hand that reaches for this object is there: 0 not at all, 1 wholly. Key it to let the "
        "hand take it and let it go",
        default=1.0,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
    )
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
    recordings: CollectionProperty(type=Recording)  # type: ignore[valid-type]
    active_recording: IntProperty(  # type: ignore[valid-type]
        name="Recording", description="The recording that is selected in the list", update=_bake_selected
    )
    moves: CollectionProperty(type=MoveRow)  # type: ignore[valid-type]
    active_move: IntProperty(name="Move", description="The move that is selected in the list")  # type: ignore[valid-type]
    moves_told: StringProperty(options={"HIDDEN"})  # type: ignore[valid-type]
    """What the list said of the moves when the character was given them."""
    digest: StringProperty(options={"HIDDEN"})  # type: ignore[valid-type]
    """Of the policy's bytes, by which panels know it without reading it."""
