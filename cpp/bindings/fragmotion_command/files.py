# SPDX-License-Identifier: MIT
"""Files of takes, by the names of files and folders. Needs Python alone."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

ENDINGS = (".bvh", ".amc")
UNIT = 0.01
"""Metres in one unit of a BVH file, where nobody tells."""


def find_takes(paths: Sequence[Path]) -> list[Path]:
    """The files of takes among files and folders, each once, but hidden ones in folders; ValueError names what is not
    there."""
    found = dict.fromkeys(file for path in paths for file in _files_of(path))
    if not found:
        raise ValueError(f"{', '.join(map(str, paths))}: no takes here (.bvh, or .amc with its .asf)")
    return list(found)


def _files_of(path: Path) -> Iterator[Path]:
    if path.is_dir():
        yield from sorted(file for file in path.rglob("*") if _is_take(file, path))
    elif not path.is_file():
        raise ValueError(f"{path}: there is no such file or folder")
    elif path.suffix.lower() != ".asf":  # its motion is in .amc files
        yield path


def _is_take(file: Path, folder: Path) -> bool:
    hidden = any(part.startswith(".") for part in file.relative_to(folder).parts)
    return file.suffix.lower() in ENDINGS and not hidden and file.is_file()
