# SPDX-License-Identifier: MIT
"""`dev.py docs`: each page's pictures and tables, in the Blender or the Python that they take."""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

from tools.docs.in_window import running
from tools.games import web
from tools.measuring.directing.inputs import SAMPLE
from tools.packaging import packages
from tools.packaging.compiling import installed_core
from tools.paths import BUILD, TOP
from tools.setup import blender, machine, unstable
from tools.setup.environments import BPY_PYTHON, environment_python
from tools.shell import Failure, run, say

_DOCS = TOP / "docs"
_LONG = "film"  # takes half an hour, and is no part of the repository: only where it is asked for
_SCRIPTS = Path(__file__).parent


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What can be asked for."""
    parser.add_argument("pages", nargs="*", metavar="NAME", help=f"only these of {', '.join(PAGES)}")
    parser.add_argument(
        "--mocap",
        type=Path,
        metavar="DIR",
        help="a folder with bandai-namco, to measure the evaluation anew, and cmu, for retargeting's pictures",
    )
    parser.add_argument("--packs", type=Path, metavar="DIR", help="the downloaded characters of docs/characters.md")
    parser.add_argument("--fbx", type=Path, metavar="FILE", help="Mixamo's X Bot, for retargeting's second picture")


def make_docs(options: argparse.Namespace) -> int:
    """Make the named pages or all."""
    unknown = [name for name in options.pages if name not in PAGES]
    if unknown:
        raise Failure(f"there is no page {', '.join(unknown)}; the pages are {', '.join(PAGES)}")
    for name in options.pages or [name for name in PAGES if name != _LONG]:
        say(f"\n=== {name}")
        PAGES[name](options)
    return 0


def _readme(options: argparse.Namespace) -> None:
    _run_python("tools.docs.drive_picture")


def _icon(options: argparse.Namespace) -> None:
    _run_python("tools.docs.icon")


def _film(options: argparse.Namespace) -> None:
    _run_python("tools.film")


def _play(options: argparse.Namespace) -> None:
    machine.set_up(machine.DEMO)
    page, pictures = BUILD / "docs-play" / "page", BUILD / "docs-play" / "pictures"
    web.make(page)
    pictures.mkdir(parents=True, exist_ok=True)
    run(unstable.command(["node", TOP / "tests" / "engines" / "web" / "page.mjs", page, pictures]), "docs-play")
    shutil.copy(pictures / "play.png", _DOCS)


def _guide(options: argparse.Namespace) -> None:
    running.run_script("guide", _DOCS / "guide")


def _motion(options: argparse.Namespace) -> None:
    _run_python("tools.motion_pictures", str(SAMPLE), str(_DOCS / "motion"))


def _directing(options: argparse.Namespace) -> None:
    folder = _DOCS / "directing"
    _run_python("tools.measuring.directing", "--figures", str(folder), "--json", str(folder / "directing.json"))
    _run_python("tools.docs.directing")
    running.run_script("recordings", folder)


def _ground(options: argparse.Namespace) -> None:
    _run_python("tools.docs.ground")


def _evaluation(options: argparse.Namespace) -> None:
    if options.mocap:
        takes, folder = str(_takes(options, "bandai-namco")), _DOCS / "evaluation"
        made = ("--figures", str(folder), "--json", str(folder / "evaluation.json"))
        _run_python("fragmotion_command", "evaluate", takes, *made)
        _run_python("tools.measuring.beside", takes, "--json", str(folder / "beside.json"))
    else:
        say("the page is filled from the figures of the last run; --mocap DIR measures anew")
    _run_python("tools.docs.evaluation")


def _retargeting(options: argparse.Namespace) -> None:
    if not options.mocap:
        say("left out: its pictures take CMU's take 02_01; --mocap DIR says where it is")
        return
    take = _takes(options, "cmu") / "02_01.amc"
    machine.set_up(machine.DEMO)
    package = packages.build_for_debian()
    kinds = {"rigify": [], **({"xbot": [options.fbx.resolve()]} if options.fbx else {})}
    for name, character in kinds.items():
        words = [package, take, _DOCS / "retargeting" / f"{name}.jpg", *character]
        command = blender.background_command(_SCRIPTS / "retargeting_in_blender.py", *words)
        run(command, f"docs-{name}", blender.debian_environment("docs"), echo=True)


def _characters(options: argparse.Namespace) -> None:
    if options.packs:
        _run_python("tools.docs.characters", str(options.packs.resolve()))
    else:
        say("left out: its pictures take downloaded characters; --packs DIR says where they are")


def _takes(options: argparse.Namespace, name: str) -> Path:
    folder: Path = options.mocap.resolve() / name
    if not folder.is_dir():
        raise Failure(f"{folder}: there is no such folder")
    return folder


def _run_python(module: str, *arguments: str) -> None:
    """Run a module with the core and Blender's module."""
    machine.set_up(machine.measuring_needs(BPY_PYTHON) | machine.BLENDER_45)
    core = installed_core(BPY_PYTHON, packages.wheel(BPY_PYTHON))
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join((str(core), str(TOP)))}
    command = [str(environment_python(BPY_PYTHON)), "-m", module, *arguments]
    if subprocess.run(command, env=environment, cwd=TOP, check=False).returncode:
        raise Failure(f"{module} failed; what it printed says why")


PAGES: dict[str, Callable[[argparse.Namespace], None]] = {
    "readme": _readme,
    "guide": _guide,
    "play": _play,
    "motion": _motion,
    "directing": _directing,
    "ground": _ground,
    "evaluation": _evaluation,
    "retargeting": _retargeting,
    "characters": _characters,
    "icon": _icon,
    "film": _film,
}
"""What makes the pictures and tables of each page."""
