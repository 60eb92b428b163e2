# SPDX-License-Identifier: MIT
"""Every public callable with wrong arguments: an exception or a sane result, and never the end of the process."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parent
SECONDS = 600  # for some seconds' work, also under a sanitizer on a busy machine


@pytest.mark.thorough
def test_wrong_arguments_are_exceptions_or_sane_results(tmp_path: Path) -> None:
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([*sys.path, str(HERE)]), "PYTHONWARNINGS": "ignore"}
    command = [sys.executable, "-X", "faulthandler", str(HERE / "wrong_arguments.py"), str(tmp_path)]
    done = subprocess.run(
        command, env=environment, capture_output=True, text=True, errors="replace", timeout=SECONDS, check=False
    )
    last = done.stdout.strip().splitlines()[-1:] or ["nothing was called"]
    assert done.returncode == 0, f"exit code {done.returncode} after {last[0]}\n{done.stderr[-3000:]}"
    assert last[0].startswith("done: ")
