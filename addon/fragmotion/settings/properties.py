# SPDX-License-Identifier: GPL-3.0-or-later
"""What our property groups are, and what of the .blend has one: armature objects, Actions and the window manager.

The fields of a stage are written down once: the panel's settings and the stage's operator both have them.
"""

from __future__ import annotations

import bpy
from bpy.props import (
    BoolProperty,
    CollectionProperty,
    EnumProperty,
    FloatProperty,
    IntProperty,
    PointerProperty,
    StringProperty,
)

from ..character.classes import ClassRow
from ..character.inspector import InspectorSettings
from ..character.moves import MoveRow
from ..character.suggesting import NumberTried
from ..control_rig.binding import ControlRigSettings, FormerSwitch
from ..mocap.doctor import TakeFinding
from ..mocap.left_out import FrameSpan
from ..recordings.recordings import Recording
from ..rig.bodies import DoubtfulBone, RoleBone
from ..rig.hanging import HangingBone
from .armature import (
    BakeSettings,
    BuildFigures,
    BuildSettings,
    CharacterSettings,
    CoverageFigure,
    CrowdSettings,
    DriveSettings,
    FeelSettings,
    GroundSettings,
    PinSettings,
    PolicyFigure,
    PopulateSettings,
    StyleFigure,
)
from .look_fields import LookSettings
from .path_fields import PathSettings
from .reach_fields import ReachSettings
from .story_fields import BeatSettings

_ORDERS = (
    ("NAME", "Name", "By name", "SORTALPHA", 0),
    ("LONGEST", "Longest First", "By how long they are, the longest first", "SORT_DESC", 1),
    ("SHORTEST", "Shortest First", "By how long they are, the shortest first", "SORT_ASC", 2),
)


class ActionSettings(bpy.types.PropertyGroup):
    """An Action's `fragmotion`."""

    use: BoolProperty(  # type: ignore[valid-type]
        name="Learn from it", description="Build cuts fragments from the ticked Actions", default=False
    )
    style: StringProperty(  # type: ignore[valid-type]
        name="Style",
        description="What style the take is of, such as tired: a character has all styles of its takes",
    )
    speed: FloatProperty(  # type: ignore[valid-type]
        name="Speed",
        description="How fast a take on the spot goes; 0: as its feet tell",
        min=0.0,
        soft_max=10.0,
        max=1000.0,
        unit="VELOCITY",
    )
    left_out: CollectionProperty(type=FrameSpan)  # type: ignore[valid-type]
    findings: CollectionProperty(type=TakeFinding)  # type: ignore[valid-type]


class WindowSettings(bpy.types.PropertyGroup):
    """The window manager's `fragmotion`: what no file need remember."""

    active_action: IntProperty()  # type: ignore[valid-type]
    take_search: StringProperty(  # type: ignore[valid-type]
        name="Search", description="List only the takes with this in their name", options={"TEXTEDIT_UPDATE"}
    )
    take_order: EnumProperty(name="Order", description="How the takes are listed", items=_ORDERS)  # type: ignore[valid-type]
    show_mocap: BoolProperty(  # type: ignore[valid-type]
        name="Takes", description="Show the takes again, and what belongs to them; Build folds them away"
    )
    show_build: BoolProperty(  # type: ignore[valid-type]
        name="Build", description="Show how to build again, and what the build found; Build folds it away"
    )
    active_class: IntProperty(min=0)  # type: ignore[valid-type]
    inspector: PointerProperty(type=InspectorSettings)  # type: ignore[valid-type]


CLASSES = (
    ClassRow,
    NumberTried,
    Recording,
    MoveRow,
    FrameSpan,
    TakeFinding,
    RoleBone,
    DoubtfulBone,
    HangingBone,
    FormerSwitch,
    ControlRigSettings,
    InspectorSettings,
    BuildSettings,
    BakeSettings,
    CrowdSettings,
    PopulateSettings,
    DriveSettings,
    PathSettings,
    FeelSettings,
    GroundSettings,
    LookSettings,
    ReachSettings,
    BeatSettings,
    PinSettings,
    PolicyFigure,
    CoverageFigure,
    StyleFigure,
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
