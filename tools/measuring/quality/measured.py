# SPDX-License-Identifier: MIT
"""The figures that the gate holds, measured now: those of `fragmotion evaluate --quick` on the sample's takes."""

from __future__ import annotations

import os
from concurrent.futures import ThreadPoolExecutor

from fragmotion_command.evaluate import inputs
from fragmotion_command.evaluate.loading import make_sessions
from fragmotion_command.evaluate.measures.controllers import DEFAULT
from fragmotion_command.evaluate.measuring import measure_quickly
from fragmotion_command.parser import make_parser

from tools.measuring.quality.gate import SEEDS, WORSE, Spread
from tools.measuring.quality.sample import sample_recordings


def measure_now() -> dict[str, Spread]:
    """Mean and spread of each figure over the seeds."""
    sample_recordings()
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        by_seed = list(pool.map(_figures, SEEDS))
    return {name: Spread.of([figures[name] for figures in by_seed]) for name in WORSE}


def _figures(seed: int) -> dict[str, float]:
    options = make_parser("fragmotion").parser.parse_args(["evaluate", "sample", "--quick", "--seed", str(seed)])
    inputs.check(options)
    recordings = sample_recordings()
    result = measure_quickly(recordings, make_sessions(options, recordings), options)
    return {**result["controllers"][DEFAULT]["run_time"], **result["likeness"]["played"]}
