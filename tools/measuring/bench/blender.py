# SPDX-License-Identifier: MIT
"""What importing takes and pressing Build take in Debian's Blender without a window, and what the core alone does."""

from __future__ import annotations

import json
import os
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path

import fragmotion_core as core
from fragmotion_command.evaluate.loading import Recordings, read_recordings

from tools.measuring.bench.stored import policy_of
from tools.paths import TOP
from tools.setup import blender


@dataclass(frozen=True)
class InBlender:
    """Seconds, of which the core alone needs `reading` of those of the import and `core_building` of those of Build."""

    importing: float
    building: float
    reading: float
    core_building: float


def measure_in_blender(recordings: Recordings, package: Path, folder: Path) -> InBlender:
    """Write the takes as BVH files into a new folder, and let a Blender with the add-on's zip work on them."""
    takes, output = folder / "takes", folder / "blender.json"
    takes.mkdir()
    for clip in recordings.clips:
        core.write_bvh(core.Take.from_clip(clip, recordings.skeleton), takes / f"{clip.name}.bvh")
    script = TOP / "tools" / "measuring" / "bench" / "in_blender.py"
    command = blender.background_command(script, package, takes, output)
    answer = subprocess.run(
        command, env={**os.environ, **blender.debian_environment("bench")}, capture_output=True, text=True, check=False
    )
    if answer.returncode != 0:
        raise SystemExit(f"Blender failed with exit code {answer.returncode}:\n{answer.stdout}{answer.stderr}")
    return InBlender(**json.loads(output.read_text()), **_alone(takes))


def _alone(folder: Path) -> dict[str, float]:
    begin = time.perf_counter()
    recordings = read_recordings([folder], 0.01)
    read = time.perf_counter()
    policy_of(recordings)
    return {"reading": read - begin, "core_building": time.perf_counter() - read}
