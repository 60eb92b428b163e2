# SPDX-License-Identifier: MIT
"""The folders of tools are rooms in which one finds one's way: ten files at most in each."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

TOP = Path(__file__).parents[2]
MOST = 10


def test_no_folder_of_tools_has_more_than_ten_files() -> None:
    files = [path for path in (TOP / "tools").rglob("*") if path.is_file() and "__pycache__" not in path.parts]
    counts = Counter(path.parent.relative_to(TOP).as_posix() for path in files)
    assert counts["tools"]
    assert {folder: count for folder, count in counts.items() if count > MOST} == {}
