# SPDX-License-Identifier: MIT
"""What a method keeps in memory to play."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

import fragmotion_core as core

from tools.paths import TOP
from tools.shell import Failure

_LOAD = """
import sys
import fragmotion_core as core
from fragmotion_command.evaluate.measures.synthesis import peak_memory
def play():
    character = core.Character.load(sys.argv[1])
    core.Player(character).step([0, 1, 0, 0], 1 / 60)
    return character
print(peak_memory(play) or 0)
"""


def policy_costs(character: core.Character) -> dict[str, float]:
    """MB of the policy file, and by which a process grows that loads it and plays; the latter is left out where the
    system does not tell."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "character.policy"
        character.save(path)
        file = path.stat().st_size
        command = [sys.executable, "-c", _LOAD, str(path)]
        answer = subprocess.run(command, cwd=TOP, capture_output=True, text=True, check=False)
    if answer.returncode != 0:
        raise Failure(f"measuring what a policy takes in memory failed:\n{answer.stderr}")
    grown = int(answer.stdout)
    return {"file_mb": file / 1e6, **({"memory_mb": grown / 1e6} if grown else {})}
