# SPDX-License-Identifier: MIT
"""Build a character, direct it, and print how well it did what it was asked.

`python3 dev.py directing` runs this with the built core; python -m tools.measuring.directing --help tells the rest.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from typing import Any

import fragmotion_core as core
from fragmotion_command.evaluate.loading import SECONDS, TEACHER, Recordings, core_failures, make_session
from fragmotion_command.evaluate.measures import curves
from fragmotion_command.evaluate.measures.controllers import DEFAULT
from fragmotion_command.evaluate.report import text

from tools.measuring.blend import read_recordings
from tools.measuring.command import run_command
from tools.measuring.directing import inputs
from tools.measuring.directing.figures import draw_paths
from tools.measuring.directing.measures.courses import courses
from tools.measuring.directing.measures.ground import ground
from tools.measuring.directing.measures.moves import listed_moves, moves
from tools.measuring.directing.measures.paths import follow_all
from tools.measuring.directing.measures.pins import pins
from tools.measuring.directing.measures.spaces import spaces
from tools.measuring.directing.measures.styles import Style, styled_takes, styles
from tools.measuring.directing.table import tables
from tools.shell import say

CLASSES = 97


def make_character(recordings: Recordings, seed: int) -> core.Character:
    """A character as the add-on builds it by default."""
    teacher = make_session(TEACHER, core.simulate_trace(TEACHER, SECONDS, seed), core.ControlSpace())
    return curves.build(recordings, teacher, CLASSES, seed, [DEFAULT])


def make_styled(skeleton: core.Skeleton, takes: Sequence[Style], seed: int) -> core.Character:
    """A character in these styles, as the add-on builds it by default."""
    options = core.BuildOptions()
    options.classes, options.seed, options.policies = CLASSES, seed, [DEFAULT]
    with core_failures("Building"):
        return core.build_styles(skeleton, takes, [core.simulate_trace(TEACHER, SECONDS, seed)], options)


def measure(character: core.Character, takes: Sequence[Style], seed: int) -> dict[str, Any]:
    """All figures of a character, and of one in the styles of these takes, as the JSON file holds them."""
    return {
        "paths": follow_all(character, courses(seed)),
        "pins": pins(character),
        "moves": moves(character),
        "styles": styles(takes, lambda some: make_styled(character.skeleton, some, seed), seed),
        "ground": ground(character),
    }


def direct(options: argparse.Namespace) -> None:
    """Do all that the options ask for; Failure says what was wrong with them."""
    inputs.check(options)
    recordings = read_recordings(inputs.mocap_of(options), options.unit)
    takes = styled_takes(inputs.mocap_of(options), options.style, recordings)
    say(f"building a character from {len(recordings.clips)} takes")
    character = make_character(recordings, options.seed).with_moves(listed_moves(inputs.mocap_of(options)))
    say("directing it")
    result = measure(character, takes, options.seed)
    say("building characters of other controls")
    result["spaces"] = spaces(recordings, options.seed)
    for table in tables(result).values():
        say(f"\n{text(table)}")
    if options.figures:
        say(f"\npicture: {draw_paths(character, courses(options.seed), options.figures)}")
    if options.json:
        options.json.write_text(json.dumps(result, indent=1, allow_nan=False) + "\n")
        say(f"\nfigures: {options.json}")


def main(arguments: list[str]) -> int:
    """Run, and return the exit code."""
    return run_command("directing", __doc__, inputs.add_arguments, direct, arguments)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
