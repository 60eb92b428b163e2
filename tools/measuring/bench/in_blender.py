# SPDX-License-Identifier: MIT
"""Run inside Blender by tools/measuring/bench/blender.py: how long the add-on's import and Build take.

Arguments after `--`: the add-on's zip, the folder of takes, and the JSON file that gets both in seconds.
"""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import Any

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "tests" / "blender"))
making: Any = import_module("making")


def seconds(operator: Callable[..., set[str]], **properties: Any) -> float:
    """How long an operator takes; stop where it does not finish, as it has said why."""
    begin = time.perf_counter()
    if operator("EXEC_DEFAULT", **properties) != {"FINISHED"}:
        raise SystemExit(f"{operator} did not finish")
    return time.perf_counter() - begin


def main(package: str, takes: str, output: str) -> None:
    """Import the takes, build of them, write how long both took."""
    making.install(package)
    bpy.ops.wm.read_homefile(use_empty=True)
    figures = {
        "importing": seconds(bpy.ops.fragmotion.import_mocap, directory=takes),
        "building": seconds(bpy.ops.fragmotion.build),
    }
    Path(output).write_text(json.dumps(figures))


main(*sys.argv[sys.argv.index("--") + 1 :])
