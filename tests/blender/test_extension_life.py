# SPDX-License-Identifier: MIT
"""The life of an extension: what there is of it after each step, and that an update keeps the open file's character."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import zipfile
from pathlib import Path
from typing import Any

import bpy
import pytest

SCRIPT = Path(__file__).with_name("live_an_extension.py")

# Blender 4.3 does not tell: it is a program here.
IS_MODULE = getattr(bpy.app, "module", False)
pytestmark = pytest.mark.skipif(
    not IS_MODULE, reason="this Blender is a program: extensions are installed where bpy is a module"
)


@pytest.fixture(scope="module")
def steps(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """What the script prints."""
    folder = tmp_path_factory.mktemp("life")
    package = Path(os.environ["FRAGMOTION_ADDON_ZIP"])
    newer = folder / "newer.zip"
    with zipfile.ZipFile(package) as old, zipfile.ZipFile(newer, "w") as new:
        for name in old.namelist():
            data = old.read(name)
            if name == "blender_manifest.toml":
                data = data.replace(b'\nversion = "', b'\nversion = "9.8.7" # was "')
            if name in {"__init__.py", "errors.py"}:
                data += b"\nNEWER = True\n"
            new.writestr(name, data)
    user = {"BLENDER_USER_RESOURCES": folder, "BLENDER_USER_SCRIPTS": folder / "s", "BLENDER_USER_CONFIG": folder / "c"}
    for path in user.values():
        path.mkdir(exist_ok=True)
    environment = {**os.environ, **{name: str(path) for name, path in user.items()}}
    words = [sys.executable, str(SCRIPT), str(package), str(newer)]
    answer = subprocess.run(
        words, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False, timeout=300
    )
    said = [line for line in answer.stdout.splitlines() if line.startswith("STEPS ")]
    assert said, answer.stdout + answer.stderr
    found: dict[str, Any] = json.loads(said[0].removeprefix("STEPS "))
    return found


def test_what_is_installed_is_there_and_what_is_disabled_is_not(steps: dict[str, Any]) -> None:
    assert steps["before"] == {"registered": [], "files": 0}
    assert "FRAGMOTION_PT_build" in steps["installed"]["registered"] and steps["installed"]["fragments"] > 100
    assert steps["disabled"]["registered"] == []
    assert steps["enabled"] == steps["installed"]


def test_an_update_keeps_the_open_files_character_and_recordings(steps: dict[str, Any]) -> None:
    assert steps["updated"] == {**steps["installed"], "newer": True} and steps["updated"]["recordings"] == 1


@pytest.mark.skipif(sys.platform == "win32", reason="Windows keeps files in use until Blender is closed")
def test_what_is_uninstalled_leaves_no_file(steps: dict[str, Any]) -> None:
    assert steps["uninstalled"] == {"registered": [], "files": 0}
