# SPDX-License-Identifier: GPL-3.0-or-later
"""What is wrong with takes as they were read, and its mending before anything is made of them."""

from __future__ import annotations

from collections.abc import Generator, Sequence
from typing import TYPE_CHECKING, NamedTuple

import bpy
from bpy.props import BoolProperty, EnumProperty, StringProperty

from ..compat.core import core
from ..jobs import Job, Report

if TYPE_CHECKING:
    from fragmotion_core import Clip, Examination, Finding, Skeleton, Take

DUPLICATE = "duplicate"
"""The code of a finding that is mended by leaving the take out."""

IN_PLACE = "in_place"
"""The code of a finding that the take goes on the spot."""

UNTOLD = "untold_speed"
"""The code of a finding that the take may go, on the spot, but its feet do not tell how fast."""

_GROUND, _UNIT = "ground", "unit"  # findings' codes
_SIZE = "character_size"  # that of what is wrong with the armature, not with the take
_LIES = (
    "In none of the Actions the body stands: it lies, or its head is down, as where a file's upward axis is taken for "
    "another. Turn the armature, or what it hangs on, until it stands upright in the viewport, and Build again"
)
_BOBS = (
    "The body goes {times:.0f} times as far up and down as its legs stretch and bend, as where a scale was applied "
    "(Ctrl+A) after the Actions were made, which leaves their location keys as they were: import the file again "
    "without that, or scale the location keys of '{hips}', and of what carries it, as the bones were"
)
WAIT = 0.1
"""Seconds between looks at a thread that is waited for."""


class TakeFinding(bpy.types.PropertyGroup):
    """What the doctor found in an Action's take, or mended."""

    severity: EnumProperty(  # type: ignore[valid-type]
        items=(
            ("info", "Note", "Good to know"),
            ("warning", "Warning", "It may show in the character"),
            ("error", "Error", "The take cannot be used so"),
        )
    )
    code: StringProperty()  # type: ignore[valid-type]
    text: StringProperty()  # type: ignore[valid-type]
    mendable: BoolProperty()  # type: ignore[valid-type]
    mended: BoolProperty()  # type: ignore[valid-type]


class Found(NamedTuple):
    """A finding, and whether it is put right."""

    finding: Finding
    mended: bool


class Examined(NamedTuple):
    """A take, mended, and what was found in it."""

    take: Take
    found: list[Found]


def examine(
    takes: Sequence[Take], mends: bool, keep_unit: Sequence[bool], begin: float = 0, end: float = 1
) -> Generator[float, None, list[Examined]]:
    """Examine takes, and with `mends` put right what is safe to; `keep_unit`: whose lengths stay as they were read.
    Gives the share that is done, from `begin` to `end`; where it is closed before, the core stops, too."""

    def task(report: Report) -> list[Examined]:
        seen = core.examine(list(takes), progress=report)
        return [_treat(take, each, mends, keeps, report) for take, each, keeps in zip(takes, seen, keep_unit)]

    job = Job("Examining", task)
    job.start()
    try:
        while job.running:
            job.wait(WAIT)
            yield begin + (end - begin) * job.fraction
    except GeneratorExit:
        job.cancel()
        job.wait()
        raise
    examined: list[Examined] = job.result()
    return examined


def _treat(take: Take, seen: Examination, mends: bool, keep_unit: bool, report: Report) -> Examined:
    findings = seen.findings
    chosen = [f for f in findings if mends and f.safe and not (keep_unit and f.code == _UNIT)]
    mended = core.mend(take, chosen, progress=lambda _fraction, stage: report(1, stage)) if chosen else take
    return Examined(mended, [Found(f, f in chosen) for f in findings])


def say_size(skeleton: Skeleton) -> list[str]:
    """That a character is as no person or animal is, by the Doctor's law, and by how much to scale it to be one."""
    rest = core.Take(skeleton, "rest", 30, skeleton.offsets[None], skeleton.rest_rotations[None])
    told = core.examine([rest])[0]
    return [
        f"The character has no person's or animal's size: {finding.text}. If that is not meant, make the armature, "
        f"or what it hangs on, the child of an Empty, scale that to {told.scale:.3g}, and Build"
        for finding in told.findings
        if finding.code == _UNIT
    ]


def tell_size(actions: Sequence[bpy.types.Action], skeleton: Skeleton) -> list[str]:
    """As `say_size`, and the Doctor says so of these Actions of the character."""
    said = say_size(skeleton)
    for action in actions:
        tell_anew(action, _SIZE, "warning", "".join(said))
    return said


def tell_ground(action: bpy.types.Action, clips: Sequence[Clip], skeleton: Skeleton) -> str:
    """How far over or under the ground the feet stand in an Action's clips, and the Doctor tells it; empty where they
    stand on it, as in clips that were made for the body."""
    found = [each for clip in clips for each in core.examine_ground(core.Take.from_clip(clip, skeleton))]
    said = found[0].text if found else ""
    tell_anew(action, _GROUND, "warning", said, mendable=True)
    return said


def say_lying(clips: Sequence[Clip], skeleton: Skeleton) -> list[str]:
    """That the body stands in none of these clips."""
    return [] if any(clip.stands(skeleton) for clip in clips) else [_LIES]


def say_bobbing(clips: Sequence[Clip], skeleton: Skeleton) -> list[str]:
    """That the body goes up and down many times as far as its legs have it."""
    times = core.bobs_too_far(skeleton, clips)
    return [_BOBS.format(times=times, hips=skeleton.roles["hips"])] if times > 1 else []


def tell_anew(action: bpy.types.Action, code: str, severity: str, text: str, mendable: bool = False) -> None:
    """Keep with an Action what Build finds in place of what it found before; nothing where the text is empty."""
    findings = action.fragmotion.findings
    for index in reversed([i for i, row in enumerate(findings) if row.code == code and not row.mended]):
        findings.remove(index)
    if text and action.library is None:
        row = findings.add()
        row.code, row.severity, row.text, row.mendable = code, severity, text, mendable


def keep_findings(action: bpy.types.Action, found: Sequence[Found]) -> None:
    """Keep with an Action what was found in its take."""
    for finding, mended in found:
        row = action.fragmotion.findings.add()
        row.code, row.severity, row.text = finding.code, finding.severity, finding.text
        row.mendable, row.mended = finding.mendable, mended


def keep_remarks(action: bpy.types.Action, remarks: Sequence[tuple[str, str, str]]) -> None:
    """Keep with an Action what a viewer may find fault with in how it was brought onto its armature."""
    for code, severity, text in remarks:
        row = action.fragmotion.findings.add()
        row.code, row.severity, row.text = code, severity, text


def worst(action: bpy.types.Action) -> str:
    """'error', 'warning' or 'info': the worst that was found in an Action's take and not mended; '' for nothing."""
    found = {row.severity for row in action.fragmotion.findings if not row.mended}
    return next((severity for severity in ("error", "warning", "info") if severity in found), "")
