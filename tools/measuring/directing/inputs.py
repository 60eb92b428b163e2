# SPDX-License-Identifier: MIT
"""The command line of `dev.py directing`. Needs Python alone."""

from __future__ import annotations

import argparse
from pathlib import Path

from fragmotion_command.files import find_takes

from tools.measuring.command import BLEND, has_blend
from tools.paths import TOP
from tools.shell import Failure

SAMPLE = TOP / "sample_rigs" / "fragmotion_sample.blend"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What can be asked for."""
    parser.add_argument(
        "mocap",
        nargs="*",
        type=Path,
        metavar="MOCAP",
        help="BVH or AMC files, folders of them, or a .blend (default: the sample character's)",
    )
    parser.add_argument("--seed", type=int, default=1, metavar="S", help="of all that is drawn at random (default 1)")
    parser.add_argument(
        "--unit", type=float, default=0.01, metavar="M", help="metres in one unit of a BVH file (default 0.01)"
    )
    parser.add_argument(
        "--style",
        action="append",
        default=[],
        metavar="NAME=PATTERN",
        help="the takes of a style, by their names, such as tired=*_tired_*; once for each style (default: as the "
        ".blend has them)",
    )
    parser.add_argument("--figures", type=Path, metavar="DIR", help="draw the paths and the ways over them there")
    parser.add_argument("--json", type=Path, metavar="FILE", help="save all figures there")


def mocap_of(options: argparse.Namespace) -> list[Path]:
    """The files that are named, or the sample character's."""
    return options.mocap or [SAMPLE]


def needs_blender(options: argparse.Namespace) -> bool:
    """Whether Blender is needed to read the takes."""
    return has_blend(mocap_of(options))


def check(options: argparse.Namespace) -> None:
    """Raise Failure on a number or a file that cannot be used, before anything is measured."""
    if options.seed < 0:
        raise Failure(f"--seed is {options.seed}, and must be 0 or more")
    if not options.unit > 0:
        raise Failure(f"--unit is {options.unit:g}, and must be over 0")
    if options.json and not options.json.absolute().parent.is_dir():
        raise Failure(f"{options.json.parent}: there is no such folder")
    for text in options.style:
        if "=" not in text.strip("="):
            raise Failure(f"--style {text} tells no name or no pattern, as in tired=*_tired_*")
    find_takes(mocap_of(options), (BLEND,))
