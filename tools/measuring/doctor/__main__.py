# SPDX-License-Identifier: MIT
"""Say what is wrong with motion capture files before anything is made of them, and what of it is safe to mend.

`python3 dev.py doctor` runs this with the built core; python -m tools.measuring.doctor --help tells what there is.
"""

from __future__ import annotations

import argparse
import json
import sys

from tools.measuring.command import run_command
from tools.measuring.doctor import inputs, report
from tools.measuring.doctor.examining import examine, is_readable
from tools.shell import say


def doctor(options: argparse.Namespace) -> int:
    """Do all that the options ask for; 1 where a file cannot be read. Failure says what was wrong with the options."""
    inputs.check(options)
    result = examine(inputs.find_files(options.files))
    say("\n".join(report.lines(result)))
    if options.json:
        options.json.write_text(json.dumps(result, indent=1, allow_nan=False, ensure_ascii=False) + "\n")
        say(f"findings: {options.json}")
    return 0 if all(map(is_readable, result["files"])) else 1


def main(arguments: list[str]) -> int:
    """Run, and return the exit code."""
    return run_command("doctor", __doc__, inputs.add_arguments, doctor, arguments)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
