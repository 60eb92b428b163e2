# SPDX-License-Identifier: MIT
"""The panel in a window of Debian's Blender: import, a build stopped by Esc and by its button, build, bake, undo."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

SCRIPT = Path(__file__).parent / "panel_in_window.py"


def test_a_session_by_hand(tmp_path: Path) -> None:
    blender = shutil.which("blender")
    assert blender, "Debian's Blender is not installed"
    command = [blender, "--factory-startup", "--enable-event-simulate", "--window-geometry", "0", "0", "1600", "900"]
    script = [str(SCRIPT), "--", os.environ["FRAGMOTION_ADDON_ZIP"], str(tmp_path)]
    done = subprocess.run([*command, "--python", *script], capture_output=True, text=True, timeout=180, check=False)
    assert "SESSION PASSED" in done.stdout, done.stdout[-3000:] + done.stderr[-3000:]
    pictures = sorted(path.name for path in tmp_path.glob("*.png"))
    assert pictures == ["1 empty.png", "2 imported.png", "3 building.png", "4 built.png", "5 baked.png"]
