# SPDX-License-Identifier: MIT
"""`fragmotion retarget`: takes of any skeletons on another one, the character that they make, and its figures."""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from ..core import core
from ..evaluate.loading import Recordings, core_failures
from ..evaluate.report import Table, text
from ..running import Done, say
from . import inputs
from .character import make_character
from .roles import check_bones, make_body
from .sources import Source, read_body, read_sources


class Retargeted(NamedTuple):
    """What was found, and the character."""

    done: Done
    character: core.Character


def retarget(options: argparse.Namespace) -> Done:
    """Bring takes onto the skeleton of a file."""
    inputs.check(options)
    sources = read_sources(options.takes, options.unit)
    body = read_body(options.onto, options.onto_unit, options.roles, options.armature)
    return bring(options, sources, body).done


def bring(options: argparse.Namespace, sources: list[Source], body: core.Body) -> Retargeted:
    """Bring takes onto a body, write them where it is asked for, and build a character of them."""
    check_bones([body.skeleton, *(source.skeleton for source in sources)], options.roles)
    say(f"onto {options.onto.name}: {body.skeleton.stature:.2f} m tall, {len(body.roles)} roles")
    clips, takes = onto(body, sources, options.roles)
    if options.into:
        _write(clips, body.skeleton, options.into)
    made = make_character(Recordings(body.skeleton, clips), options.seed)
    figures = {"roles": body.roles, "takes": takes, "character": made.figures}
    return Retargeted(
        Done(figures, f"{text(takes_table(takes))}\n\n{text(character_table(made.figures))}"), made.character
    )


def _write(clips: list[core.Clip], skeleton: core.Skeleton, folder: Path) -> None:
    """Each take as a BVH file of its name."""
    names = [clip.name for clip in clips]
    twice = {name for name in names if names.count(name) > 1}
    if twice:
        raise ValueError(f"several takes are called '{min(twice)}', and one would replace the other in {folder}")
    folder.mkdir(parents=True, exist_ok=True)
    for clip in clips:
        core.write_bvh(core.Take.from_clip(clip, skeleton), folder / f"{clip.name}.bvh")


def onto(
    body: core.Body, sources: list[Source], roles: Sequence[tuple[str, str]]
) -> tuple[list[core.Clip], list[dict[str, Any]]]:
    """All takes on the body, and what is told of each, skeleton by skeleton."""
    clips, takes = [], []
    for source in sources:
        with core_failures(f"{source.paths[0]} onto {body.skeleton.names[0]}"):
            results = core.Retarget(make_body(source.skeleton, source.clips, roles), body).apply_all(source.clips)
        clips += [result.clip for result in results]
        takes += [describe(path, result) for path, result in zip(source.paths, results)]
    return clips, takes


def describe(path: Path, result: core.RetargetedClip) -> dict[str, Any]:
    """A take's figures, and what is remarkable about them."""
    return {
        "path": str(path),
        "foot_skate_ratio": result.foot_skate_ratio,
        "contact_error_m": result.contact_error,
        "knee_beyond_degrees": math.degrees(result.knee_beyond),
        "limb_degrees": {role: math.degrees(angle) for role, angle in result.limb_angles.items()},
        "findings": [{"code": code, "severity": severity, "text": text} for code, severity, text in result.remarks],
    }


def takes_table(takes: list[dict[str, Any]]) -> Table:
    """A row a take."""
    rows = [
        [
            Path(take["path"]).name,
            f"{take['foot_skate_ratio']:.2f}",
            f"{1000 * take['contact_error_m']:.1f}",
            f"{take['knee_beyond_degrees']:.2f}",
            _farthest(take["limb_degrees"]),
            "; ".join(finding["text"] for finding in take["findings"]),
        ]
        for take in takes
    ]
    header = [
        "take",
        "foot skate, ratio",
        "contact error, mm",
        "knee beyond, degrees",
        "farthest limb, degrees",
        "findings",
    ]
    return Table(f"{len(takes)} takes retargeted", header, rows)


def _farthest(angles: dict[str, float]) -> str:
    """The limb that is farthest from the actor's."""
    if not angles:
        return "-"
    limb, angle = max(angles.items(), key=lambda item: item[1])
    return f"{angle:.0f} ({limb.replace('_', ' ')})"


def character_table(figures: dict[str, float]) -> Table:
    """The character's figures."""
    row = [
        str(figures["fragments"]),
        f"{figures['percent_of_optimal']:.1f}",
        f"{figures['velocity_error']:.2f}",
        f"{figures['foot_skate_ratio']:.2f}",
    ]
    header = ["fragments", "percent of Optimal", "velocity error, m/s", "foot skate, ratio"]
    return Table("The character of them", header, [row])
