# SPDX-License-Identifier: MIT
"""The command `fragmotion` of the core's wheel: characters from files of motion capture, without Blender."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from fnmatch import fnmatchcase
from pathlib import Path
from typing import Any

import fragmotion_core as core

_NEUTRAL = "neutral"  # the style of takes that tell none, where others do

_EXAMPLES = """examples:
  fragmotion build walks/ --policy hero.policy
  fragmotion build walks/ --style tired=*_tired_* --style happy=*_happy_* --policy hero.policy
  fragmotion info hero.policy --json -
  fragmotion play hero.policy --trace path.csv --bvh shot.bvh
  fragmotion play hero.policy --player walker --style tired --bvh shot.bvh
  fragmotion evaluate hero.policy --player runner --seconds 60

Takes are BVH files, AMC files with their ASF beside them, and folders of such, all of one skeleton. A trace is a
CSV file: velocity_x,velocity_y (m/s), turn (-1 to 1), jump (0 or 1), 10 rows a second; columns `move` and `style`
after these may name the moves that are held and the style. The exit code is 0 where all was done; else it is 1, and the
cause is told."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command, by default that of the process; the exit code."""
    options = _parser().parse_args(arguments)
    try:
        figures = options.command(options)
        if options.json == "-":
            print(json.dumps(figures, indent=1))
            return 0
        print(", ".join(f"{name.replace('_', ' ')} {_shown(value)}" for name, value in figures.items()))
        if options.json:
            Path(options.json).write_text(json.dumps(figures, indent=1) + "\n", encoding="utf-8")
    except (ValueError, OSError) as error:
        print(f"fragmotion: {error}", file=sys.stderr)
        return 1
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="fragmotion", epilog=_EXAMPLES, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    build = commands.add_parser("build", help="build a character of takes")
    build.add_argument("takes", nargs="+", type=Path, metavar="TAKES")
    build.add_argument("--policy", type=Path, required=True, metavar="FILE", help="where to write the policy file")
    build.add_argument("--classes", type=_classes, metavar="N", help="how many classes")
    build.add_argument("--speeds", type=int, choices=(1, 2, 3, 4), default=2, help="that it can be asked for (2)")
    build.add_argument("--directions", type=int, choices=(4, 8, 16), default=8, help="that it can be asked for (8)")
    build.add_argument("--no-turn", action="store_true", help="it can be asked for no turns")
    build.add_argument("--no-jump", action="store_true", help="it can be asked for no jumps")
    build.add_argument("--find-controls", action="store_true", help="as many of all these as the takes hold")
    build.add_argument(
        "--style",
        action="append",
        default=[],
        metavar="NAME=PATTERN",
        help="the style of the takes whose name fits, such as tired=*_tired_*; once for each style",
    )
    build.add_argument(
        "--folder-styles", action="store_true", help="each take is of the style that the folder of its file is called"
    )
    build.add_argument("--unit", type=float, default=0.01, metavar="M", help="metres in one unit of a BVH file (0.01)")
    build.set_defaults(command=_build)
    info = commands.add_parser("info", help="tell what a policy file holds")
    info.set_defaults(command=_info)
    play = commands.add_parser("play", help="write what a character does under a trace as a BVH file")
    play.add_argument("--bvh", type=Path, required=True, metavar="FILE", help="where to write the motion")
    play.add_argument("--style", metavar="NAME", help="in which it begins (the first one)")
    play.add_argument("--rate", type=float, default=30.0, metavar="HZ", help="frames a second (30)")
    play.set_defaults(command=_play)
    evaluate = commands.add_parser("evaluate", help="measure a character under a trace")
    evaluate.set_defaults(command=_evaluate)
    for command in (info, play, evaluate):
        command.add_argument("character", type=Path, metavar="FILE.policy")
    for command in (play, evaluate):
        driver = command.add_mutually_exclusive_group(required=True)
        driver.add_argument("--trace", type=Path, metavar="FILE.csv", help="what a stick did")
        driver.add_argument("--player", choices=core.PLAYERS, help="a simulated player")
        command.add_argument("--seconds", type=float, default=20.0, metavar="S", help="how long that one plays (20)")
    for command in (build, play, evaluate):
        command.add_argument("--seed", type=_seed, default=1, metavar="N", help="draws what is left to chance (1)")
    for command in (build, info, play, evaluate):
        command.add_argument("--json", metavar="FILE", help="save the figures there; - prints them")
    return parser


def _seed(text: str) -> int:
    """What is left to chance is drawn from a number of 64 bits."""
    return _number(text, "seed", 0, 2**64 - 1)


def _classes(text: str) -> int:
    return _number(text, "number of classes", 1, core.MOST_CLASSES)


def _number(text: str, what: str, least: int, most: int) -> int:
    if text.isdecimal() and least <= int(text) <= most:
        return int(text)
    raise argparse.ArgumentTypeError(f"'{text}' is no {what}: it must be a whole number from {least} to {most}")


def _build(options: argparse.Namespace) -> dict[str, Any]:
    paths = _files(options.takes)
    styles = _styles_of(paths, options)
    takes = [core.read_bvh(path, options.unit) if _is_bvh(path) else _read_amc(path) for path in paths]
    skeleton = takes[0].skeleton
    clips = [core.Clip.from_take(take, skeleton) for take in takes]
    settings = core.BuildOptions()
    settings.seed = options.seed
    settings.find_controls = options.find_controls
    settings.speeds, settings.directions = options.speeds, options.directions
    settings.turn, settings.jump = not options.no_turn, not options.no_jump
    if options.classes is not None:
        settings.classes = options.classes
    teacher = core.simulate_trace("explorer", 60, options.seed, settings.usual_space)
    if any(styles):
        named = {name: [clip for clip, own in zip(clips, styles) if own == name] for name in sorted(set(styles))}
        styled = [(name or _NEUTRAL, some) for name, some in named.items()]
        character = core.build_styles(skeleton, styled, [teacher], settings)
    else:
        character = core.build(skeleton, clips, [teacher], settings)
    character.save(options.policy)
    return _described(character)


def _styles_of(paths: Sequence[Path], options: argparse.Namespace) -> list[str]:
    """The style of each take, empty where it is of none: the last that fits of those that are told, else its folder's
    where that is to tell it."""
    styles = [path.parent.name if options.folder_styles else "" for path in paths]
    for text in options.style:
        name, _, pattern = text.partition("=")
        fitting = [i for i, path in enumerate(paths) if fnmatchcase(path.stem.lower(), pattern.lower())]
        if not (name and pattern):
            raise ValueError(f"--style {text} tells no name or no pattern, as in tired=*_tired_*")
        if not fitting:
            raise ValueError(f"--style {text}: no take's name fits; the first is called '{paths[0].stem}'")
        for i in fitting:
            styles[i] = name
    return ["" if style == _NEUTRAL else style for style in styles]


def _files(given: Sequence[Path]) -> list[Path]:
    """The files of takes, those of a folder by name; ValueError where there are none."""
    found: list[Path] = []
    for path in given:
        inside = sorted(path.rglob("*")) if path.is_dir() else [path]
        found += [each for each in inside if each.suffix.lower() in {".bvh", ".amc"} and not each.name.startswith(".")]
    if not found:
        raise ValueError(f"{', '.join(map(str, given))}: no takes here (.bvh, or .amc with its .asf)")
    return found


def _is_bvh(path: Path) -> bool:
    return path.suffix.lower() == ".bvh"


def _read_amc(path: Path) -> core.Take:
    """A take on the skeleton that lies beside it."""
    return core.read_asf_amc(core.find_asf(path), path)


def _info(options: argparse.Namespace) -> dict[str, Any]:
    return _described(core.Character.load(options.character))


def _described(character: core.Character) -> dict[str, Any]:
    return {
        "bones": len(character.skeleton.names),
        "fragments": len(character.fragment_durations),
        "classes": len(character.class_names),
        "policies": character.policies,
        **({"styles": character.style_names} if character.style_names else {}),
        **({"moves": character.move_names} if character.move_names else {}),
        **dict(zip(character.space.gaits, character.space.speeds)),
        "directions": character.space.directions,
        "controls": len(character.space.points),
        **({"unanswered": character.unanswered} if character.unanswered else {}),
    }


def _play(options: argparse.Namespace) -> dict[str, Any]:
    character = core.Character.load(options.character)
    player = core.Player(character, options.seed)
    begin, moves, styles = _asked(options, character)
    player.reset(style=begin)
    trace = _trace(options, character.in_style(begin))
    performance = player.run(trace, options.rate, moves=moves or None, styles=styles or None)
    clip = core.Clip(
        character.skeleton, options.bvh.stem, performance.rate, performance.root_positions, performance.rotations
    )
    core.write_bvh(core.Take.from_clip(clip, character.skeleton), options.bvh)
    return {"frames": len(performance.path), "rate": performance.rate}


def _asked(
    options: argparse.Namespace, character: core.Character
) -> tuple[int, list[tuple[int, int, int]], list[tuple[int, int]]]:
    """The style in which it begins, and the moves and the changes of style of the trace file, by their numbers."""
    moves, styles = core.read_asked(options.trace) if options.trace else ([], [])
    names = {"move": character.move_names, "style": character.style_names}
    changes = [(control, _number_of("style", name, names)) for control, name in styles]
    chosen = _number_of("style", options.style, names) if options.style else 0
    begin = changes[0][1] if changes and changes[0][0] == 0 else chosen
    return begin, [(control, _number_of("move", name, names), held) for control, name, held in moves], changes


def _number_of(what: str, name: str, names: dict[str, list[str]]) -> int:
    """The number of a move or a style; ValueError where the character does not have it."""
    known = names[what]
    if name not in known:
        raise ValueError(f"the character has no {what} '{name}': its {what}s are {', '.join(known) or 'none'}")
    return known.index(name)


def _evaluate(options: argparse.Namespace) -> dict[str, Any]:
    character = core.Character.load(options.character)
    trace = _trace(options, character)
    performance = core.Player(character, options.seed).run(trace, 60.0)
    return {
        "percent_of_optimal": character.percent_of_optimal(trace),
        "quality": performance.quality,
        "velocity_error": performance.velocity_error,
        "turn_error": performance.turn_error,
        "commanded_speed": performance.commanded_speed,
    }


def _trace(options: argparse.Namespace, character: core.Character) -> core.Doubles:
    if options.trace:
        return core.read_trace(options.trace)
    return core.simulate_trace(options.player, options.seconds, options.seed, character.space)


def _shown(value: object) -> str:
    if isinstance(value, list):
        return " ".join(map(str, value))
    return f"{value:.3g}" if isinstance(value, float) else str(value)


if __name__ == "__main__":
    sys.exit(main())
