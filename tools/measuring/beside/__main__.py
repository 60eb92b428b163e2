# SPDX-License-Identifier: MIT
"""Play the same sessions with Fragmotion and with motion matching, measure both alike, and print the table.

`python3 dev.py beside` runs this with the built core; python -m tools.measuring.beside --help tells what there is.
"""

from __future__ import annotations

import argparse
import json
import sys

from fragmotion_command.evaluate.report import text

from tools.measuring.beside import inputs
from tools.measuring.beside.comparing import compare
from tools.measuring.beside.motion.reenacting import add_likeness
from tools.measuring.beside.setting import make_setting
from tools.measuring.beside.table import beside_table
from tools.measuring.beside.tuning import tune
from tools.measuring.blend import read_recordings
from tools.measuring.command import run_command
from tools.measuring.peers.motion_matching.constants import TUNED, load
from tools.shell import say


def beside(options: argparse.Namespace) -> None:
    """Do all that the options ask for; Failure says what was wrong with them."""
    inputs.check(options)
    path = options.constants or TUNED
    recordings = read_recordings(options.mocap, options.unit)
    say(f"building a character from {len(recordings.clips)} takes, and filling their gaps for motion matching")
    setting = make_setting(recordings, options.seed)
    if options.tune is not None:
        tune(setting, options.tune, path, options.seed)
        say(f"\nconstants: {path}")
        return
    result = compare(setting, load(path), options.seed)
    add_likeness(result, recordings, load(path), options.seed)
    say(f"\n{text(beside_table(result))}")
    if options.json:
        options.json.write_text(json.dumps(result, indent=1, allow_nan=False) + "\n")
        say(f"\nfigures: {options.json}")


def main(arguments: list[str]) -> int:
    """Run, and return the exit code."""
    return run_command("beside", __doc__, inputs.add_arguments, beside, arguments)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
