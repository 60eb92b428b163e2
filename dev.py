#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The one command of Fragmotion's developers: sets the machine up, builds, tests, packages and shows the add-on."""

from __future__ import annotations

import argparse
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

from tools import demo
from tools.docs import pages
from tools.docs.in_window import running as windows
from tools.games import godot, web
from tools.measuring import running
from tools.measuring.bench.running import run_benchmarks
from tools.measuring.beside import inputs as beside_inputs
from tools.measuring.directing import inputs as directing_inputs
from tools.measuring.tuning import inputs as tuning_inputs
from tools.platforms import PLATFORMS
from tools.setup import machine, maven, unstable
from tools.shell import Failure
from tools.testing import engines, fuzzing, stages, testing

_STAGES_HELP = (
    f"only these, whole, of {', '.join(testing.STAGES)}; or `{testing.WHOLE}` of them; or `{testing.REST}`: "
    "what CI runs besides what runs when none is named"
)


def parse_arguments(arguments: list[str]) -> argparse.Namespace:
    """Read the command line; `--help` tells what there is."""
    parser = argparse.ArgumentParser(prog="dev.py", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)
    commands.add_parser("demo", help="from motion capture to a baked, controlled Action in Debian's Blender")
    test = commands.add_parser(
        "test", help="style, C++, Python, and whether the add-on runs in Debian's Blender, but for the slowest tests"
    )
    test.add_argument("stages", nargs="*", metavar="STAGE", help=_STAGES_HELP)
    test.add_argument("-k", dest="expression", metavar="EXPR", help="only the tests that match, as pytest's -k")
    fuzz = commands.add_parser("fuzz", help="feed the file readers with inputs made at random, and watch for crashes")
    fuzz.add_argument("--seconds", type=float, default=60.0, metavar="N", help="how long, all fuzzers together (60)")
    fuzz.add_argument("names", nargs="*", metavar="FUZZER", help=f"only these of {', '.join(fuzzing.names())}")
    bench = commands.add_parser("bench", help="measure the core against NumPy and scikit-learn, each goal met or not")
    bench.add_argument(
        "--takes", type=Path, nargs="+", default=[], metavar="MOCAP", help="of the large character (the sample's)"
    )
    bench.add_argument(
        "--peers", type=Path, metavar="DIR", help="compare with ozz-animation, in this folder or fetched into it by git"
    )
    bench.add_argument("--json", type=Path, metavar="FILE", help="save the figures there too")
    beside = commands.add_parser("beside", help="measure Fragmotion beside motion matching, on the same takes")
    beside_inputs.add_arguments(beside)
    directing = commands.add_parser(
        "directing", help="measure how a character follows paths and pins, and stands on ground"
    )
    directing_inputs.add_arguments(directing)
    tune = commands.add_parser("tune", help="fit the run time's constants to sets of takes")
    tuning_inputs.add_arguments(tune)
    docs = commands.add_parser("docs", help="make the pictures and tables of README.md and docs")
    pages.add_arguments(docs)
    unstable_parser = commands.add_parser(
        "unstable",
        help="set up Debian unstable for `test engines` and `docs`, gigabytes; or run a command in it",
    )
    unstable_parser.add_argument("words", nargs=argparse.REMAINDER, metavar="COMMAND", help="what to run")
    live = commands.add_parser("web", help="make the live page: a folder of static files for any web server")
    live.add_argument("folder", type=Path, metavar="OUT", help="the folder: new, empty, or such a page")
    engine = commands.add_parser("godot", help="make the add-on for Godot with what it takes on every platform")
    engine.add_argument("folder", type=Path, metavar="OUT", help="where the folder fragmotion is to be")
    package = commands.add_parser("package", help="build the zips that Blender installs, into build/packages")
    package.add_argument(
        "--platform",
        metavar="NAME",
        action="append",
        choices=[platform.name for platform in PLATFORMS],
        help=f"only for this of {', '.join(platform.name for platform in PLATFORMS)}; can be given again",
    )
    package.add_argument(
        "--python",
        metavar="VERSION",
        choices=list(maven.VERSIONS),
        help="with a core for this Python in the extension, too: 3.14 for Debian's own Blender 5.2",
    )
    return parser.parse_args(arguments)


def package(names: list[str] | None, python: str | None) -> int:
    """Build the zips of the named platforms or of all, say where they are, and look into them."""
    more = (python,) if python else ()
    chosen = [platform for platform in PLATFORMS if not names or platform.name in names]
    platforms = tuple(replace(platform, more_pythons=more) for platform in chosen)
    machine.set_up(machine.package_needs(platforms))
    return 1 if stages.packages_of(platforms).failed else 0


def run_in_unstable(words: list[str]) -> int:
    """Set Debian unstable up for the engines and the pictures, or run a command in it, from this folder."""
    if words:
        return subprocess.run(unstable.command(words), check=False).returncode
    unstable.set_up(sorted({*engines.packages(), *windows.PACKAGES}))
    return 0


def main(arguments: list[str]) -> int:
    """Run one command and return its exit code."""
    options = parse_arguments(arguments)
    try:
        if options.command == "demo":
            return demo.run_demo()
        if options.command == "test":
            return testing.run_tests(options.stages, options.expression)
        if options.command == "fuzz":
            machine.set_up(machine.FUZZ)
            return 1 if fuzzing.fuzz_for(options.seconds, options.names or fuzzing.names()).findings else 0
        if options.command == "bench":
            return run_benchmarks(options.takes, options.peers, options.json)
        if options.command == "unstable":
            return run_in_unstable(options.words)
        if options.command == "web":
            machine.set_up(machine.DEMO)
            web.make(options.folder)
            return 0
        if options.command == "godot":
            machine.set_up(machine.SAME_BITS)
            godot.make(options.folder)
            return 0
        if options.command == "docs":
            return pages.make_docs(options)
        if options.command in running.COMMANDS:
            return running.COMMANDS[options.command](options, arguments[1:])
        return package(options.platform, options.python)
    except (Failure, ValueError) as failure:
        print(f"dev.py: {failure}", file=sys.stderr)
        return 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
