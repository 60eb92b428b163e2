# SPDX-License-Identifier: MIT
"""Measure a character of given takes on given traces, print the figures, and save and draw them where asked.

`python3 dev.py evaluate` runs this with the built core; python -m tools.measuring.evaluate --help tells what there is.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

from tools.measuring.command import run_command
from tools.measuring.evaluate import figures, inputs, report
from tools.measuring.evaluate.loading import make_sessions, read_recordings, save_sessions
from tools.measuring.evaluate.measuring import Result, measure, measure_quickly
from tools.shell import say


def evaluate(options: argparse.Namespace) -> None:
    """Do all that the options ask for; Failure says what was wrong with them."""
    inputs.check(options)
    recordings = read_recordings(options.mocap, options.unit)
    sessions = make_sessions(options, recordings)
    result = (measure_quickly if options.quick else measure)(recordings, sessions, options)
    if not options.quick:
        say(f"\n{report.summary(result)}")
    for table in report.quick_tables(result) if options.quick else report.tables(result):
        say(f"\n{report.text(table)}")
    if options.json:
        save(result, options.json)
        say(f"\nfigures: {options.json}")
    if options.figures:
        save_sessions(sessions, options.figures / "traces")
        say(f"\npictures: {', '.join(str(path) for path in figures.draw_all(result, options.figures))}")
        say(f"traces: {options.figures / 'traces'}")


def save(result: Result, path: Path) -> None:
    """Write the JSON file."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(result, indent=1, allow_nan=False) + "\n")


def main(arguments: list[str]) -> int:
    """Run, and return the exit code."""
    return run_command("evaluate", __doc__, inputs.add_arguments, evaluate, arguments)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
