# SPDX-License-Identifier: GPL-3.0-or-later
"""Which files hold takes, and which of them Blender's own importers read."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from ..compat.core import command
from ..errors import UserError

if TYPE_CHECKING:
    from fragmotion_command import files
else:
    files = command("files")

BY_BLENDER = files.BY_BLENDER
"""Endings of the files that Blender reads, whatever they hold."""

ENDINGS = files.ENDINGS + BY_BLENDER


class TakeFile(NamedTuple):
    """A file of takes, and whether it was asked for by its name."""

    path: Path
    named: bool = False


def find_takes(directory: Path, names: Sequence[str] = ()) -> list[TakeFile]:
    """The takes among the named files of a folder, or all in it at any depth that are not hidden. UserError says what
    is missing."""
    if not directory.is_dir():
        raise UserError(f"'{directory}' is not a folder")
    paths = [directory / name for name in names] or sorted(_visible_files(directory))
    takes = [TakeFile(path, bool(names)) for path in paths if path.suffix.lower() in ENDINGS]
    if not takes:
        where = ", ".join(f"'{path}'" for path in paths) if names else f"Folder '{directory}'"
        advice = files.by_another_name(paths[0]) if len(names) == 1 else ""
        raise UserError(f"{where}: no takes here ({', '.join(ENDINGS)}; an .amc with its .asf){advice}")
    return takes


def _visible_files(folder: Path) -> Iterator[Path]:
    """The files in a folder and those below without hidden ones, such as the "._NAME" that macOS puts beside each file.
    Folders that are links are left out: they may lead back."""
    for path in _visible(folder):
        if path.is_file():
            yield path
        elif path.is_dir() and not path.is_symlink():
            yield from _visible_files(path)


def _visible(folder: Path) -> list[Path]:
    try:
        return [path for path in folder.iterdir() if not path.name.startswith(".")]
    except OSError as error:
        raise UserError(f"'{folder}' cannot be read ({error.strerror})") from error
