# SPDX-License-Identifier: MIT
"""Links and pipes, where the system has them."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

import pytest


def make_link(path: Path, target: Path | str) -> None:
    """A symbolic link; skips the test where none can be made, as by most of Windows' users and in Wine."""
    with suppress(OSError):
        path.symlink_to(target)
    if not path.is_symlink():
        pytest.skip("Windows makes no symbolic link here")


def make_pipe(path: Path) -> None:
    """A named pipe; skips the test where there is none among the files."""
    if not hasattr(os, "mkfifo"):
        pytest.skip("Windows has no pipes among its files")
    os.mkfifo(path)
