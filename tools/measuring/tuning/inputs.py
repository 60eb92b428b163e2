# SPDX-License-Identifier: MIT
"""The command line of `dev.py tune`. Needs Python alone."""

from __future__ import annotations

import argparse
from pathlib import Path

from fragmotion_command.files import find_takes

from tools.shell import Failure

SAMPLE = "sample"
"""The set that is the sample character's takes."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What can be asked for."""
    parser.add_argument(
        "sets",
        nargs="+",
        metavar="SET",
        help=f"takes to fit the constants to: a folder, a pattern in quotes, or {SAMPLE}; of each a character is made",
    )
    parser.add_argument(
        "--judge", action="append", default=[], metavar="SET", help="takes that are not fitted; can be given again"
    )
    parser.add_argument(
        "--leave-one-out", action="store_true", help="fit to all sets but one, judge on that one, and so for each"
    )
    parser.add_argument(
        "--sensitivity",
        action="store_true",
        help="fit nothing: say what each constant is worth, by the cost where it is a tenth and ten times as large",
    )
    parser.add_argument("--minutes", type=float, default=30.0, metavar="N", help="how long each fit lasts (default 30)")
    parser.add_argument("--seed", type=int, default=1, metavar="S", help="of all that is drawn at random (default 1)")
    parser.add_argument(
        "--unit", type=float, default=0.01, metavar="M", help="metres in one unit of a BVH file (default 0.01)"
    )
    parser.add_argument("--json", type=Path, metavar="FILE", help="save constants and figures there")


def files_of(name: str) -> list[Path]:
    """The takes of a set that is no sample; Failure where there are none."""
    path = Path(name)
    found = [path] if path.exists() else sorted(path.parent.glob(path.name))
    if not found:
        raise Failure(f"{name}: there are no takes")
    return find_takes(found)


def check(options: argparse.Namespace) -> None:
    """Raise Failure on a number or a file that cannot be used, before anything is measured."""
    if not options.minutes > 0:
        raise Failure(f"--minutes is {options.minutes:g}, and must be over 0")
    if options.seed < 0:
        raise Failure(f"--seed is {options.seed}, and must be 0 or more")
    if not options.unit > 0:
        raise Failure(f"--unit is {options.unit:g}, and must be over 0")
    if options.leave_one_out and (len(options.sets) < 2 or options.judge):
        raise Failure("--leave-one-out takes two sets or more, and judges on each of them: leave --judge out")
    if options.sensitivity and (options.judge or options.leave_one_out):
        raise Failure("--sensitivity fits nothing: leave --judge and --leave-one-out out")
    if options.json and not options.json.absolute().parent.is_dir():
        raise Failure(f"{options.json.parent}: there is no such folder")
    for name in (*options.sets, *options.judge):
        if name != SAMPLE:
            files_of(name)
