# SPDX-License-Identifier: MIT
"""`live_an_extension.py ZIP NEWER`: install, disable, enable, update and uninstall, in a process of its own, with a
character in the open file. Prints, as JSON, what there is of the add-on at each step."""

from __future__ import annotations

import importlib
import json
import os
import sys
from pathlib import Path
from typing import Any

import bpy
import making
from registered import registered

FOLDER = Path(os.environ["BLENDER_USER_RESOURCES"])


def state(name: str) -> dict[str, Any]:
    """What is registered, which files there are, and the character of the open file where it can be loaded."""
    found: dict[str, Any] = {
        "registered": sorted(registered()),
        "files": sum(_is_own(path) for path in FOLDER.rglob("*")),
    }
    obj = bpy.context.view_layer.objects.active
    if obj is not None and found["registered"]:
        module = importlib.import_module(name)
        module.character.building.forget()
        found["newer"] = hasattr(module, "NEWER") and module.errors.NEWER
        found["fragments"] = module.character.building.load(obj).fragment_durations.size if obj.fragmotion.policy else 0
        found["recordings"] = len(obj.fragmotion.recordings)
    return found


def _is_own(path: Path) -> bool:
    """Whether a file is the add-on's, or a wheel's that it brings."""
    return (
        path.is_file() and any(word in str(path) for word in ("fragmotion", "sdl2")) and "blender_ext" not in path.name
    )


def main(package: str, newer: str) -> None:
    steps = {}
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    steps["before"] = state("")
    name = making.install(package)
    bpy.ops.fragmotion.add_sample()
    bpy.ops.fragmotion.build("EXEC_DEFAULT", classes=8)
    trace = FOLDER / "trace.csv"
    trace.write_text("velocity_x,velocity_y,turn,jump\n" + "0,1.2,0,0\n" * 15)
    bpy.ops.fragmotion.import_recordings(filepath=str(trace))
    steps["installed"] = state(name)
    bpy.ops.preferences.addon_disable(module=name)
    steps["disabled"] = state(name)
    bpy.ops.preferences.addon_enable(module=name)
    steps["enabled"] = state(name)
    making.install(newer)
    steps["updated"] = state(name)
    repos = [repo.module for repo in bpy.context.preferences.extensions.repos]
    bpy.ops.extensions.package_uninstall(repo_index=repos.index("user_default"), pkg_id="fragmotion")
    steps["uninstalled"] = state(name)
    print("STEPS " + json.dumps(steps), flush=True)
    os._exit(0)


if __name__ == "__main__":
    main(*sys.argv[-2:])
