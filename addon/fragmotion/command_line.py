# SPDX-License-Identifier: GPL-3.0-or-later
"""Build, bake and measure without a window: `blender -c fragmotion` (4.2 and later); before, `run` from
--python-expr. It is the core's command `fragmotion`, and does more where Blender is asked for."""

from __future__ import annotations

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

from .character.building import gather, has_character, load, make_player, save_policy
from .compat.core import command
from .errors import UserError, core_errors
from .mocap.actions import ticked
from .mocap.importing import METRES
from .mocap.sampling import rig_with_feet
from .mocap.take_files import BY_BLENDER, find_takes
from .mocap.target_rigs import open_rig, save_minute
from .operators.base.context import active_armature
from .recordings.recordings import Recording, trace_of
from .rig.skins import make_skin

if TYPE_CHECKING:
    import argparse

    from fragmotion_command import building, parser, playing, running
    from fragmotion_command.evaluate import command as evaluating
    from fragmotion_command.evaluate import inputs as evaluate_inputs
    from fragmotion_command.evaluate import loading
    from fragmotion_command.retarget import command as retargeting
    from fragmotion_command.retarget import inputs as retarget_inputs
    from fragmotion_command.retarget import roles, sources
    from fragmotion_core import Character, Doubles
else:
    building, parser, playing, running = map(command, ("building", "parser", "playing", "running"))
    evaluating, evaluate_inputs, loading = (command(f"evaluate.{name}") for name in ("command", "inputs", "loading"))
    retargeting, retarget_inputs, roles, sources = (
        command(f"retarget.{name}") for name in ("command", "inputs", "roles", "sources")
    )

NAME = "fragmotion"
_BLEND = ".blend"

_CONTROLS = {"paper": "PAPER", "found": "FOUND", "told": "TOLD"}

_EXAMPLES = (
    "build walks/ --blend hero.blend --policy hero.policy",
    "build takes.blend --armature Hero --blend hero.blend",
    "build walks/ --onto rig.blend --armature Hero --blend hero.blend",
    "bake hero.blend --trace path.csv --blend shot.blend",
    "bake hero.blend --player walker --style tired --blend shot.blend",
    "bake hero.blend --recordings --blend shots.blend",
    "bake scenes/*.blend --recordings --into shots/",
    "evaluate hero.blend --player runner --json -",
    "info hero.blend --json -",
    "retarget walks/ --onto rig.glb --blend hero.blend",
)
_MORE = """

In Blender, takes may also be one .blend with ticked Actions or one folder of files that Blender imports, what takes are
brought onto a rig in a file that Blender reads, and a character a .blend that holds one; where it holds none, evaluate
measures what its ticked Actions make. Settings that no option names are then those of the armature's panels."""


def run(arguments: Sequence[str]) -> int:
    """Run one command; the exit code. --help tells what there is."""
    try:
        return running.run(_parser(), arguments)
    except SystemExit as end:  # Blender would end without its own goodbye
        return int(end.code or 0)
    except (UserError, RuntimeError) as error:
        print(f"{NAME}: {str(error).removeprefix('Error: ').strip()}", file=sys.stderr)
        return 1


def _parser() -> argparse.ArgumentParser:
    """The core's command, with what Blender adds to it."""
    made = parser.make_parser(f"blender -c {NAME}", _EXAMPLES, _MORE)
    made.build.add_argument("--onto", type=Path, metavar="RIG.blend", help="the file of what the takes move")
    made.build.set_defaults(command=_build)
    made.info.set_defaults(command=_info)
    made.evaluate.set_defaults(command=_evaluate)
    made.retarget.set_defaults(command=_retarget)
    bake = made.words.add_parser("bake", help="bake motion of characters to Actions, several files over all processors")
    bake.add_argument("sources", type=Path, nargs="+", metavar="CHARACTER.blend")
    bake.add_argument("--style", metavar="NAME", help="what a trace or a player is played in (the first one)")
    bake.add_argument("--into", type=Path, metavar="FOLDER", help="where to write the .blends, by their names")
    bake.set_defaults(command=_bake)
    for driver in (made.evaluate_driver, parser.add_driver(bake)):
        driver.add_argument("--recordings", action="store_true", help="every recording of the armature")
        driver.add_argument("--recording", metavar="NAME", help="one of them")
    parser.add_json(bake)
    for word in (made.build, bake, made.retarget):
        word.add_argument("--blend", type=Path, metavar="FILE", help="where to write the .blend")
    for word in (made.build, bake, made.evaluate, made.info):
        word.add_argument("--armature", metavar="NAME", help="which armature, where a file has several")
    return made.parser


def _build(options: argparse.Namespace) -> running.Done:
    if not (options.blend or options.policy):
        raise UserError("Nothing would be kept: say where to, by --blend or --policy")
    if not _needs_blender(options):
        return building.build(options)
    if len(options.takes) > 1:
        raise UserError("Blender builds of one folder of takes or of one .blend: name one of them")
    _check_numbers(options, "build", "classes", "seed")
    (source,) = options.takes
    if source.is_dir():
        _import(source, options)
    elif options.folder_styles:
        raise UserError(f"--folder-styles asks for a folder of takes, and '{source}' is none")
    else:
        _open(source, options.armature)
    for text in options.style:
        name, pattern = building.style_of(text)
        bpy.ops.fragmotion.set_style("EXEC_DEFAULT", style=name, pattern=pattern)
    bpy.ops.fragmotion.build("EXEC_DEFAULT", **_given(options, "classes", "seed"), **_controls(options))
    obj = active_armature(bpy.context)
    if options.policy:
        save_policy(obj, options.policy.resolve())
    _save(options.blend)
    return _described(obj)


def _check_numbers(options: argparse.Namespace, operator: str, *names: str) -> None:
    """UserError where a number is out of the bounds of an operator's field."""
    fields = getattr(bpy.ops.fragmotion, operator).get_rna_type().properties
    for name, value in _given(options, *names).items():
        least, most = fields[name].hard_min, fields[name].hard_max
        if not least <= value <= most:
            raise UserError(f"--{name} is {value}, and must be from {round(least, 6)} to {round(most, 6)}")


def _needs_blender(options: argparse.Namespace) -> bool:
    """Whether a build asks for what the core's command cannot do: a .blend, or takes that Blender alone reads."""
    if options.blend or options.onto or options.armature:
        return True
    inside = [take.path for path in options.takes if path.is_dir() for take in find_takes(path)]
    return any(path.suffix.lower() in (_BLEND, *BY_BLENDER) for path in (*inside, *options.takes))


def _controls(options: argparse.Namespace) -> dict[str, Any]:
    """The fields of a build that say which controls."""
    kind = building.controls_of(options)
    told = _given(options, "speeds", "turn", "jump")
    directions = {} if options.directions is None else {"directions": str(options.directions)}
    return {"controls": _CONTROLS[kind], **told, **directions} if kind else {}


def _import(folder: Path, options: argparse.Namespace) -> None:
    """The folder's takes onto the rig, or onto an armature of their own."""
    units = {metres: name for name, metres in METRES.items()}
    if options.unit is not None and options.unit not in units:
        raise UserError(f"--unit {options.unit:g}: for Blender it is one of {', '.join(f'{unit:g}' for unit in units)}")
    if options.onto:
        _open(options.onto, options.armature)
    else:
        bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    bpy.ops.fragmotion.import_mocap(
        directory=str(folder.resolve()),
        onto="ACTIVE" if options.onto else "NEW",
        style="FOLDER" if options.folder_styles else "NONE",
        unit=units.get(options.unit, "AUTO"),
    )


def _bake(options: argparse.Namespace) -> running.Done:
    if bool(options.blend) == bool(options.into) or (options.blend and len(options.sources) > 1):
        raise UserError("Nothing would be kept: say where to, by --blend for one file or by --into for several")
    _check_numbers(options, "bake", "seed", "seconds")
    if options.blend:
        return _baked(_bake_one(options, options.sources[0], options.blend))
    _check_names(options)
    options.into.mkdir(parents=True, exist_ok=True)
    return _baked(_bake_each(options) if bpy.app.binary_path else _bake_in_turn(options))


def _baked(rows: list[dict[str, Any]]) -> running.Done:
    return running.Done({"baked": rows}, f"{len(rows)} baked")


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
        driver = _given(options, "player", "recording") | ({"trace": options.trace.resolve()} if options.trace else {})
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
    played: list[dict[str, Any]]
    if options.trace:
        played = [{"trace_source": "FILE", "trace_file": str(options.trace.resolve())}]
    elif options.player:
        played = [{"trace_source": "PLAYER", "player": options.player}]
    else:
        played = [
            {"trace_source": "RECORDING", "recording": obj.fragmotion.recordings.find(recording.name)}
            for recording in _recordings(obj, options.recording)
        ]
    baked = []
    for number, source in enumerate(played, 1):
        before = set(bpy.data.actions)
        bpy.ops.fragmotion.bake("EXEC_DEFAULT", target="NEW", **source, **given)
        (action,) = set(bpy.data.actions) - before
        action.use_fake_user = True
        first, last = action.frame_range
        baked.append({"blend": str(target), "action": action.name, "first": first, "last": last})
        print(f"{number} of {len(played)}: Action '{action.name}', frames {first:.0f} to {last:.0f}", flush=True)
    _save(target)
    return baked


def _evaluate(options: argparse.Namespace) -> running.Done:
    source = options.sources[0]
    if len(options.sources) > 1 or not _is_blend(source, options):
        if options.recordings or options.recording:
            raise UserError(f"--recordings are an armature's, and '{source}' is no .blend")
        return evaluating.evaluate(options)
    obj = _open(source, options.armature)
    if not has_character(obj):
        return _evaluate_takes(options, obj)
    evaluate_inputs.check_kind(options, is_character=True)
    character, seed = load(obj), 1 if options.seed is None else options.seed
    traces = _traces(options, obj, character)
    return playing.measured(
        character, {name: (trace, make_player(obj, character, seed, "")) for name, trace in traces.items()}
    )


def _evaluate_takes(options: argparse.Namespace, obj: bpy.types.Object) -> running.Done:
    """Measure what is built of the armature's ticked Actions, those of its first style."""
    evaluate_inputs.check_kind(options, is_character=False)
    evaluate_inputs.check(options)
    material = gather(bpy.context, obj, obj.fragmotion.build)
    return evaluating.evaluate_takes(options, loading.Recordings(material.rig.skeleton, material.clips))


def _traces(options: argparse.Namespace, obj: bpy.types.Object, character: Character) -> dict[str, Doubles]:
    """The traces that are asked for, by what they are called."""
    if not (options.recordings or options.recording):
        return playing.traces_of(options, character)
    return {recording.name: trace_of(recording) for recording in _recordings(obj, options.recording)}


def _recordings(obj: bpy.types.Object, name: str | None) -> list[Recording]:
    """The armature's recordings, or the one of that name; UserError where there is none."""
    recordings = [recording for recording in obj.fragmotion.recordings if name in (None, recording.name)]
    if not recordings:
        there = ", ".join(f"'{recording.name}'" for recording in obj.fragmotion.recordings) or "none"
        raise UserError(
            f"Armature '{obj.name}' has no recording '{name}': it has {there}"
            if name is not None
            else f"Armature '{obj.name}' has no recordings"
        )
    return recordings


def _info(options: argparse.Namespace) -> running.Done:
    if not _is_blend(options.character, options):
        return building.info(options)
    obj = _open(options.character, options.armature)
    if not has_character(obj):
        raise UserError(f"Armature '{obj.name}' has no character yet")
    return _described(obj)


def _is_blend(path: Path, options: argparse.Namespace) -> bool:
    return bool(options.armature) or path.suffix.lower() == _BLEND


def _retarget(options: argparse.Namespace) -> running.Done:
    if not options.blend:
        return retargeting.retarget(options)
    retarget_inputs.check(options)
    if options.onto.suffix.lower() in retarget_inputs.SKELETONS:
        raise UserError(f"--blend is for rigs, and {options.onto.name} is a skeleton alone: leave it out")
    takes = sources.read_sources(options.takes, options.unit)
    obj = open_rig(options.onto, options.armature)
    rig = rig_with_feet(bpy.context, obj)
    with core_errors(f"Armature '{obj.name}'"):
        body = roles.make_body(rig.skeleton, [], options.roles, make_skin(obj, rig))
    done, character = retargeting.bring(options, takes, body)
    save_minute(obj, character, options.seed, options.blend)
    return done


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


def _described(obj: bpy.types.Object) -> running.Done:
    """What the last build found."""
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
    return running.Done(found, running.listed(found))


def _save(path: Path | None) -> None:
    if path:
        bpy.ops.wm.save_as_mainfile(filepath=str(path.resolve()), check_existing=False)


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
