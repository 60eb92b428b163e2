# SPDX-License-Identifier: MIT
"""The core in Linux's wheel and that in Windows' make the same character, and play it alike, to the bit."""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest
from conftest import BANDAI
from make_character import make
from sample_motions import write_sample

_SCRIPT = Path(__file__).with_name("make_character.py")


def copy_bandai(folder: Path) -> None:
    """Some takes of shared/mocap/bandai-namco."""
    files = sorted(BANDAI.glob("*.bvh"))[::4]
    if not files:
        pytest.skip("no motion capture beside the project")
    for path in files:
        shutil.copy(path, folder)


@pytest.mark.parametrize("fill", [write_sample, copy_bandai])
def test_windows_makes_the_same_character(tmp_path: Path, fill: Callable[[Path], object]) -> None:
    fill(tmp_path)
    make(tmp_path, "linux")
    command = shlex.split(os.environ["FRAGMOTION_WINDOWS_PYTHON"])
    environment = {**os.environ, "PYTHONPATH": os.environ["FRAGMOTION_WINDOWS_PATH"]}
    arguments = [f"Z:{_SCRIPT}", f"Z:{tmp_path}", "windows"]
    answer = subprocess.run(
        [*command, *arguments], env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False
    )
    assert answer.returncode == 0, answer.stderr
    for ending in ("policy", "poses"):
        made = [(tmp_path / f"{system}.{ending}").read_bytes() for system in ("linux", "windows")]
        assert len(made[0]) == len(made[1]) > 100_000
        assert made[0] == made[1], f"{sum(a != b for a, b in zip(*made))} bytes of {len(made[0])} differ"
