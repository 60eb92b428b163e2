# SPDX-License-Identifier: MIT
"""Compare the figures of the sample's takes with tests/quality/baseline.json, or write that anew.

`python3 -m tools.measuring.quality` builds the core first; `--help` tells what there is.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from importlib.util import find_spec
from typing import Any

from tools.measuring import running
from tools.measuring.quality import gate
from tools.shell import Failure, say


def compare_or_write(why: str | None) -> int:
    """Compare, or write and say why; the exit code is 1 where a figure is worse than its spread allows."""
    from tools.measuring.quality.measured import measure_now

    before, lowered = gate.read_baseline(gate.BASELINE.read_text()) if gate.BASELINE.exists() else ({}, [])
    now = measure_now()
    some = gate.changes(before, now)
    say(gate.table(some))
    if why is None:
        return 1 if any(change.fails for change in some) else 0
    some = [change.kept for change in some]
    kept = {**now, **{change.name: change.now for change in some}}
    gate.BASELINE.write_text(gate.written(kept, [*lowered, *lowering(some, why.strip())]))
    say(f"written: {gate.BASELINE}")
    return 0


def lowering(some: Sequence[gate.Change], why: str) -> list[dict[str, Any]]:
    """A line for each bar that is lowered; Failure where that is not told why."""
    more = gate.lowered_bars(some, why)
    if more and not why:
        names = ", ".join(row["figure"] for row in more)
        raise Failure(f'this lowers the bar of {names}: say why, as in --write "why"')
    return more


def main(arguments: list[str]) -> int:
    """Run, where need be with the core that is built first, and return the exit code."""
    parser = argparse.ArgumentParser("python3 -m tools.measuring.quality", description=__doc__)
    parser.add_argument(
        "--write", nargs="?", const="", metavar="WHY", help="write the file anew; why, where a bar is lowered by it"
    )
    options = parser.parse_args(arguments)
    try:
        if find_spec("fragmotion_core") is None:
            return running.run_quality(arguments)
        return compare_or_write(options.write)
    except Failure as failure:
        print(f"quality: {failure}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
