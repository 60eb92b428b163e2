# SPDX-License-Identifier: GPL-3.0-or-later
"""Reading and writing whole files: nothing but regular files is read, and nothing that exists is written over."""

from __future__ import annotations

import os
import secrets
import stat
from contextlib import suppress
from pathlib import Path

from .errors import UserError

LARGEST = 1 << 30
"""Bytes of a policy file that are read; an hour of takes makes a tenth of it."""

_OPENING = os.O_RDONLY | getattr(os, "O_BINARY", 0) | getattr(os, "O_NONBLOCK", 0)  # a pipe must not wait for a writer


def check_regular(path: Path) -> None:
    """UserError where the path leads to a device, a pipe or a folder, which a reader would wait for or never end."""
    try:
        _check(path, path.stat().st_mode)
    except OSError:
        return  # whoever reads it says best what is wrong


def read_regular(path: Path, follow: bool) -> bytes:
    """A regular file's bytes, at the end of a link only where one may be followed; UserError on anything else."""
    try:
        _check(path, (path.stat() if follow else path.lstat()).st_mode)
        with open(path, "rb", opener=lambda name, _: os.open(name, _OPENING)) as file:
            found = os.fstat(file.fileno())
            _check(path, found.st_mode)
            if found.st_size > LARGEST:
                raise UserError(f"'{path}' is no policy file: it is larger than {LARGEST >> 20} MB")
            return file.read(LARGEST)
    except (OSError, ValueError) as error:  # ValueError: a null in the path
        reason = error.strerror if isinstance(error, OSError) else str(error)
        raise UserError(f"'{path}' cannot be read ({reason})") from error


def write_new(path: Path, data: bytes) -> None:
    """Write a file that is not there yet, whole or not at all; OSError where that cannot be."""
    temporary = path.with_name(f"{secrets.token_hex(8)}.tmp")
    try:
        with temporary.open("xb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, path)
    except OSError:
        temporary.unlink(missing_ok=True)
        raise
    _settle(path.parent)


def _settle(folder: Path) -> None:
    """Bring the names in a folder onto the disk. Not every system can; the file is whole all the same."""
    with suppress(OSError):
        opened = os.open(folder, os.O_RDONLY)  # Windows opens no folder
        try:
            os.fsync(opened)
        finally:
            os.close(opened)


def _check(path: Path, mode: int) -> None:
    if not stat.S_ISREG(mode):
        kind = "a link" if stat.S_ISLNK(mode) else "a folder" if stat.S_ISDIR(mode) else "a device or a pipe"
        raise UserError(f"'{path}' is {kind}: only regular files are read")
