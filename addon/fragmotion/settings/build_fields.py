# SPDX-License-Identifier: GPL-3.0-or-later
"""What a build can be told."""

from __future__ import annotations

from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty

from ..compat.core import core
from .common import CHOOSING, TraceFields, length_field, player_field, policy_field, seed_field, source_field

_DEFAULTS = core.BuildOptions()

_RECORDINGS = ("RECORDINGS", "Recordings", "The ticked recordings of the Recordings panel")

_CUTS = (
    ("gait", "At Footsteps", "Cut where a foot strikes the ground; by windows where the armature has no feet"),
    ("windows", "By Windows", "Cut into windows of equal length, whatever the feet do"),
)


_CONTROLS = (
    ("PAPER", "Standard", "102: standing, 8 directions at a walk and at a run; turning or not; jumping or not"),
    ("FOUND", "From the Takes", "As many speeds and directions as the takes hold, turns and jumps where they do"),
    ("TOLD", "These", "As many speeds and directions as you say, with turns and jumps or without"),
)

_DIRECTIONS = (
    ("4", "4", "Forward, left, back and right"),
    ("8", "8", "Those between, too"),
    ("16", "16", "Those between these, too"),
)


class BuildFields(TraceFields):
    """What a build can be told."""

    controls: EnumProperty(  # type: ignore[valid-type]
        name="Controls",
        description="What the character can be asked for. How fast its speeds are comes from the takes",
        items=_CONTROLS,
    )
    speeds: IntProperty(  # type: ignore[valid-type]
        name="Speeds",
        description="From the takes' slowest to their fastest; called stroll, walk, jog, run and sprint",
        default=_DEFAULTS.speeds,
        min=1,
        max=4,
    )
    directions: EnumProperty(  # type: ignore[valid-type]
        name="Directions",
        description="In how many directions it can be sent",
        items=_DIRECTIONS,
        default=str(_DEFAULTS.directions),
    )
    turn: BoolProperty(  # type: ignore[valid-type]
        name="Turn", description="Whether it can be asked to turn", default=_DEFAULTS.turn
    )
    jump: BoolProperty(  # type: ignore[valid-type]
        name="Jump", description="Whether it can be asked to jump", default=_DEFAULTS.jump
    )

    trace_source: source_field(_RECORDINGS)  # type: ignore[valid-type]
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
        description="Number of clusters of similar fragments, at most: there are no more than different fragments",
        default=_DEFAULTS.classes,
        min=2,
        soft_max=500,
    )
    seed: seed_field("Same takes and same seed: same character")  # type: ignore[valid-type]
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
    policy: policy_field(CHOOSING, _DEFAULTS.policies[0])  # type: ignore[valid-type]
    player: player_field("Whose habits the policy learns from", "explorer")  # type: ignore[valid-type]
    seconds: length_field(60.0, 1.0)  # type: ignore[valid-type]
