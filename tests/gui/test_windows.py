# SPDX-License-Identifier: MIT
"""Sessions by hand in a window of Debian's Blender, each a script that runs inside it and takes pictures."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

import pytest

FOLDER = Path(__file__).parent
FIGURE = "FIGURE "  # as window.tell marks what is to be read
PATIENCE = 1500  # s: a window that hangs; a session takes four minutes on a quiet machine
WINDOW = ("--factory-startup", "--enable-event-simulate", "--window-geometry", "0", "0", "1600", "900")
PICTURES = {
    "panel": ("1 empty", "2 imported", "2 playing", "3 building", "4 built", "5 baked"),
    "classes": (
        *("0 trying", "1 suggested", "2 coverage", "3 classes", "4 inspector", "5 left out", "6 preview", "7 driving"),
    ),
    "drive": (
        *("1 before", "2 walking", "3 running", "4 recording", "5 stick", "6 panels", "7 baked", "8 replay"),
        "9 sliding",
    ),
    "import": ("1 importing", "2 imported", "3 mended"),
    "over": ("1 what was there", "2 yours"),
    "cut": ("1 offered", "2 dragged", "3 cut"),
    "path": ("1 drawn", "2 followed", "3 placed"),
    "moves": ("1 moves", "2 jumping"),
    "styles": ("1 takes", "2 coverage", "2 classes", "3 tired", "3 inspector", "4 neutral"),
    "ground": ("1 chosen", "2 on the stairs"),
    "windows": (),
}


@pytest.mark.parametrize("session", PICTURES)
def test_a_session_by_hand(session: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    blender = shutil.which("blender")
    assert blender, "Debian's Blender is not installed"
    script = str(FOLDER / f"{session}_in_window.py")
    command = [blender, *WINDOW, "--python", script, "--", os.environ["FRAGMOTION_ADDON_ZIP"], str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE, check=False)
    figures = [line.removeprefix(FIGURE) for line in done.stdout.splitlines() if line.startswith(FIGURE)]
    with capsys.disabled():
        print("", *figures, sep="\n")
    assert "SESSION PASSED" in done.stdout, done.stdout[-3000:] + done.stderr[-3000:]
    assert sorted(path.stem for path in tmp_path.glob("*.png")) == sorted(PICTURES[session])
