# SPDX-License-Identifier: MIT
"""The words and options of the command, for the terminal and for Blender: one parser, one set of help texts."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

from .building import CONTROLS, build, info
from .core import core
from .doctor import doctor
from .evaluate.command import evaluate
from .playing import play
from .retarget.command import retarget

_EXAMPLES = (
    "build walks/ --policy hero.policy",
    "build walks/ --style tired=*_tired_* --style happy=*_happy_* --policy hero.policy",
    "info hero.policy --json -",
    "play hero.policy --trace path.csv --bvh shot.bvh",
    "play hero.policy --player walker --style tired --bvh shot.bvh",
    "evaluate hero.policy --player runner --seconds 60",
    "evaluate walks/ --quick",
    "doctor walks/ --json findings.json",
    "retarget walks/ --onto hero.bvh --into retargeted/",
    "retarget walks/ --onto hero.glb --into retargeted/",
)
_EPILOG = """Takes are BVH files, AMC files with their ASF beside them, and folders of such, at any depth. Retarget
reads FBX, glTF, VRM and USD files, too, where Blender's module bpy is installed.
A trace is a CSV file: velocity_x,velocity_y (m/s), turn (-1 to 1), jump (0 or 1), 10 rows a second; columns `move` and
`style` after these may name the moves that are held and the style. The exit code is 0 where all was done; else it is 1,
or 2 where the command was not understood, and the cause is told."""


class Parser(NamedTuple):
    """The parser, and what can be added to."""

    parser: argparse.ArgumentParser
    words: argparse._SubParsersAction[argparse.ArgumentParser]
    build: argparse.ArgumentParser
    info: argparse.ArgumentParser
    evaluate: argparse.ArgumentParser
    evaluate_driver: argparse._MutuallyExclusiveGroup
    """What evaluate plays: one of these options, or all players."""
    retarget: argparse.ArgumentParser


def make_parser(program: str, more_examples: Sequence[str] = (), more: str = "") -> Parser:
    """The command line of a program of that name; examples and words to be told of what it can do besides."""
    examples = "\n".join(f"  {program} {example}" for example in (*_EXAMPLES, *more_examples))
    parser = argparse.ArgumentParser(
        prog=program,
        description="Characters that a stick drives, of files of motion capture.",
        epilog=f"examples:\n{examples}\n\n{_EPILOG}{more}",
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    words = parser.add_subparsers(required=True, metavar="COMMAND")
    building = _add_build(words.add_parser("build", help="build a character of takes"))
    playing = words.add_parser("play", help="write what a character does under a trace as a BVH file")
    _add_character(playing)
    add_driver(playing)
    playing.add_argument("--bvh", type=Path, required=True, metavar="FILE", help="where to write the motion")
    playing.add_argument("--style", metavar="NAME", help="in which it begins (the first one)")
    playing.add_argument("--rate", type=float, default=30.0, metavar="HZ", help="frames a second (30)")
    playing.set_defaults(command=play)
    telling = words.add_parser("info", help="tell what a character is")
    _add_character(telling)
    telling.set_defaults(command=info)
    examining = words.add_parser("doctor", help="say what is wrong with motion capture files, and what is safe to mend")
    _add_takes(examining)
    examining.set_defaults(command=doctor)
    measuring = words.add_parser("evaluate", help="measure how well a character follows traces, or how good takes are")
    driver = _add_evaluate(measuring)
    bringing = words.add_parser("retarget", help="bring takes onto another skeleton, and build a character of them")
    _add_retarget(bringing)
    for word in (building, playing, telling, examining, measuring, bringing):
        add_json(word)
    return Parser(parser, words, building, telling, measuring, driver, bringing)


def _add_build(build_: argparse.ArgumentParser) -> argparse.ArgumentParser:
    _add_takes(build_)
    build_.add_argument("--policy", type=Path, metavar="FILE", help="where to write the policy file")
    _add_what_is_built(build_)
    _add_unit(build_)
    build_.add_argument(
        "--style",
        action="append",
        default=[],
        metavar="NAME=PATTERN",
        help="the style of the takes whose name fits, such as tired=*_tired_*; once for each style",
    )
    build_.add_argument(
        "--folder-styles", action="store_true", help="each take is of the style that the folder of its file is called"
    )
    _add_seed(build_)
    build_.set_defaults(command=build)
    return build_


def _add_what_is_built(word: argparse._ActionsContainer) -> None:
    word.add_argument("--classes", type=_classes, metavar="N", help="how many classes (97)")
    word.add_argument("--controls", choices=CONTROLS, help="as in the paper (so it is), as the takes hold, or told by:")
    word.add_argument("--speeds", type=int, choices=(1, 2, 3, 4), help="how many it can be asked for (2)")
    word.add_argument("--directions", type=int, choices=(4, 8, 16), help="how many it can be asked for (8)")
    for what in ("turn", "jump"):
        word.add_argument(
            f"--no-{what}", dest=what, action="store_false", default=None, help=f"it can be asked for no {what}s"
        )


def _add_evaluate(word: argparse.ArgumentParser) -> argparse._MutuallyExclusiveGroup:
    word.add_argument(
        "sources", nargs="+", type=Path, metavar="SOURCE", help="a policy file; or takes, of which a character is built"
    )
    driver = _add_players(word.add_argument_group("of a character"), required=False)
    takes = word.add_argument_group("of takes")
    for name, what in (("train", "learn from"), ("test", "test with")):
        takes.add_argument(
            f"--{name}", nargs="+", type=Path, metavar="CSV", help=f"traces to {what} (the simulated players')"
        )
    _add_what_is_built(takes)
    _add_unit(takes)
    takes.add_argument("--figures", type=Path, metavar="DIR", help="draw pictures there, and save the traces")
    takes.add_argument(
        "--no-curves",
        action="store_true",
        default=None,
        help="leave out quality against classes and minutes, which takes longest",
    )
    takes.add_argument(
        "--quick", action="store_true", default=None, help="only the default policy at run time: takes seconds"
    )
    takes.add_argument("--responsiveness", type=float, metavar="R", help="of the player, 0 to 1 (0.5)")
    _add_seed(word)
    word.set_defaults(command=evaluate)
    return driver


def _add_retarget(word: argparse.ArgumentParser) -> None:
    _add_takes(word)
    word.add_argument("--onto", type=Path, required=True, metavar="FILE", help="a file of the skeleton or rig")
    word.add_argument("--armature", metavar="NAME", help="which armature, where a file has several")
    word.add_argument("--into", type=Path, metavar="FOLDER", help="write the takes there as BVH files")
    _add_unit(word)
    word.add_argument("--onto-unit", type=float, metavar="M", help="in one of the skeleton's (as --unit)")
    word.add_argument(
        "--role",
        action="append",
        default=[],
        metavar="ROLE=BONE",
        help="what a bone is to the body, such as foot.L=LeftAnkle; once for each",
    )
    _add_seed(word)
    word.set_defaults(command=retarget)


def _add_unit(word: argparse._ActionsContainer) -> None:
    word.add_argument(
        "--unit", type=float, metavar="M", help="metres in one unit of a BVH file (the body's size tells)"
    )


def _add_takes(word: argparse.ArgumentParser) -> None:
    word.add_argument("takes", nargs="+", type=Path, metavar="TAKES", help="files of takes, or folders of them")


def _add_character(word: argparse.ArgumentParser) -> None:
    word.add_argument("character", type=Path, metavar="CHARACTER", help="a policy file")


def add_driver(word: argparse.ArgumentParser) -> argparse._MutuallyExclusiveGroup:
    """What plays a character, one of several."""
    driver = _add_players(word, required=True)
    _add_seed(word)
    return driver


def _add_players(word: argparse._ActionsContainer, required: bool) -> argparse._MutuallyExclusiveGroup:
    driver = word.add_mutually_exclusive_group(required=required)
    driver.add_argument("--trace", type=Path, metavar="FILE.csv", help="what a stick did, 10 rows a second")
    driver.add_argument("--player", choices=core.PLAYERS, help="a simulated player")
    word.add_argument("--seconds", type=float, metavar="S", help="how long the simulated player plays (20)")
    return driver


def add_json(word: argparse.ArgumentParser) -> None:
    """Where figures go."""
    word.add_argument("--json", metavar="FILE", help="save the figures there; - prints them")


def _add_seed(word: argparse.ArgumentParser) -> None:
    word.add_argument("--seed", type=_seed, metavar="N", help="draws what is left to chance (1)")


def _seed(text: str) -> int:
    """What is left to chance is drawn from a number of 64 bits."""
    return _number(text, "seed", 0, 2**64 - 1)


def _classes(text: str) -> int:
    return _number(text, "number of classes", 1, core.MOST_CLASSES)


def _number(text: str, what: str, least: int, most: int) -> int:
    if text.isdecimal() and least <= int(text) <= most:
        return int(text)
    raise argparse.ArgumentTypeError(f"'{text}' is no {what}: it must be a whole number from {least} to {most}")
