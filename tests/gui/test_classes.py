# SPDX-License-Identifier: MIT
"""The panels of the classes in a window of Debian's Blender: suggest, coverage, list, inspector, preview, force."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

SCRIPT = Path(__file__).parent / "classes_in_window.py"
PICTURES = [
    *("0 trying", "1 suggested", "2 coverage", "3 classes", "4 inspector", "5 left out", "6 preview", "7 driving"),
]


def test_the_panels_of_the_classes(tmp_path: Path) -> None:
    blender = shutil.which("blender")
    assert blender, "Debian's Blender is not installed"
    command = [blender, "--factory-startup", "--enable-event-simulate", "--window-geometry", "0", "0", "1600", "900"]
    script = [str(SCRIPT), "--", os.environ["FRAGMOTION_ADDON_ZIP"], str(tmp_path)]
    done = subprocess.run([*command, "--python", *script], capture_output=True, text=True, timeout=400, check=False)
    assert "SESSION PASSED" in done.stdout, done.stdout[-3000:] + done.stderr[-3000:]
    assert sorted(path.stem for path in tmp_path.glob("*.png")) == PICTURES
