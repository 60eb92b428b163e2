# SPDX-License-Identifier: MIT
"""What can be asked of takes, and what of a character, checked before anything is measured."""

from __future__ import annotations

import argparse
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from ..files import BY_BLENDER, ENDINGS

_USUAL = {"classes": 97, "seed": 1, "responsiveness": 0.5}
_OF_CHARACTERS = ("trace", "player", "seconds")
_OF_TAKES = (
    *("train", "test", "classes", "controls", "speeds", "directions", "turn", "jump", "unit"),
    *("figures", "no_curves", "quick", "responsiveness"),
)


def is_character(options: argparse.Namespace) -> bool:
    """Whether one file is given that holds no takes; ValueError where an option is for the others."""
    source = options.sources[0]
    if not source.exists():
        raise ValueError(f"{source}: there is no such file or folder")
    of_takes = source.is_dir() or source.suffix.lower() in (*ENDINGS, *BY_BLENDER, ".asf")
    found = len(options.sources) == 1 and not of_takes
    check_kind(options, found)
    return found


def check_kind(options: argparse.Namespace, is_character: bool) -> None:
    """ValueError where an option is for takes, and a character is measured, or the other way round."""
    for name in _OF_TAKES if is_character else _OF_CHARACTERS:
        if getattr(options, name) is not None:
            option = f"no-{name}" if name in ("turn", "jump") else name.replace("_", "-")
            whose, is_whose = ("takes", "a character") if is_character else ("characters", "of takes")
            raise ValueError(f"--{option} is for {whose}, and {options.sources[0]} is {is_whose}: leave it out")


def check(options: argparse.Namespace) -> None:
    """Fill in what nobody told; ValueError on a number or a file that cannot be used."""
    for name, value in _USUAL.items():
        if getattr(options, name) is None:
            setattr(options, name, value)
    if options.unit is not None and not options.unit > 0:
        raise ValueError(f"--unit is {options.unit:g}, and must be over 0")
    if not 0 <= options.responsiveness <= 1:
        raise ValueError(f"--responsiveness is {options.responsiveness:g}, and must be 0 to 1")
    if options.quick and options.figures:
        raise ValueError("--figures draws what --quick does not measure: leave one of them out")
    for traces in (options.train, options.test):
        _check_traces(traces or [])
    for target in (Path(options.json).parent if options.json else None, options.figures):
        _check_folder(target)


def _check_traces(paths: Sequence[Path]) -> None:
    for path in paths:
        if not path.is_file():
            raise ValueError(f"{path}: there is no such trace file")
    name, count = Counter(path.stem for path in paths).most_common(1)[0] if paths else ("", 1)
    if count > 1:
        raise ValueError(f"{count} traces are called {name}: give each player's trace a name of its own")


def _check_folder(folder: Path | None) -> None:
    if folder is None:
        return
    nearest = next(path for path in (folder.absolute(), *folder.absolute().parents) if path.exists())
    if not nearest.is_dir():
        raise ValueError(f"{nearest}: not a folder")
