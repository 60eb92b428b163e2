# SPDX-License-Identifier: MIT
"""The figures that the gate holds, measured now: those of `dev.py evaluate --quick` on the sample's takes."""

from __future__ import annotations

import argparse
import os
from concurrent.futures import ThreadPoolExecutor

from tools.evaluate import inputs
from tools.evaluate.controllers import DEFAULT
from tools.evaluate.loading import make_sessions
from tools.evaluate.measuring import measure_quickly
from tools.measuring.quality.gate import SEEDS, WORSE, Spread
from tools.measuring.quality.sample import sample_recordings


def measure_now() -> dict[str, Spread]:
    """Mean and spread of each figure over the seeds."""
    sample_recordings()
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        by_seed = list(pool.map(_figures, SEEDS))
    return {name: Spread.of([figures[name] for figures in by_seed]) for name in WORSE}


def _figures(seed: int) -> dict[str, float]:
    parser = argparse.ArgumentParser()
    inputs.add_arguments(parser)
    options = parser.parse_args(["sample", "--quick", "--seed", str(seed)])
    recordings = sample_recordings()
    result = measure_quickly(recordings, make_sessions(options, recordings), options)
    return {**result["controllers"][DEFAULT]["run_time"], **result["likeness"]["played"]}
