# SPDX-License-Identifier: MIT
"""What the commands of dev.py that measure have alike: `python -m tools.measuring.NAME ARGUMENTS`, the core built."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from tools.shell import Failure

BLEND = ".blend"


def has_blend(paths: Sequence[Path]) -> bool:
    """Whether Blender is needed to read the takes."""
    return any(path.suffix.lower() == BLEND for path in paths)


def run_command(
    name: str,
    description: str | None,
    add_arguments: Callable[[argparse.ArgumentParser], None],
    do: Callable[[argparse.Namespace], int | None],
    arguments: Sequence[str],
) -> int:
    """Do what the arguments ask for; the exit code, which is 1 where the cause of a failure was told."""
    parser = argparse.ArgumentParser(prog=f"dev.py {name}", description=description)
    add_arguments(parser)
    try:
        return do(parser.parse_args(arguments)) or 0
    except (Failure, ValueError, OSError) as failure:
        print(f"{name}: {failure}", file=sys.stderr)
        return 1
