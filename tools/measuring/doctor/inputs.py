# SPDX-License-Identifier: MIT
"""The command line of `dev.py doctor`, and finding the files that it names. Needs Python alone."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from pathlib import Path

from tools.shell import Failure

ENDINGS = (".bvh", ".amc")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """What can be asked for."""
    parser.add_argument(
        "files", nargs="+", type=Path, metavar="MOCAP", help="BVH or AMC files, or folders with such files at any depth"
    )
    parser.add_argument("--json", type=Path, metavar="FILE", help="save what is found there too")


def check(options: argparse.Namespace) -> None:
    """Raise Failure where there is nothing to examine, or nowhere to save."""
    find_files(options.files)
    if options.json and not options.json.absolute().parent.is_dir():
        raise Failure(f"{options.json.parent}: not a folder")


def find_files(paths: Sequence[Path]) -> list[Path]:
    """The motion capture files among files and folders, each once; Failure names what is not there."""
    found = dict.fromkeys(file for path in paths for file in _files_of(path))
    if not found:
        raise Failure(f"{', '.join(map(str, paths))}: no motion capture here (.bvh, or .amc with its .asf)")
    return list(found)


def _files_of(path: Path) -> Iterator[Path]:
    if path.is_dir():
        yield from sorted(file for file in path.rglob("*") if _is_take(file, path))
    elif not path.is_file():
        raise Failure(f"{path}: there is no such file or folder")
    elif path.suffix.lower() != ".asf":  # its motion is in .amc files
        yield path


def _is_take(file: Path, folder: Path) -> bool:
    hidden = any(part.startswith(".") for part in file.relative_to(folder).parts)
    return file.suffix.lower() in ENDINGS and not hidden and file.is_file()
