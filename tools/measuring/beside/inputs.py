# SPDX-License-Identifier: MIT
"""The command line of `dev.py beside`. Needs Python alone."""

from __future__ import annotations

import argparse
from pathlib import Path

from fragmotion_command.files import find_takes

from tools.measuring.command import BLEND
from tools.shell import Failure


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What can be asked for."""
    parser.add_argument(
        "mocap", nargs="+", type=Path, metavar="MOCAP", help="BVH or AMC files, folders of them, or a .blend"
    )
    parser.add_argument("--seed", type=int, default=1, metavar="S", help="of all that is drawn at random (default 1)")
    parser.add_argument(
        "--unit", type=float, default=0.01, metavar="M", help="metres in one unit of a BVH file (default 0.01)"
    )
    parser.add_argument("--json", type=Path, metavar="FILE", help="save all figures there")
    parser.add_argument(
        "--constants",
        type=Path,
        metavar="FILE",
        help="motion matching's tuned ones (default: those for Bandai-Namco's)",
    )
    parser.add_argument(
        "--tune",
        type=float,
        metavar="MINUTES",
        help="look for better constants, and write them to --constants, instead",
    )


def check(options: argparse.Namespace) -> None:
    """Raise Failure on a number or a file that cannot be used, before anything is measured."""
    if options.seed < 0:
        raise Failure(f"--seed is {options.seed}, and must be 0 or more")
    if not options.unit > 0:
        raise Failure(f"--unit is {options.unit:g}, and must be over 0")
    if options.tune is not None and not options.tune > 0:
        raise Failure(f"--tune is {options.tune:g} minutes, and must be over 0")
    if options.tune is None and options.constants and not options.constants.is_file():
        raise Failure(f"{options.constants}: there is no such file of constants")
    for target in (options.json, options.constants):
        if target and not target.absolute().parent.is_dir():
            raise Failure(f"{target.parent}: there is no such folder")
    find_takes(options.mocap, (BLEND,))
