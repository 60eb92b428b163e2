# SPDX-License-Identifier: MIT
"""The command line of `dev.py evaluate`, and finding the files that it names. Needs Python alone."""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from tools.measuring.evaluate import control_options
from tools.shell import Failure

_TAKES = (".bvh", ".amc", ".blend")


@dataclass(frozen=True)
class TakeFile:
    """A file of motion capture, and the Acclaim skeleton that an .amc belongs to."""

    path: Path
    asf: Path | None = None


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What can be asked for."""
    parser.add_argument(
        "mocap", nargs="+", type=Path, metavar="MOCAP", help="BVH or AMC files, folders of them, or a .blend"
    )
    parser.add_argument(
        "--train", nargs="+", type=Path, metavar="CSV", help="traces to learn from (default: the simulated players)"
    )
    parser.add_argument(
        "--test", nargs="+", type=Path, metavar="CSV", help="traces to test with (default: the simulated players)"
    )
    parser.add_argument("--classes", type=int, default=97, metavar="N", help="number of classes (default 97)")
    control_options.add_arguments(parser)
    parser.add_argument("--seed", type=int, default=1, metavar="S", help="of all that is drawn at random (default 1)")
    parser.add_argument(
        "--unit", type=float, default=0.01, metavar="M", help="metres in one unit of a BVH file (default 0.01)"
    )
    parser.add_argument("--json", type=Path, metavar="FILE", help="save all figures there")
    parser.add_argument("--figures", type=Path, metavar="DIR", help="draw the pictures there, and save the traces")
    parser.add_argument(
        "--no-curves", action="store_true", help="leave out quality against classes and minutes, which takes longest"
    )
    parser.add_argument(
        "--quick", action="store_true", help="only the default policy at run time beside the takes: takes seconds"
    )
    parser.add_argument(
        "--responsiveness", type=float, default=0.5, metavar="R", help="of the player, 0 to 1 (default 0.5)"
    )


def check(options: argparse.Namespace) -> None:
    """Raise Failure on a number or a file that cannot be used, before anything is measured."""
    if options.classes < 1:
        raise Failure(f"--classes is {options.classes}, and must be 1 or more")
    if options.seed < 0:
        raise Failure(f"--seed is {options.seed}, and must be 0 or more")
    if not options.unit > 0:
        raise Failure(f"--unit is {options.unit:g}, and must be over 0")
    if not 0 <= options.responsiveness <= 1:
        raise Failure(f"--responsiveness is {options.responsiveness:g}, and must be 0 to 1")
    if options.quick and options.figures:
        raise Failure("--figures draws what --quick does not measure: leave one of them out")
    find_takes(options.mocap)
    for traces in (options.train, options.test):
        _check_traces(traces or [])
    for target in (options.json.parent if options.json else None, options.figures):
        _check_folder(target)


def find_takes(paths: Sequence[Path]) -> list[TakeFile]:
    """The takes among files and folders; hidden files in a folder do not count. Failure names what is wrong."""
    takes: list[TakeFile] = []
    for path in paths:
        takes += _takes_of_folder(path) if path.is_dir() else [_take(path)]
    return takes


def has_blend(paths: Sequence[Path]) -> bool:
    """Whether Blender is needed to read the takes."""
    return any(take.path.suffix.lower() == ".blend" for take in find_takes(paths))


def _takes_of_folder(folder: Path) -> list[TakeFile]:
    takes = [_take(path) for path in _files(folder) if path.suffix.lower() in (".bvh", ".amc")]
    if not takes:
        raise Failure(f"{folder}: no takes in this folder (.bvh, or .amc with its .asf; a .blend is named itself)")
    return takes


def _files(folder: Path) -> list[Path]:
    return sorted(path for path in folder.iterdir() if path.is_file() and not path.name.startswith("."))


def _take(path: Path) -> TakeFile:
    if not path.is_file():
        raise Failure(f"{path}: there is no such file or folder")
    if path.suffix.lower() not in _TAKES:
        raise Failure(f"{path}: not motion capture that can be read ({', '.join(_TAKES)})")
    return TakeFile(path, _skeleton_of(path) if path.suffix.lower() == ".amc" else None)


def _skeleton_of(amc: Path) -> Path:
    """The .asf named by what stands before the .amc's underscore, or the folder's only one."""
    skeletons = [path for path in _files(amc.parent) if path.suffix.lower() == ".asf"]
    stem = amc.stem.partition("_")[0].lower()
    named = [path for path in skeletons if path.stem.lower() in (stem, amc.stem.lower())]
    if not named and len(skeletons) != 1:
        raise Failure(f"{amc}: its skeleton {stem}.asf is not in the folder")
    return (named or skeletons)[0]


def _check_traces(paths: Sequence[Path]) -> None:
    for path in paths:
        if not path.is_file():
            raise Failure(f"{path}: there is no such trace file")
    name, count = Counter(path.stem for path in paths).most_common(1)[0] if paths else ("", 1)
    if count > 1:
        raise Failure(f"{count} traces are called {name}: give each player's trace a name of its own")


def _check_folder(folder: Path | None) -> None:
    if folder is None:
        return
    nearest = next(path for path in (folder.absolute(), *folder.absolute().parents) if path.exists())
    if not nearest.is_dir():
        raise Failure(f"{nearest}: not a folder")
