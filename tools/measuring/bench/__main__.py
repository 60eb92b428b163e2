# SPDX-License-Identifier: MIT
"""Compare the core's stages (Google Benchmark) with NumPy and scikit-learn: same run, same data, results compared.
Then how time grows with the number of fragments, and each of the project's goals beside its figure.

Frames and crowds are measured on the benchmark's own small character, and on a large one of the sample's takes or those
of `--takes`, of whose policy file is told what it keeps of them; Blender imports these and builds of them.

python -m tools.measuring.bench PROGRAM ZIP [--takes MOCAP...] [--json FILE], from the top folder, with NumPy and
scikit-learn.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
import tempfile
from dataclasses import asdict
from pathlib import Path

import numpy as np
from fragmotion_command.evaluate.loading import read_recordings

from tools.measuring.bench.blender import InBlender, measure_in_blender
from tools.measuring.bench.goals import CHARACTERS, goals, show_goals
from tools.measuring.bench.measured import Growth, Measured, measure_core
from tools.measuring.bench.stages import Arrays, Row, compare
from tools.measuring.bench.stored import Stored, measure_stored, policy_of
from tools.measuring.bench.units import UNITS, duration, megabytes, nanoseconds
from tools.measuring.quality.sample import sample_recordings

_UNIT = 0.01  # m of a BVH file's numbers


def show(
    rows: list[Row], remarks: dict[str, str], measured: Measured, data: Arrays, stored: Stored, in_blender: InBlender
) -> None:
    """Print the table."""
    print(
        f"{len(data['ranges'])} fragments, {len(data['representatives'])} classes, {len(data['points'])} controls, "
        f"{len(data['trace'])} samples, {len(data['parents'])} bones; {os.cpu_count()} CPUs, "
        f"load {os.getloadavg()[0]:.1f}\n"
    )
    print(f"{'stage':<20} {'core':>10} {'reference':>10} {'ratio':>8}  by")
    for row in rows:
        figures = f"{duration(row.seconds):>10} {duration(row.reference_seconds):>10} {row.ratio:>7.1f}x"
        print(f"{row.name:<20} {figures}  {row.reference}: {remarks[row.name]}")
    show_whole_build(measured)
    show_growth(measured.growth)
    show_frames(measured)
    print(
        f"\nIn Blender: import {duration(in_blender.importing)} of which the core alone reads in "
        f"{duration(in_blender.reading)}; Build {duration(in_blender.building)}, the core alone "
        f"{duration(in_blender.core_building)}"
    )
    show_goals(goals(rows, measured, stored, in_blender))


def show_whole_build(measured: Measured) -> None:
    """Print the parts of the fastest one."""
    whole = measured.whole
    stages = [key for key in whole if key.endswith("_seconds")]
    parts = ", ".join(f"{key.partition('_')[0]} {duration(whole[key])}" for key in stages)
    cpu = duration(whole["cpu_time"] * UNITS[whole["time_unit"]])
    print(f"\nWhole build: {whole['fragments']:.0f} fragments ({whole['captured']:.0f} not synthesized), {cpu} of CPU")
    print(f"The fastest one's stages: {parts}")


def show_frames(measured: Measured) -> None:
    """Print a frame of each character, and how far players are off that step in some frames only."""
    for character, called in CHARACTERS.items():
        named = f"{character} frame, "
        frames = {name.removeprefix(named): time for name, time in measured.seconds.items() if name.startswith(named)}
        print(f"\n{called}: a frame " + "; ".join(f"{name} {nanoseconds(time)}" for name, time in frames.items()))
        far = ", ".join(
            f"in every {frames}. frame {off:.3f} and {slides:.3f}"
            for frames, (off, slides) in sorted(measured.off[character].items())
        )
        print(f"Far players, who step {far} m/s: off what is asked, and of feet that stand (held in every frame)")


def show_growth(growth: Growth) -> None:
    """Print how time and memory grow."""
    print(f"\n{'fragments':>10} {'build':>10} {'CPU':>10} {'peak':>10}  of classes, quality, Optimal, default policy")
    for fragments, seconds, cpu, peak in zip(growth.fragments, growth.seconds, growth.cpu_seconds, growth.peak_bytes):
        print(f"{fragments:>10} {duration(seconds):>10} {duration(cpu):>10} {megabytes(peak):>10}")
    print(f"CPU time grows as fragments^{growth.exponent:.2f} (R^2 {growth.r_squared:.4f})")


def main(arguments: list[str]) -> None:
    """Measure, print, and save where asked."""
    parser = argparse.ArgumentParser(prog="tools.measuring.bench", description=__doc__)
    parser.add_argument("program", type=Path, help="the Google Benchmark program")
    parser.add_argument("package", type=Path, help="the add-on's zip for Debian's Blender")
    parser.add_argument("--takes", type=Path, nargs="+", metavar="MOCAP", help="BVH in centimetres, or ASF and AMC")
    parser.add_argument("--json", type=Path, metavar="FILE", help="save the figures there too")
    options = parser.parse_args(arguments)
    recordings = read_recordings(options.takes, _UNIT) if options.takes else sample_recordings()
    policy = policy_of(recordings)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        large = folder / "large.policy"
        large.write_bytes(policy)
        measured = measure_core(options.program, large, folder)
        in_blender = measure_in_blender(recordings, options.package, folder)
        data: Arrays = {path.stem: np.load(path) for path in folder.glob("*.npy")}
    rows, remarks = compare(measured.seconds, data)
    stored = measure_stored(recordings, policy)
    show(rows, remarks, measured, data, stored, in_blender)
    if options.json:
        listed = goals(rows, measured, stored, in_blender)
        figures = {
            "stages": [asdict(row) for row in rows],
            "growth": asdict(measured.growth),
            "stored": asdict(stored),
            "in_blender": asdict(in_blender),
            "goals": {goal.name: [goal.figure, goal.limit, goal.met] for goal in listed},
        }
        options.json.write_text(json.dumps(figures, indent=2) + "\n")


if __name__ == "__main__":
    main(sys.argv[1:])
