# SPDX-License-Identifier: MIT
"""Which controls a character that is measured has, on a command line. Needs Python alone."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import fragmotion_core as core


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What can be asked for."""
    parser.add_argument("--find-controls", action="store_true", help="as many speeds and directions as the takes hold")
    parser.add_argument("--speeds", type=int, choices=(1, 2, 3, 4), default=2, help="how many (default 2)")
    parser.add_argument("--directions", type=int, choices=(4, 8, 16), default=8, help="how many (default 8)")
    parser.add_argument("--no-turn", action="store_true", help="no turns can be asked for")
    parser.add_argument("--no-jump", action="store_true", help="no jumps can be asked for")


def tell(build: core.BuildOptions, options: argparse.Namespace) -> None:
    """Tell a build what the command line says."""
    build.find_controls, build.speeds, build.directions = options.find_controls, options.speeds, options.directions
    build.turn, build.jump = not options.no_turn, not options.no_jump
