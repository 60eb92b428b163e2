# SPDX-License-Identifier: MIT
"""Fit the run time's constants to sets of takes, and say what that does on sets that were not fitted; or say what each
is worth.

`python3 dev.py tune` runs this with the built core; python -m tools.measuring.tuning --help tells the rest.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from typing import Any

import fragmotion_core as core
from fragmotion_command.evaluate.loading import Recordings, read_recordings

from tools.measuring.command import run_command
from tools.measuring.quality.sample import sample_recordings
from tools.measuring.tuning import inputs, objective
from tools.measuring.tuning.search import fit
from tools.measuring.tuning.sensitivity import TIMES, rises
from tools.shell import say

_SEEDS = 2  # of the build and the players, to fit to; as many others to judge by
_MANY_SEEDS = 10  # for how sensitive the cost is


def recordings_of(name: str, unit: float) -> Recordings:
    """A set's takes."""
    return sample_recordings() if name == inputs.SAMPLE else read_recordings(inputs.files_of(name), unit)


def characters_of(names: Sequence[str], first_seed: int, unit: float, seeds: int = _SEEDS) -> list[objective.Character]:
    """Those to measure."""
    some = []
    for name in names:
        recordings = recordings_of(name, unit)
        some += [objective.Character(name, recordings, seed) for seed in range(first_seed, first_seed + seeds)]
    return some


def sensitivity(names: Sequence[str], options: argparse.Namespace) -> dict[str, Any]:
    """What each constant is worth on some sets; prints it, and returns it as saved."""
    characters = characters_of(names, options.seed, options.unit, _MANY_SEEDS)
    found = rises(
        core.PlayerOptions().constants, lambda some: list(map(objective.cost, objective.measure(characters, some)))
    )
    say(f"the cost rises, where a constant is 1 / {TIMES:g} of what it is and {TIMES:g} times, by (standard error)")
    for name, (less, more) in found.items():
        say(f"{name:24} {less[0]:+.4f} ({less[1]:.4f}) {more[0]:+.4f} ({more[1]:.4f})")
    return {"sets": list(names), "rises": found}


def tune(fitted: Sequence[str], judged: Sequence[str], options: argparse.Namespace) -> dict[str, Any]:
    """Fit to the one sets and judge on the others, with other seeds; prints both, and returns them as saved."""
    say(f"fitting to {', '.join(fitted)}")
    start = core.PlayerOptions().constants
    characters = characters_of(fitted, options.seed, options.unit)
    best = fit(
        start, lambda some: objective.mean_cost(objective.measure(characters, some)), options.minutes, options.seed
    )
    for name, value in sorted(best.items()):
        say(f"{name:28} {start[name]:10.4g} -> {value:.4g}")
    rows = []
    for character in characters_of([*fitted, *judged], options.seed + _SEEDS, options.unit):
        before, after = (character.figures(some) for some in (start, best))
        rows.append({"set": character.name, "fitted": character.name in fitted, "before": before, "after": after})
        say(f"\n{character.name}, {'fitted' if rows[-1]['fitted'] else 'not fitted'}:")
        say(f"{'cost':28} {objective.cost(before):10.4f} -> {objective.cost(after):.4f}")
        for name in before:
            say(f"{name:28} {before[name]:10.4g} -> {after[name]:.4g}")
    return {"fitted": list(fitted), "judged": list(judged), "constants": best, "rows": rows}


def run(options: argparse.Namespace) -> None:
    """Do all that the options ask for; Failure says what was wrong with them."""
    inputs.check(options)
    found: list[dict[str, Any]]
    if options.sensitivity:
        found = [sensitivity(options.sets, options)]
    else:
        found = [tune(fitted, judged, options) for fitted, judged in _rounds(options)]
    if options.json:
        options.json.write_text(json.dumps(found, indent=1, allow_nan=False) + "\n")
        say(f"\nfigures: {options.json}")


def _rounds(options: argparse.Namespace) -> list[tuple[list[str], list[str]]]:
    """What is fitted, and what judged on."""
    if options.leave_one_out:
        return [([other for other in options.sets if other != name], [name]) for name in options.sets]
    return [(options.sets, options.judge)]


def main(arguments: list[str]) -> int:
    """Run, and return the exit code."""
    return run_command("tune", __doc__, inputs.add_arguments, run, arguments)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
