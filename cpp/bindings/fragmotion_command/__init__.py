# SPDX-License-Identifier: MIT
"""The command `fragmotion` of the core's wheel; Blender's `blender -c fragmotion` is the same and more.

What it says and asks for is in `parser`; each other module does what one word asks for, with the core alone.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence

__all__ = ["main"]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command, by default that of the process; the exit code."""
    from .parser import make_parser  # what needs no core, such as .files and .evaluate.report, comes without it
    from .running import run

    return run(make_parser("fragmotion").parser, sys.argv[1:] if arguments is None else arguments)
