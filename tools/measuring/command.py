# SPDX-License-Identifier: MIT
"""What the commands of dev.py that measure have alike: `python -m tools.NAME ARGUMENTS` with the built core."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence

from tools.shell import Failure


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
    except (Failure, OSError) as failure:
        print(f"{name}: {failure}", file=sys.stderr)
        return 1
