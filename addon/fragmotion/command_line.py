# SPDX-License-Identifier: GPL-3.0-or-later
"""Build, bake and measure without a window: `blender -c fragmotion` (4.2 and later); before, `run` from
--python-expr."""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import bpy

from .character.building import has_character, load, make_player, save_policy
from .compat.core import core
from .errors import UserError, core_errors
from .mocap.actions import ticked
from .operators.base.context import active_armature
from .recordings.recordings import trace_of

if TYPE_CHECKING:
    from fragmotion_core import Character, Doubles

NAME = "fragmotion"

_EVALUATED_RATE = 60.0  # frames a second

_CONTROLS = {"paper": "PAPER", "found": "FOUND", "told": "TOLD"}

_EXAMPLES = """examples:
  blender -c fragmotion build walks/ --blend hero.blend --policy hero.policy
  blender -c fragmotion build takes.blend --armature Hero --blend hero.blend
  blender -c fragmotion build walks/ --onto rig.blend --armature Hero --blend hero.blend
  blender -c fragmotion build walks/ --style tired=*_tired_* --style happy=*_happy_* --blend hero.blend
  blender -c fragmotion bake hero.blend --trace path.csv --blend shot.blend
  blender -c fragmotion bake hero.blend --player walker --style tired --blend shot.blend
  blender -c fragmotion bake hero.blend --recordings --blend shots.blend
  blender -c fragmotion bake scenes/*.blend --recordings --into shots/
  blender -c fragmotion evaluate hero.blend --player runner --json -
  blender -c fragmotion info hero.blend --json -

Settings that no option names are those of the armature's panels. The exit code is 0 where all was done; else it is 1,
the cause is told."""


def run(arguments: Sequence[str]) -> int:
    """Run one command; the exit code. --help tells what there is."""
    try:
        options = _parser().parse_args(arguments)
    except SystemExit as end:  # Blender would end without its own goodbye
        return int(end.code or 0)
    try:
        figures = options.command(options)
        if options.json:
            _write_json(options.json, figures)
    except (UserError, RuntimeError, OSError) as error:
        print(f"{NAME}: {str(error).removeprefix('Error: ').strip()}", file=sys.stderr)
        return 1
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog=f"blender -c {NAME}", epilog=_EXAMPLES, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    commands = parser.add_subparsers(required=True, metavar="COMMAND")
    build = commands.add_parser("build", help="build a character, from a folder of takes or a .blend's ticked Actions")
    build.add_argument("source", type=Path, metavar="TAKES", help="a folder of takes, or a .blend with Actions")
    build.add_argument("--onto", type=Path, metavar="RIG.blend", help="the file of the character that the takes move")
    build.add_argument("--classes", type=int, metavar="N", help="how many classes")
    build.add_argument("--controls", choices=_CONTROLS, help="as in the paper, as the takes hold, or as told by:")
    build.add_argument("--speeds", type=int, choices=(1, 2, 3, 4), help="how many it can be asked for")
    build.add_argument("--directions", choices=("4", "8", "16"), help="how many it can be asked for")
    build.add_argument(
        "--no-turn", dest="turn", action="store_false", default=None, help="it can be asked for no turns"
    )
    build.add_argument(
        "--no-jump", dest="jump", action="store_false", default=None, help="it can be asked for no jumps"
    )
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
    build.add_argument("--seed", type=int, metavar="N", help="draws the first centres and the simulated players")
    build.add_argument("--policy", type=Path, metavar="FILE", help="where to write the policy file")
    build.set_defaults(command=_build)
    bake = commands.add_parser("bake", help="bake motion of characters to Actions, several files over all processors")
    bake.add_argument("sources", type=Path, nargs="+", metavar="CHARACTER.blend")
    bake.add_argument("--style", metavar="NAME", help="what a trace or a player is played in (the first one)")
    bake.add_argument("--into", type=Path, metavar="FOLDER", help="where to write the .blends, by their names")
    bake.set_defaults(command=_bake)
    evaluate = commands.add_parser("evaluate", help="measure how well a character follows traces")
    evaluate.add_argument("source", type=Path, metavar="CHARACTER.blend")
    evaluate.set_defaults(command=_evaluate)
    for command in (bake, evaluate):
        driver = command.add_mutually_exclusive_group(required=True)
        driver.add_argument("--trace", type=Path, metavar="FILE.csv", help="what a stick did, 10 rows a second")
        driver.add_argument("--player", choices=core.PLAYERS, help="a simulated player")
        driver.add_argument("--recordings", action="store_true", help="every recording of the armature")
        command.add_argument("--seconds", type=float, metavar="S", help="how long the simulated player plays (20)")
        command.add_argument("--seed", type=int, metavar="N", help="draws what is left to chance")
    info = commands.add_parser("info", help="tell what a character is")
    info.add_argument("source", type=Path, metavar="CHARACTER.blend")
    info.set_defaults(command=_info)
    for command in (build, bake):
        command.add_argument("--blend", type=Path, metavar="FILE", help="where to write the .blend")
    for command in (build, bake, evaluate, info):
        command.add_argument("--armature", metavar="NAME", help="which armature, where the file has several")
        command.add_argument("--json", metavar="FILE", help="save the figures there too; - is the terminal")
    return parser


def _build(options: argparse.Namespace) -> dict[str, Any]:
    if not (options.blend or options.policy):
        raise UserError("Nothing would be kept: say where to, by --blend or --policy")
    if options.source.is_dir():
        _import(options)
    elif options.folder_styles:
        raise UserError(f"--folder-styles asks for a folder of takes, and '{options.source}' is none")
    else:
        _open(options.source, options.armature)
    _set_styles(options.style)
    bpy.ops.fragmotion.build("EXEC_DEFAULT", **_given(options, "classes", "seed"), **_controls(options))
    obj = active_armature(bpy.context)
    figures = _figures(obj)
    if options.policy:
        save_policy(obj, options.policy.resolve())
    _save(options.blend)
    return figures


def _controls(options: argparse.Namespace) -> dict[str, Any]:
    """The fields of a build that say which controls."""
    told = _given(options, "speeds", "directions", "turn", "jump")
    if options.controls not in (None, "told") and told:
        raise UserError(f"--controls {options.controls} and --{min(told)} say two different things: leave one out")
    kind = "told" if told else options.controls
    return {"controls": _CONTROLS[kind], **told} if kind else {}


def _set_styles(told: Sequence[str]) -> None:
    """Let takes be of the styles that --style tells."""
    for text in told:
        name, _, pattern = text.partition("=")
        if not (name and pattern):
            raise UserError(f"--style {text} tells no name or no pattern, as in tired=*_tired_*")
        bpy.ops.fragmotion.set_style("EXEC_DEFAULT", style=name, pattern=pattern)


def _import(options: argparse.Namespace) -> None:
    """The folder's takes onto the rig, or onto an armature of their own."""
    if options.onto:
        _open(options.onto, options.armature)
    else:
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.fragmotion.import_mocap(
        directory=str(options.source.resolve()),
        onto="ACTIVE" if options.onto else "NEW",
        style="FOLDER" if options.folder_styles else "NONE",
    )


def _bake(options: argparse.Namespace) -> dict[str, Any]:
    if bool(options.blend) == bool(options.into) or (options.blend and len(options.sources) > 1):
        raise UserError("Nothing would be kept: say where to, by --blend for one file or by --into for several")
    if options.blend:
        return {"baked": _bake_one(options, options.sources[0], options.blend)}
    _check_names(options)
    options.into.mkdir(parents=True, exist_ok=True)
    return {"baked": _bake_each(options) if bpy.app.binary_path else _bake_in_turn(options)}


def _check_names(options: argparse.Namespace) -> None:
    names = [source.name for source in options.sources]
    for source in options.sources:
        if names.count(source.name) > 1:
            raise UserError(f"Several files are called '{source.name}', and one would replace the other")
        if (options.into / source.name).resolve() == source.resolve():
            raise UserError(f"'{source}' would be written over: choose another folder")


def _bake_in_turn(options: argparse.Namespace) -> list[dict[str, Any]]:
    rows = [_bake_one(options, source, options.into / source.name) for source in options.sources]
    return [row for each in rows for row in each]


def _bake_each(options: argparse.Namespace) -> list[dict[str, Any]]:
    """A Blender for each file, as many at a time as there are processors. UserError names the files that failed."""
    rows: list[dict[str, Any]] = []
    failures: list[str] = []
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        ends = pool.map(lambda source: _bake_apart(options, source), options.sources)
        for number, (source, (baked, message)) in enumerate(zip(options.sources, ends), 1):
            print(f"{number} of {len(options.sources)} files: {source.name}", flush=True)
            rows += baked
            failures += [f"{source.name}: {message}"] * bool(message)
    if failures:
        raise UserError("; ".join(failures))
    return rows


def _bake_apart(options: argparse.Namespace, source: Path) -> tuple[list[dict[str, Any]], str]:
    """Bake in a Blender of its own: the rows, or what it says went wrong."""
    with TemporaryDirectory() as folder:
        figures = Path(folder) / "figures.json"
        words = ["bake", str(source.resolve()), "--blend", str((options.into / source.name).resolve())]
        words += [
            f"--{name}={value}" for name, value in _given(options, "seconds", "seed", "style", "armature").items()
        ]
        driver = _given(options, "player") | ({"trace": options.trace.resolve()} if options.trace else {})
        words += [f"--{name}={value}" for name, value in driver.items()] or ["--recordings"]
        code = f"import sys, {__name__} as c; sys.exit(c.run({[*words, '--json', str(figures)]!r}))"
        command = [bpy.app.binary_path, "--background", "--addons", __package__, "--python-expr", code]
        ended = subprocess.run(command, capture_output=True, text=True, check=False)
        if figures.exists():
            baked: list[dict[str, Any]] = json.loads(figures.read_text(encoding="utf-8"))["baked"]
            return baked, ""
        return [], (ended.stderr.strip().splitlines() or ["Blender ended without a word"])[-1]


def _bake_one(options: argparse.Namespace, path: Path, target: Path) -> list[dict[str, Any]]:
    obj = _open(path, options.armature)
    given = _given(options, "seconds", "seed", "style")
    sources: list[dict[str, Any]]
    if options.trace:
        sources = [{"trace_source": "FILE", "trace_file": str(options.trace.resolve())}]
    elif options.player:
        sources = [{"trace_source": "PLAYER", "player": options.player}]
    else:
        sources = [{"trace_source": "RECORDING", "recording": index} for index in range(len(obj.fragmotion.recordings))]
    if not sources:
        raise UserError(f"Armature '{obj.name}' has no recordings")
    baked = []
    for number, source in enumerate(sources, 1):
        before = set(bpy.data.actions)
        bpy.ops.fragmotion.bake("EXEC_DEFAULT", target="NEW", **source, **given)
        (action,) = set(bpy.data.actions) - before
        action.use_fake_user = True
        first, last = action.frame_range
        baked.append({"blend": str(target), "action": action.name, "first": first, "last": last})
        print(f"{number} of {len(sources)}: Action '{action.name}', frames {first:.0f} to {last:.0f}", flush=True)
    _save(target)
    return baked


def _evaluate(options: argparse.Namespace) -> dict[str, Any]:
    obj = _open(options.source, options.armature)
    if not has_character(obj):
        raise UserError(f"Armature '{obj.name}' has no character yet")
    character, rows = load(obj), []
    for name, trace in _traces(options, obj, character).items():
        performance = make_player(obj, character, options.seed or 1, "").run(trace, _EVALUATED_RATE)
        row = {
            "percent_of_optimal": character.percent_of_optimal(trace),
            "quality": performance.quality,
            "velocity_error": performance.velocity_error,
            "commanded_speed": performance.commanded_speed,
            "turn_error": performance.turn_error,
        }
        print(f"{name}: {', '.join(f'{key} {value:.3g}' for key, value in row.items())}", flush=True)
        rows.append({"trace": name, **row})
    return {"traces": rows}


def _traces(options: argparse.Namespace, obj: bpy.types.Object, character: Character) -> dict[str, Doubles]:
    """The traces that are asked for, by what they are called."""
    with core_errors():
        if options.trace:
            return {options.trace.stem: core.read_trace(options.trace)}
        if options.player:
            seconds = 20.0 if options.seconds is None else options.seconds
            return {options.player: core.simulate_trace(options.player, seconds, options.seed or 1, character.space)}
    if not obj.fragmotion.recordings:
        raise UserError(f"Armature '{obj.name}' has no recordings")
    return {recording.name: trace_of(recording) for recording in obj.fragmotion.recordings}


def _info(options: argparse.Namespace) -> dict[str, Any]:
    obj = _open(options.source, options.armature)
    if not has_character(obj):
        raise UserError(f"Armature '{obj.name}' has no character yet")
    return _figures(obj)


def _open(path: Path, name: str | None) -> bpy.types.Object:
    """Open a .blend, and make the armature active: the one of that name, the active one, or the only one."""
    bpy.ops.wm.open_mainfile(filepath=str(path.resolve()))
    armatures = [obj for obj in bpy.context.view_layer.objects if obj.type == "ARMATURE"]
    active = active_armature(bpy.context)
    if name:
        armatures = [obj for obj in armatures if obj.name == name]
    elif active is not None:
        armatures = [active]
    if len(armatures) != 1:
        wanted = f"armature '{name}'" if name else "armature" if not armatures else "active armature: use --armature"
        raise UserError(f"'{path}' has no {wanted}")
    bpy.context.view_layer.objects.active = armatures[0]
    return armatures[0]


def _given(options: argparse.Namespace, *names: str) -> dict[str, Any]:
    return {name: value for name in names if (value := getattr(options, name)) is not None}


def _figures(obj: bpy.types.Object) -> dict[str, Any]:
    """What the last build found, said and returned."""
    figures = obj.fragmotion.figures
    found = {
        "armature": obj.name,
        "takes": len(ticked(obj)),
        "fragments": figures.fragments,
        "classes": figures.classes,
        "percent_of_optimal": figures.quality,
        "controls_performed": figures.performed,
        "controls": figures.controls,
        **({"styles": [style.name for style in figures.styles]} if figures.styles else {}),
        "recordings": len(obj.fragmotion.recordings),
    }
    print(", ".join(f"{name.replace('_', ' ')} {_shown(value)}" for name, value in found.items()), flush=True)
    return found


def _shown(value: object) -> str:
    if isinstance(value, list):
        return " ".join(value)
    return f"{value:.1f}" if isinstance(value, float) else str(value)


def _save(path: Path | None) -> None:
    if path:
        bpy.ops.wm.save_as_mainfile(filepath=str(path.resolve()), check_existing=False)


def _write_json(path: str, figures: dict[str, Any]) -> None:
    text = json.dumps(figures, indent=1) + "\n"
    if path == "-":
        print(text, end="")
    else:
        Path(path).write_text(text, encoding="utf-8")


_handle: Any = None


def register() -> None:
    """Add the command, where Blender has such."""
    global _handle
    if hasattr(bpy.utils, "register_cli_command"):
        _handle = bpy.utils.register_cli_command(NAME, run)


def unregister() -> None:
    """Remove the command."""
    global _handle
    if _handle is not None:
        bpy.utils.unregister_cli_command(_handle)
        _handle = None
