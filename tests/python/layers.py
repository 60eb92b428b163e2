# SPDX-License-Identifier: MIT
"""What the tests of the sources' order share: folders in a list, of which none needs one further down."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

TOP = Path(__file__).parents[2]


def assert_in_order(folders: Sequence[str], folder: str, needed: dict[Path, Iterable[str]]) -> None:
    """The files of a folder, of which there are some, need none but their own folder and those before it."""
    assert needed
    allowed = set(folders[: folders.index(folder) + 1])
    for path, others in needed.items():
        assert set(others) <= allowed, path.relative_to(TOP)
