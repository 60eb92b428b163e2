# SPDX-License-Identifier: MIT
"""Driving in a window of Debian's Blender: a pad, keys, the on-screen stick, recording, and how a drive ends."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parent / "drive_in_window.py"
PICTURES = ["1 before", "2 walking", "3 running", "4 recording", "5 stick", "6 panels", "7 sliding"]


def test_a_drive_by_hand(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    blender = shutil.which("blender")
    assert blender, "Debian's Blender is not installed"
    command = [blender, "--factory-startup", "--enable-event-simulate", "--window-geometry", "0", "0", "1600", "900"]
    script = [str(SCRIPT), "--", os.environ["FRAGMOTION_ADDON_ZIP"], str(tmp_path)]
    done = subprocess.run([*command, "--python", *script], capture_output=True, text=True, timeout=240, check=False)
    figures = [line for line in done.stdout.splitlines() if line.startswith(("updates:", "our own time:", "stick"))]
    with capsys.disabled():
        print("", *figures, sep="\n")
    assert "SESSION PASSED" in done.stdout, done.stdout[-3000:] + done.stderr[-3000:]
    assert sorted(path.stem for path in tmp_path.glob("*.png")) == PICTURES
