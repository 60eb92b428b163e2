# SPDX-License-Identifier: MIT
"""Bring takes of any skeletons onto another one, build a character of them, print the figures, and save them.

`python3 dev.py retarget` runs this with the built core; python -m tools.measuring.retarget --help tells what there is.
"""

from __future__ import annotations

import argparse
import math
import sys
from pathlib import Path
from typing import Any

import fragmotion_core as core

from tools.measuring.command import run_command
from tools.measuring.evaluate.__main__ import save
from tools.measuring.evaluate.loading import Recordings, core_failures
from tools.measuring.evaluate.report import Table, text
from tools.measuring.retarget import inputs, rigs
from tools.measuring.retarget.character import make_character
from tools.measuring.retarget.sources import Source, body_of, read_body, read_sources
from tools.shell import say

_SKATE, _CONTACT = 1.1, 0.01  # ratio, and m of a 1.8 m character: beyond these a take is remarked on
_HIPS = 0.05  # m of a 1.8 m character that hips are moved without a remark


def retarget(options: argparse.Namespace) -> None:
    """Do all that the options ask for; Failure says what was wrong with them."""
    inputs.check(options)
    sources = read_sources(options.mocap, options.unit)
    rig = rigs.open_rig(options.onto, options.armature) if inputs.needs_blender(options) else None
    body = body_of(rig) if rig else read_body(options.onto, options.onto_unit or options.unit)
    say(f"onto {options.onto.name}: {body.skeleton.stature:.2f} m tall, {len(body.roles)} roles")
    clips, takes = onto(body, sources)
    say(text(takes_table(takes)))
    made = make_character(Recordings(body.skeleton, clips), options.seed)
    say(f"\n{text(character_table(made.figures))}")
    if options.json:
        save({"roles": body.roles, "takes": takes, "character": made.figures}, options.json)
        say(f"\nroles and figures: {options.json}")
    if rig and options.blend:
        rigs.save_minute(rig, made.character, options.seed, options.blend)
        say(f"a minute of it: {options.blend}")


def onto(body: core.Body, sources: list[Source]) -> tuple[list[core.Clip], list[dict[str, Any]]]:
    """All takes on the body, and what is told of each, skeleton by skeleton."""
    clips, takes = [], []
    for source in sources:
        with core_failures(f"{source.paths[0]} onto {body.skeleton.names[0]}"):
            results = core.Retarget(core.Body(source.skeleton, source.clips), body).apply_all(source.clips)
        clips += [result.clip for result in results]
        takes += [describe(path, result, body) for path, result in zip(source.paths, results)]
    return clips, takes


def describe(path: Path, result: core.RetargetedClip, body: core.Body) -> dict[str, Any]:
    """A take's figures, and what is remarkable about them."""
    return {
        "path": str(path),
        "foot_skate_ratio": result.foot_skate_ratio,
        "contact_error_m": result.contact_error,
        "knee_beyond_degrees": math.degrees(result.knee_beyond),
        "findings": findings(result, 1.8 / body.skeleton.stature),
    }


def findings(result: core.RetargetedClip, scale: float) -> list[dict[str, str]]:
    """What a viewer may find fault with; `scale` times, lengths are of a 1.8 m character."""
    found = []
    if result.foot_skate_ratio > _SKATE:
        found.append(("foot_skate", f"feet slide {result.foot_skate_ratio:.2f} times as much as in the take"))
    if result.contact_error * scale > _CONTACT:
        found.append(("contact", f"a standing foot is up to {100 * result.contact_error:.1f} cm off the ground"))
    if result.hips_moved * scale > _HIPS:
        found.append(("hips", f"the hips are moved by up to {100 * result.hips_moved:.1f} cm for the legs to reach"))
    return [{"code": code, "severity": "warning", "text": said} for code, said in found]


def takes_table(takes: list[dict[str, Any]]) -> Table:
    """A row a take."""
    rows = [
        [
            Path(take["path"]).name,
            f"{take['foot_skate_ratio']:.2f}",
            f"{1000 * take['contact_error_m']:.1f}",
            f"{take['knee_beyond_degrees']:.2f}",
            "; ".join(finding["text"] for finding in take["findings"]),
        ]
        for take in takes
    ]
    header = ["take", "foot skate, ratio", "contact error, mm", "knee beyond, degrees", "findings"]
    return Table(f"{len(takes)} takes retargeted", header, rows)


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


def main(arguments: list[str]) -> int:
    """Run, and return the exit code."""
    return run_command("retarget", __doc__, inputs.add_arguments, retarget, arguments)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
