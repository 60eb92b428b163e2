# SPDX-License-Identifier: MIT
"""Flamenco's job type: the tasks that its script makes of jobs. tests/blender runs these tasks' commands."""

from __future__ import annotations

import json
from pathlib import Path

from conftest import TOP, Run

SCRIPT = TOP / "addon" / "fragmotion" / "farm" / "fragmotion_bake.js"
JOBS = TOP / "tests" / "data" / "farm" / "jobs.json"


def test_jobs_become_tasks(in_unstable: Run) -> None:
    told = json.loads(in_unstable("node", Path(__file__).parent / "farm" / "compile.mjs", SCRIPT, JOBS))
    wanted = json.loads(JOBS.read_text())
    assert len(told) == len(wanted)
    for tasks, job in zip(told, wanted):
        assert tasks == {key: value for key, value in job.items() if key != "settings"}
